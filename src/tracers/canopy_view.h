#pragma once
// What a camera sees: one surface number a sample, from the same tree as the light.

#include "bvh/bvh.h"
#include "shared/layout.h"
#include "shared/view_layout.h"
#include "tracers/gpu_tree.h"
#include "transport/tracer.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

namespace sunfleck {

// A periodic plot may be seen amidst its copies: `repeat` x `repeat` plots (odd, at most 9), itself in their middle.
struct SeenCopies {
  enum class Which {
    all,
    not_before_plot,  // without those nearer to a camera that looks sideways than the plot itself, which they would hide
  };
  int repeat = 1;
  glm::dvec2 period_m{0.0};  // along x and z; not used where repeat is 1
  Which which = Which::all;
};

// One look at a canopy. Elements appear once in each copy, where the canopy has them, whatever period they reach into; so does
// the ground. `offsets` are the samples' places in a pixel, 0..1, one for each; view.samples is their number.
struct CanopyLook {
  shared::ViewBlock view;
  std::vector<glm::vec2> offsets;
  SeenCopies copies;
};

// Looks as often as it is asked, at some rows of the picture each time.
class CanopyViewer {
 public:
  virtual ~CanopyViewer() = default;

  // Another look from here on; much cheaper than another viewer.
  virtual void aim(CanopyLook look) = 0;

  // [row][column][sample] of `rows` rows from the picture's row `first_row` on, fewer than 2^32 samples. Empty if stopped.
  // However the picture is cut into rows, a sample sees the same.
  [[nodiscard]] virtual std::vector<shared::SeenSurface> see(std::uint32_t first_row, std::uint32_t rows,
                                                             const StopQuestion& stop) = 0;
};

// What they are made from must outlive them. What takes the device too many steps is looked up in `bvh`, of which `tree` is the
// copy on the device.
[[nodiscard]] std::unique_ptr<CanopyViewer> view_with_gpu(const GpuContext& context, const GpuTree& tree, const Bvh& bvh,
                                                          CanopyLook look);
[[nodiscard]] std::unique_ptr<CanopyViewer> view_with_cpu(const Bvh& bvh, CanopyLook look);

// The whole picture of one plot, of fewer than 2^32 samples. Empty if stopped.
[[nodiscard]] std::vector<shared::SeenSurface> see_with_gpu(const GpuContext& context, const GpuTree& tree, const Bvh& bvh,
                                                            const shared::ViewBlock& view,
                                                            const std::vector<glm::vec2>& offsets, const StopQuestion& stop);
[[nodiscard]] std::vector<shared::SeenSurface> see_with_cpu(const Bvh& bvh, const shared::ViewBlock& view,
                                                            const std::vector<glm::vec2>& offsets, const StopQuestion& stop);

// `count` places spread evenly over a pixel: the additive sequence of the plastic number (Roberts 2018, "The unreasonable
// effectiveness of quasirandom sequences").
[[nodiscard]] std::vector<glm::vec2> sample_offsets(int count);

}  // namespace sunfleck
