#include "pictures/drawing/tone_map.h"

#include "base/check.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace sunfleck {
namespace {

// Share of the surfaces' area that is no brighter than L995.
constexpr double white_share = 0.995;
// Lwhite / L995
constexpr double white_over_top = 1.25;

double log_mean(std::span<const double> values, std::span<const double> weights) {
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] > 0.0) || !(weights[i] > 0.0)) continue;
    sum += weights[i] * std::log(values[i]);
    weight += weights[i];
  }
  return weight > 0.0 ? std::exp(sum / weight) : 0.0;
}

}  // namespace

double luminance(const Colour& linear) {
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

ToneMap make_tone_map(std::span<const double> irradiance_w_m2, std::span<const double> area_m2,
                      std::span<const Colour> reflectance) {
  EXPECT(irradiance_w_m2.size(), ==, area_m2.size());
  EXPECT(irradiance_w_m2.size(), ==, reflectance.size());
  ToneMap map;
  map.log_mean_w_m2 = log_mean(irradiance_w_m2, area_m2);
  if (!(map.log_mean_w_m2 > 0.0)) return map;
  std::vector<double> luminances(irradiance_w_m2.size());
  for (std::size_t i = 0; i < luminances.size(); ++i) {
    luminances[i] = luminance(reflectance[i]) * irradiance_w_m2[i] / map.log_mean_w_m2;
  }
  const double top = weighted_quantile(luminances, area_m2, white_share);
  if (top > 0.0) map.white = white_over_top * top;
  return map;
}

Colour hue_colour(const ToneMap& map, const Colour& reflectance, double irradiance_w_m2) {
  if (!(map.log_mean_w_m2 > 0.0) || !(irradiance_w_m2 > 0.0)) return {};
  const double ratio = irradiance_w_m2 / map.log_mean_w_m2;
  const double l = luminance(reflectance) * ratio;
  const double compressed = ratio * (1.0 + l / (map.white * map.white)) / (1.0 + l);
  return {reflectance[0] * compressed, reflectance[1] * compressed, reflectance[2] * compressed};
}

}  // namespace sunfleck
