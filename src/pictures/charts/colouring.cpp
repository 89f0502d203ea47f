#include "pictures/charts/colouring.h"

#include "pictures/drawing/tone_map.h"
#include "pictures/drawing/viridis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace sunfleck {
namespace {

// Returns the scale of a rank chart.
RankScale rank_scale(ChartKind chart, const FieldValues& values, const ScaleLimits& limits) {
  RankScale scale;
  if (chart == ChartKind::rank) {
    scale = equal_count_ranks(values.w_m2, values.area_m2, limits.lit_from_w_m2);
  } else if (chart == ChartKind::rank_log) {
    scale =
        limits.top_w_m2 ? logarithmic_ranks_to(*limits.top_w_m2, values.w_m2) : logarithmic_ranks(values.w_m2, values.area_m2);
  } else {
    scale = limits.top_w_m2 ? rank_scale_to(*limits.top_w_m2, values.w_m2) : equal_interval_ranks(values.w_m2, values.area_m2);
  }
  scale.lit_from = limits.lit_from_w_m2;
  if (limits.top_w_m2 || scale.bounds.back() <= limits.largest_w_m2) return scale;
  if (chart == ChartKind::rank_interval) return rank_scale_to(limits.largest_w_m2, values.w_m2);
  if (chart == ChartKind::rank_log) return logarithmic_ranks_to(limits.largest_w_m2, values.w_m2);
  for (double& bound : scale.bounds) bound = std::min(bound, limits.largest_w_m2);
  scale.open = true;
  return scale;
}

// Soil that is not counted has browns of its own, from dark to a pale sand: on the leaves' scale, which is of two faces, its
// sunflecks could all lie in the lowest class.
Colour soil_colour(double share_of_top) {
  constexpr Colour dark{0.22, 0.17, 0.13}, pale{0.87, 0.80, 0.70};  // sRGB
  Colour encoded{};
  const double share = std::clamp(share_of_top, 0.0, 1.0);
  for (std::size_t i = 0; i < encoded.size(); ++i) encoded[i] = dark[i] + share * (pale[i] - dark[i]);
  return from_encoded(encoded);
}

// Gives the soil's cells their colours and a line of the legend.
void colour_soil(Colouring& colouring, const FieldValues& values, const ScaleLimits& limits) {
  const auto cells = std::span(values.w_m2).subspan(values.first_cell);
  const std::vector<double> equal_areas(cells.size(), 1.0);
  const double own_top = weighted_quantile(cells, equal_areas, rank_top_share);
  const double top = limits.top_w_m2.value_or(std::min(own_top, limits.largest_on_soil_w_m2));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    colouring.colours[values.first_cell + i] = soil_colour(top > 0.0 ? cells[i] / top : 0.0);
  }
  colouring.legend.entries.push_back({soil_colour(1.0), fmt::format("soil at {:.3g}", top)});
  colouring.legend.entries.push_back({soil_colour(0.0), "soil at 0"});
}

Colouring ranked(const FieldValues& values, const RankScale& scale, const ScaleLimits& limits) {
  Colouring colouring;
  colouring.colours.reserve(values.w_m2.size());
  for (const double value : values.w_m2) colouring.colours.push_back(rank_colour(rank_of(scale, value)));
  colouring.legend.entries = rank_legend(scale, rank_shares(scale, values.w_m2, values.area_m2));
  const bool soil_apart = values.first_cell < values.area_m2.size() && values.area_m2[values.first_cell] == 0.0;
  if (soil_apart) colour_soil(colouring, values, limits);
  return colouring;
}

Colouring mapped(const FieldValues& values, const MapScale& scale) {
  constexpr int steps = 64;
  Colouring colouring;
  colouring.colours.reserve(values.w_m2.size());
  for (const double value : values.w_m2) colouring.colours.push_back(map_colour(scale, value));
  ColourBar bar{0.0, scale.top, {}};
  for (int k = 0; k <= steps; ++k)
    bar.colours.push_back(scale.top > 0.0 ? viridis(static_cast<double>(k) / steps) : viridis(0));
  colouring.legend.bar = bar;
  if (scale.open) colouring.legend.entries.push_back({viridis(1.0), fmt::format("> {:.3g}", scale.top)});
  return colouring;
}

