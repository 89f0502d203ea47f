#pragma once
// Turns the numbers of a field into the colours and the legend of a chart.

#include "pictures/charts/fields.h"
#include "pictures/charts/picture.h"
#include "pictures/drawing/chart.h"
#include "pictures/drawing/colour_scale.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

struct Colouring {
  std::vector<Colour> colours;  // linear, [surface number]
  std::string legend_title;
  std::vector<LegendEntry> legend;
  std::optional<ColourBar> bar;
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

// Returns the colours and the legend of a field. `title` is the field's, with its unit; `top_w_m2` is as in PictureOptions.
[[nodiscard]] Colouring colour_field(ChartKind chart, const FieldValues& values, const SurfaceColours& surfaces,
                                     const std::string& title, std::optional<double> top_w_m2 = {});

}  // namespace sunfleck
