#pragma once
// The legend of a chart: classes or a colour bar in a panel with a title.

#include "pictures/drawing/colour_scale.h"
#include "pictures/drawing/image.h"
#include "pictures/drawing/text.h"

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// One entry of the legend; entries are listed from top to bottom.
struct LegendEntry {
  Colour colour{};
  std::string label;  // "FROM – TO" (en dash) is set in two columns
};

// A continuous scale, drawn upright with `hi` at the top and ticks at round numbers.
struct ColourBar {
  double lo = 0.0;
  double hi = 1.0;              // > lo; or equal to lo if all values are the same, which gives one tick
  std::vector<Colour> colours;  // evenly spaced from lo to hi and interpolated, at least one
};

// UTF-8, one line each.
struct Legend {
  // e.g. "Direct PAR irradiance, W m⁻²"; the part after the last ", " is set on a separate line
  std::string title;
  std::optional<ColourBar> bar;
  std::vector<LegendEntry> entries;  // above the bar if there is one, for example for values beyond its end
};

// Returns the entries of a rank chart, full sun first. Labels show the bounds to three digits of the largest, or as many more
// as are needed to distinguish them; "≥ FROM" for the last class of an open scale. Empty classes are left out. With shares,
// those of rank_shares, each label ends with its own, and the unlit class has an entry if it holds anything.
[[nodiscard]] std::vector<LegendEntry> rank_legend(const RankScale& scale,
                                                   const std::optional<std::array<double, 6>>& shares = {});

// Returns the numbers from lo to hi, inclusive, that are multiples of 1, 2 or 5 times a power of ten, four to eight of them,
// with labels that all have the same number of decimals.
struct Tick {
  double value = 0.0;
  std::string label;
};
[[nodiscard]] std::vector<Tick> round_ticks(double lo, double hi);

// The room for a legend's panel, in pixels: its upper right corner and the size to the left and below.
struct LegendRoom {
  glm::dvec2 corner_px{0.0};
  double width_px = 0.0;
  double height_px = 0.0;
};

// Draws the panel in type of `size_px`, or smaller if needed to fit into its room. Draws nothing for a legend without bar and
// entries.
void draw_legend(Image& image, const Typeface& face, const Legend& legend, const LegendRoom& room, double size_px);

}  // namespace sunfleck
