#include "programs/validate/known/known_formulas.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {

PlateLight light_on_plates(std::size_t count, const PlateStack& stack) {
  constexpr int sweeps = 1000;  // each leaves at most the part that neither plate nor soil absorbs
  PlateLight light{std::vector<double>(count), std::vector<double>(count)};
  const auto below = [&](std::size_t k) {
    return stack.top.transmittance * light.down[k] + stack.bottom.reflectance * light.up[k];
  };
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t k = 0; k < count; ++k) light.down[k] = k == 0 ? 1.0 : below(k - 1);
    light.on_soil = below(count - 1);
    for (std::size_t k = count; k-- > 0;) {
      light.up[k] = k + 1 == count ? stack.soil_reflectance * light.on_soil
                                   : stack.top.reflectance * light.down[k + 1] + stack.bottom.transmittance * light.up[k + 1];
    }
  }
  light.reflected = stack.top.reflectance * light.down[0] + stack.bottom.transmittance * light.up[0];
  return light;
}

double absorbed_by_plate(const PlateLight& light, const PlateStack& stack, std::size_t plate) {
  return light.down[plate] * stack.top.absorptance() + light.up[plate] * stack.bottom.absorptance();
}

LevelCanopyLight light_in_level_canopy(double leaf_area_index, const FaceOptics& leaf, double soil_reflectance) {
  const double lost = 1.0 - leaf.transmittance;
  const double rate = std::sqrt(std::max(0.0, lost * lost - leaf.reflectance * leaf.reflectance));
  // sinh(rate L) / rate, which tends to L where nothing is absorbed.
  const double sine = rate > 1e-9 ? std::sinh(rate * leaf_area_index) / rate : leaf_area_index;
  const double denominator = std::cosh(rate * leaf_area_index) + lost * sine;
  const double reflected_over_black = leaf.reflectance * sine / denominator;
  const double passed = 1.0 / denominator;
  LevelCanopyLight light;
  light.on_soil = passed / (1.0 - soil_reflectance * reflected_over_black);
  light.reflected = reflected_over_black + soil_reflectance * passed * light.on_soil;
  light.leaves = 1.0 - light.reflected - (1.0 - soil_reflectance) * light.on_soil;
  return light;
}

double passed_by_blind(double width_over_pitch, double tilt_rad, double elevation_rad, double towards) {
  const double shadow = std::abs(std::cos(tilt_rad) - std::sin(tilt_rad) * towards / std::tan(elevation_rad));
  return std::max(0.0, 1.0 - width_over_pitch * shadow);
}

double overlap_after_shift(double length, double other, double period, double shift) {
  const double start = shift - period * std::floor(shift / period);
  double common = 0.0;
  for (const double at : {start - period, start}) {
    common += std::max(0.0, std::min(at + length, other) - std::max(at, 0.0));
  }
  return common;
}

}  // namespace sunfleck
