#pragma once
// The device a run works on: tree and tracer, on Vulkan or on the CPU.

#include "bvh/bvh.h"
#include "gpu/context.h"
#include "tracers/canopy_view.h"
#include "tracers/cpu_tracer.h"
#include "tracers/gpu_tree.h"
#include "tracers/shared_device.h"
#include "transport/tracer.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {

// Only builds with checks have the validation layer look.
#ifdef NDEBUG
inline constexpr Validation build_validation = Validation::off;
#else
inline constexpr Validation build_validation = Validation::on;
#endif

// A device as the command line names it (auto | gpu | lavapipe | cpu | INDEX | NAME). Processes that share a machine take turns
// at its devices: DeviceWish::turn.
struct DeviceAsked {
  DeviceAsked(std::string asked, int own_turn = 0) : name(std::move(asked)), turn(own_turn) {}
  std::string name;
  int turn;
};

// That Vulkan device; none stands for the CPU path. Throws Error (device) if there is none such.
[[nodiscard]] std::unique_ptr<GpuContext> open_device(const DeviceAsked& device);

// Whether a window draws while the tracer is at work, from another thread.
enum class EngineUse { one_thread, drawn_meanwhile };

class Engine {
 public:
  // `device` as in open_device. Tree and engine live together: the tree must outlive it. Where it is drawn meanwhile, one
  // thread at a time may use the tracer and one at a time a viewer: they take turns, short ones.
  Engine(const DeviceAsked& device, const Bvh& bvh, CpuTracer::Scene scene, std::size_t counter_words,
         EngineUse use = EngineUse::one_thread);

  [[nodiscard]] Tracer& tracer() { return in_turns_ ? *in_turns_ : *tracer_; }
  [[nodiscard]] TracerDevice device() const { return tracer_->device(); }
  // The engine must outlive it.
  [[nodiscard]] std::unique_ptr<CanopyViewer> viewer(CanopyLook look) const;
  // What the validation layer had to say; only builds with checks have it look.
  [[nodiscard]] std::vector<std::string> validation_messages() const;

 private:
  void open_vulkan(CpuTracer::Scene scene, std::size_t counter_words, double seconds_per_dispatch);

  const Bvh& bvh_;
  std::unique_ptr<GpuContext> context_;  // none on the CPU path
  std::unique_ptr<GpuTree> tree_;
  std::unique_ptr<Tracer> tracer_;
  std::unique_ptr<DeviceTurn> turn_;  // these two only where it is drawn meanwhile
  std::unique_ptr<TurnTakingTracer> in_turns_;
};

}  // namespace sunfleck
