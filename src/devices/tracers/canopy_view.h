#pragma once
// Finds what a camera sees: one surface number per sample, from the same tree as the light.

#include "devices/tracers/gpu_tree.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/model/tracer.h"
#include "shared/layout.h"
#include "shared/view_layout.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

namespace sunfleck {

// Shows a periodic plot among its copies: `repeat` x `repeat` plots (odd, at most 9), with the plot itself in the middle.
struct SeenCopies {
  enum class Which {
    all,
    // Leaves out the copies nearer to a sideways-looking camera than the plot itself, which they would hide.
    not_before_plot,
  };
  int repeat = 1;
  glm::dvec2 period_m{0.0};  // along x and z; unused if repeat is 1
  Which which = Which::all;
};

// One look at a canopy. Each element appears once per copy, at its own place, whatever period it extends into, and so does the
// ground. `offsets` are the places of the samples within a pixel, 0..1; view.samples is their number.
struct CanopyLook {
  shared::ViewBlock view;
  std::vector<glm::vec2> offsets;
  SeenCopies copies;
};

// Looks at a canopy repeatedly, at some rows of the picture each time.
class CanopyViewer {
 public:
  virtual ~CanopyViewer() = default;

  // Sets another look for the following calls; much cheaper than creating another viewer.
  virtual void aim(CanopyLook look) = 0;

  // Returns [row][column][sample] of `rows` rows starting at the picture's row `first_row`, fewer than 2^32 samples; empty if
  // stopped. The division of the picture into rows does not affect any sample.
  [[nodiscard]] virtual std::vector<shared::SeenSurface> see(std::uint32_t first_row, std::uint32_t rows,
                                                             const StopQuestion& stop) = 0;
};

// Returns how many samples are best seen together: on a GPU enough to keep it busy; otherwise enough for all threads, and few
// enough that what they see stays in a processor's cache.
[[nodiscard]] std::uint32_t samples_at_once(const TracerDevice& device);

// Create a viewer; the arguments except the look must outlive it. Samples that take the device too many steps are resolved with
// `bvh`, of which `tree` is the copy on the device.
[[nodiscard]] std::unique_ptr<CanopyViewer> view_with_gpu(const GpuContext& context, const GpuTree& tree, const Bvh& bvh,
                                                          CanopyLook look);
[[nodiscard]] std::unique_ptr<CanopyViewer> view_with_cpu(const Bvh& bvh, CanopyLook look);

// Returns `count` places spread evenly over a pixel, from the additive sequence of the plastic number (Roberts 2018, "The
// unreasonable effectiveness of quasirandom sequences").
[[nodiscard]] std::vector<glm::vec2> sample_offsets(int count);

}  // namespace sunfleck
