#pragma once
// Turns the numbers of a field into the colours and the legend of a chart.

#include "pictures/charts/fields.h"
#include "pictures/charts/picture.h"
#include "pictures/drawing/colour_scale.h"
#include "pictures/drawing/legend.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct Colouring {
  std::vector<Colour> colours;  // linear, [surface number]
  Legend legend;
  std::string note;  // for the footer; may be empty
};

// Properties of the surfaces that hue mapping needs.
struct SurfaceColours {
  std::vector<Colour> reflectance;  // [surface number]
  // Name and colour of the surface with the largest area, which the legend's swatches show.
  std::string name;
  Colour typical{};
};
[[nodiscard]] SurfaceColours surface_colours(const RadiationModel& model, const CounterLayout& layout);

// What the scales of a field depend on besides its values.
struct ScaleLimits {
  std::optional<double> top_w_m2;  // as in PictureOptions
  double lit_from_w_m2 = 0.0;      // less than this is unlit in a rank chart
  // No scale ends above it, so that a noisy sliver cannot stretch it.
  double largest_w_m2 = std::numeric_limits<double>::infinity();
  double largest_on_soil_w_m2 = std::numeric_limits<double>::infinity();
};

// Returns the colours and the legend of a field; for a rank chart, `values` are those of leaf_values. `title` is the field's,
// with its unit.
[[nodiscard]] Colouring colour_field(ChartKind chart, const FieldValues& values, const SurfaceColours& surfaces,
                                     const std::string& title, const ScaleLimits& limits = {});

}  // namespace sunfleck
