#pragma once
// The legend of a chart: classes, or a colour bar, in a panel with a title.

#include "view/colour_scale.h"
#include "view/image.h"
#include "view/text.h"

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// One entry of the legend, from its top to its bottom.
struct LegendEntry {
  Colour colour{};
  std::string label;  // "FROM – TO" (en dash) is set in two columns
};

// A continuous scale, drawn upright with `hi` at its top and ticks at round numbers.
struct ColourBar {
  double lo = 0.0;
  double hi = 1.0;              // > lo, or equal to it where all values are the same: one tick then
  std::vector<Colour> colours;  // from lo to hi at even distances, at least one; blended in between
};

// UTF-8, a line each.
struct Legend {
  std::string title;  // e.g. "Direct PAR irradiance, W m⁻²": what follows the last ", " is a line of its own
  std::optional<ColourBar> bar;
  std::vector<LegendEntry> entries;  // above the bar, if there is one: what is beyond its end, say
};

// The entries of a rank chart, full sun first, labelled with the bounds to three digits of the largest, or as many more as it
// takes to tell the bounds apart; "≥ FROM" for the last class of an open scale. Empty classes are left out.
[[nodiscard]] std::vector<LegendEntry> rank_legend(const RankScale& scale);

// Numbers between lo and hi, ends included, that are multiples of 1, 2 or 5 times a power of ten: four to eight of them, and
// their labels, all with the same number of decimals.
struct Tick {
  double value = 0.0;
  std::string label;
};
[[nodiscard]] std::vector<Tick> round_ticks(double lo, double hi);

// Where a legend's panel may lie, in pixels: its upper right corner and the room to the left of it and below.
struct LegendRoom {
  glm::dvec2 corner_px{0.0};
  double width_px = 0.0;
  double height_px = 0.0;
};

// Draws the panel in type of `size_px`, or smaller so that it fits into its room. Nothing for a legend without bar and entries.
void draw_legend(Image& image, const Typeface& face, const Legend& legend, const LegendRoom& room, double size_px);

}  // namespace sunfleck
