#pragma once
// Runs our own tracers over a stand.

#include "bench/stand.h"
#include "devices/gpu/context.h"
#include "devices/tracers/gpu_tree.h"
#include "devices/tracers/vulkan_choices.h"
#include "physics/transport/model/tracer.h"

#include <memory>
#include <optional>

namespace sunfleck::bench {

// How the Vulkan path works; by default the program's own choices.
struct OurChoices {
  std::optional<BufferUse> use;
  VulkanChoices cut;
};

// The CPU path, or the Vulkan path on a device.
class Ours {
 public:
  Ours(const Stand& stand, const GpuContext* context, const OurChoices& choices = {});
  Ours(const Stand& stand, const Bvh& bvh, const GpuContext* context, const OurChoices& choices = {});

  [[nodiscard]] Tracer& tracer() { return *tracer_; }

 private:
  std::optional<GpuTree> tree_;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace sunfleck::bench
