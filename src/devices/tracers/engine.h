#pragma once
// The device that a run uses: the tree and the tracer, on Vulkan or on the CPU.

#include "devices/gpu/context.h"
#include "devices/tracers/canopy_view.h"
#include "devices/tracers/gpu_tree.h"
#include "devices/tracers/shared_device.h"
#include "devices/tracers/trace_domain.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/model/tracer.h"

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

// A device as named on the command line (auto | gpu | lavapipe | cpu | INDEX | NAME); auto is a GPU if there is one, else the
// CPU path. Processes that share a machine take turns at its devices: DeviceSelector::turn.
struct DeviceChoice {
  DeviceChoice(std::string chosen, int own_turn = 0) : name(std::move(chosen)), turn(own_turn) {}
  std::string name;
  int turn;
};

// Opens that Vulkan device; returns null for the CPU path. Throws Error (device) if there is no such device.
[[nodiscard]] std::unique_ptr<GpuContext> open_device(const DeviceChoice& device);

// Says whether a window draws from another thread while the tracer is at work.
enum class EngineUse { one_thread, shared_with_window };

class Engine {
 public:
  // Opens `device` as open_device does. The tree must outlive the engine. With shared_with_window, one thread may use the tracer
  // while another uses a viewer; the two take short turns.
  Engine(const DeviceChoice& device, const Bvh& bvh, TraceDomain domain, std::size_t counter_words,
         EngineUse use = EngineUse::one_thread);

  [[nodiscard]] Tracer& tracer() { return in_turns_ ? *in_turns_ : *tracer_; }
  [[nodiscard]] TracerDevice device() const { return tracer_->device(); }
  // Creates a viewer, which the engine must outlive.
  [[nodiscard]] std::unique_ptr<CanopyViewer> viewer(CanopyLook look) const;
  // Returns the messages of the validation layer, which is active only in builds with checks.
  [[nodiscard]] std::vector<std::string> validation_messages() const;

 private:
  void open_vulkan(TraceDomain domain, std::size_t counter_words, double seconds_per_dispatch);

  const Bvh& bvh_;
  std::unique_ptr<GpuContext> context_;  // null on the CPU path
  std::unique_ptr<GpuTree> tree_;
  std::unique_ptr<Tracer> tracer_;
  std::unique_ptr<DeviceTurn> turn_;  // this and the next member are null unless the use is shared_with_window
  std::unique_ptr<TurnTakingTracer> in_turns_;
};

}  // namespace sunfleck
