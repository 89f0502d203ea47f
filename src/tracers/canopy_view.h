#pragma once
// What a camera sees: one surface number a sample, from the same tree as the light.

#include "bvh/bvh.h"
#include "shared/layout.h"
#include "tracers/gpu_tree.h"
#include "transport/tracer.h"

#include <glm/vec2.hpp>
#include <vector>

namespace sunfleck {

// [row][column][sample]: width * height * samples of the view. Elements appear once, where the canopy has them. `offsets` are
// the samples' places in a pixel, 0..1, one for each; view.samples is their number. Empty if stopped. What takes the device too
// many steps is looked up in `bvh`, of which `tree` is the copy on the device.
[[nodiscard]] std::vector<shared::SeenSurface> see_with_gpu(const GpuContext& context, const GpuTree& tree, const Bvh& bvh,
                                                            const shared::ViewBlock& view,
                                                            const std::vector<glm::vec2>& offsets, const StopQuestion& stop);
[[nodiscard]] std::vector<shared::SeenSurface> see_with_cpu(const Bvh& bvh, const shared::ViewBlock& view,
                                                            const std::vector<glm::vec2>& offsets, const StopQuestion& stop);

// `count` places spread evenly over a pixel: the additive sequence of the plastic number (Roberts 2018, "The unreasonable
// effectiveness of quasirandom sequences").
[[nodiscard]] std::vector<glm::vec2> sample_offsets(int count);

}  // namespace sunfleck
