#pragma once
// A finished chart: coloured surfaces, axes, the plot's border, title and legend.

#include "canopy/plot.h"
#include "view/camera.h"
#include "view/colour_scale.h"
#include "view/image.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// What each sample of each pixel sees.
struct SurfaceImage {
  static constexpr std::uint32_t nothing = 0xffffffffU;
  int width = 0;
  int height = 0;
  int samples = 1;                     // a pixel
  std::vector<std::uint32_t> surface;  // [row][column][sample]: a surface number or `nothing`
  std::vector<float> depth_m;          // [row][column][sample]: along the camera's forward axis
};

// One entry of the legend, from its top to its bottom.
struct LegendEntry {
  Colour colour{};
  std::string label;  // "FROM – TO" (en dash) is set in two columns
};

// The entries of a rank chart, full sun first, labelled with the bounds to three digits of the largest, or as many more as it
// takes to tell the bounds apart. Empty classes are left out.
[[nodiscard]] std::vector<LegendEntry> rank_legend(const RankScale& scale);

// UTF-8, a line each. What is too long for the picture is set smaller.
struct ChartText {
  std::string title;
  std::string subtitle;      // may be empty
  std::string legend_title;  // e.g. "Direct PAR irradiance, W m⁻²": what follows the last ", " is a line of its own
  std::vector<LegendEntry> legend;
  std::string footer;  // may be empty
};

// Draws the chart at the size of `seen`: surfaces in `colours` (linear, [surface number]) averaged over each pixel's samples
// over a soft background; the axes from the plot's origin in red (X), green (Y), blue (Z) with their letters, the plot's
// border at ground level in black, both hidden where a surface stands before them (their letters never are); text in a
// sans-serif type whose size follows the picture's height, readable at half size. `height_m` is the canopy's height, for the
// length of the axes.
[[nodiscard]] Image draw_chart(const SurfaceImage& seen, std::span<const Colour> colours, const Camera& camera,
                               const Plot& plot, double height_m, const ChartText& text);

}  // namespace sunfleck
