#include "bench/ours.h"

#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/vulkan_tracer.h"

namespace sunfleck::bench {

Ours::Ours(const Stand& stand, const GpuContext* context, const OurChoices& choices)
    : Ours(stand, stand.prepared.bvh, context, choices) {}

Ours::Ours(const Stand& stand, const Bvh& bvh, const GpuContext* context, const OurChoices& choices) {
  if (context == nullptr) {
    tracer_ = std::make_unique<CpuTracer>(bvh, stand.tracer_scene());
    return;
  }
  tree_.emplace(*context, bvh, choices.use.value_or(preferred_use(*context, bvh)));
  tracer_ =
      std::make_unique<VulkanTracer>(*context, bvh, *tree_, stand.tracer_scene(), stand.prepared.layout.words(), choices.cut);
}

}  // namespace sunfleck::bench