// Returns the scale of a map.
MapScale map_scale(const FieldValues& values, const ScaleLimits& limits) {
  if (limits.top_w_m2) return map_scale_to(*limits.top_w_m2, values.w_m2);
  const MapScale scale = make_map_scale(values.w_m2, values.area_m2);
  return scale.top <= limits.largest_w_m2 ? scale : map_scale_to(limits.largest_w_m2, values.w_m2);
}

// Returns up to `count` numbers of the form 1, 2 or 5 times a power of ten, the largest first, none above `top`.
std::vector<double> round_levels(double top, int count) {
  std::vector<double> levels;
  if (!(top > 0.0)) return levels;
  int power = static_cast<int>(std::floor(std::log10(top)));
  while (static_cast<int>(levels.size()) < count) {
    for (const double digit : {5.0, 2.0, 1.0}) {
      const double level = digit * std::pow(10.0, power);
      if (level <= top && static_cast<int>(levels.size()) < count) levels.push_back(level);
    }
    --power;
  }
  return levels;
}

// The legend shows the surface with the largest area at some round irradiances, and without light.
Colouring hue_mapped(const FieldValues& values, const SurfaceColours& surfaces, double largest_w_m2) {
  constexpr int swatches = 6;
  constexpr double brightest_swatch = 1.25;  // relative to the value that nearly all surfaces stay below
  const ToneMap tones = make_tone_map(values.w_m2, values.area_m2, surfaces.reflectance);
  Colouring colouring;
  colouring.colours.reserve(values.w_m2.size());
  for (std::size_t i = 0; i < values.w_m2.size(); ++i) {
    colouring.colours.push_back(hue_colour(tones, surfaces.reflectance[i], values.w_m2[i]));
  }
  const double top = std::min(largest_w_m2, brightest_swatch * weighted_quantile(values.w_m2, values.area_m2, map_top_share));
  for (const double level : round_levels(top, swatches)) {
    colouring.legend.entries.push_back({hue_colour(tones, surfaces.typical, level), fmt::format("{:.6g}", level)});
  }
  colouring.legend.entries.push_back({Colour{}, "0"});
  colouring.note = fmt::format("hue mapping, log-mean {:.3g} W m⁻²", tones.log_mean_w_m2);
  return colouring;
}

}  // namespace

SurfaceColours surface_colours(const RadiationModel& model, const CounterLayout& layout) {
  SurfaceColours surfaces;
  surfaces.reflectance = surface_reflectance(model, layout);
  std::vector<double> area(model.optics.size(), 0.0);
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    area[model.canopy.optics_of[e]] += 2.0 * area_m2(model.canopy.corners[e]);
  }
  const auto largest = std::max_element(area.begin(), area.end());
  const double soil_m2 = model.soil ? model.plot.area_m2() : 0.0;
  if (largest == area.end() || *largest < soil_m2) {
    surfaces.name = "soil";
    if (!surfaces.reflectance.empty()) surfaces.typical = surfaces.reflectance.back();
    return surfaces;
  }
  const SurfaceOptics& optics = model.optics[static_cast<std::size_t>(largest - area.begin())];
  surfaces.name = optics.name;
  surfaces.typical = {optics.rgb.r, optics.rgb.g, optics.rgb.b};
  return surfaces;
}

Colouring colour_field(ChartKind chart, const FieldValues& values, const SurfaceColours& surfaces, const std::string& title,
                       const ScaleLimits& limits) {
  Colouring colouring;
  switch (chart) {
    case ChartKind::rank:
    case ChartKind::rank_interval:
    case ChartKind::rank_log:
      colouring = ranked(values, rank_scale(chart, values, limits), limits);
      break;
    case ChartKind::hue:
      colouring = hue_mapped(values, surfaces, limits.largest_w_m2);
      break;
    case ChartKind::map:
      colouring = mapped(values, map_scale(values, limits));
      break;
  }
  colouring.legend.title = title;
  if (chart == ChartKind::hue) colouring.legend.title += fmt::format(" (as on {})", surfaces.name);
  return colouring;
}

}  // namespace sunfleck
