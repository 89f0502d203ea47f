#pragma once
// The device that a run uses: the tree and the tracer, on Vulkan or on the CPU.

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

// The validation layer is active only in builds with checks.
#ifdef NDEBUG
inline constexpr Validation build_validation = Validation::off;
#else
inline constexpr Validation build_validation = Validation::on;
#endif

// A device as named on the command line (auto | gpu | lavapipe | cpu | INDEX | NAME). Processes that share a machine take turns
// at its devices: DeviceWish::turn.
struct DeviceAsked {
  DeviceAsked(std::string asked, int own_turn = 0) : name(std::move(asked)), turn(own_turn) {}
  std::string name;
  int turn;
};

// Opens that Vulkan device; returns null for the CPU path. Throws Error (device) if there is no such device.
[[nodiscard]] std::unique_ptr<GpuContext> open_device(const DeviceAsked& device);

// Says whether a window draws from another thread while the tracer is at work.
enum class EngineUse { one_thread, drawn_meanwhile };

class Engine {
 public:
  // Opens `device` as open_device does. The tree must outlive the engine. With drawn_meanwhile, one thread may use the tracer
  // while another uses a viewer; the two take short turns.
  Engine(const DeviceAsked& device, const Bvh& bvh, CpuTracer::Scene scene, std::size_t counter_words,
         EngineUse use = EngineUse::one_thread);

  [[nodiscard]] Tracer& tracer() { return in_turns_ ? *in_turns_ : *tracer_; }
  [[nodiscard]] TracerDevice device() const { return tracer_->device(); }
  // Creates a viewer, which the engine must outlive.
  [[nodiscard]] std::unique_ptr<CanopyViewer> viewer(CanopyLook look) const;
  // Returns the messages of the validation layer, which is active only in builds with checks.
  [[nodiscard]] std::vector<std::string> validation_messages() const;

 private:
  void open_vulkan(CpuTracer::Scene scene, std::size_t counter_words, double seconds_per_dispatch);

  const Bvh& bvh_;
  std::unique_ptr<GpuContext> context_;  // null on the CPU path
  std::unique_ptr<GpuTree> tree_;
  std::unique_ptr<Tracer> tracer_;
  std::unique_ptr<DeviceTurn> turn_;  // this and the next member are null unless the use is drawn_meanwhile
  std::unique_ptr<TurnTakingTracer> in_turns_;
};

}  // namespace sunfleck
