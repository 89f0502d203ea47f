#pragma once
// Closed forms against which the known-answer cases are checked. Fluxes are relative to the flux incident through the top.

#include "physics/canopy/optics.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// Horizontal plates without gaps over soil, the top one first. All plates are alike; `top` is their face towards the sky.
struct PlateStack {
  FaceOptics top, bottom;
  double soil_reflectance = 0.0;
};
struct PlateLight {
  std::vector<double> down, up;  // [plate], irradiance of its upper and its lower side
  double reflected = 0.0, on_soil = 0.0;
};
// Solves D_1 = 1, D_{k+1} = tau D_k + rho U_k, U_k = rho D_{k+1} + tau U_{k+1} by substitution; the last plate receives from
// the soil.
[[nodiscard]] PlateLight light_on_plates(std::size_t count, const PlateStack& stack);
[[nodiscard]] double absorbed_by_plate(const PlateLight& light, const PlateStack& stack, std::size_t plate);

// Light in a canopy of small horizontal leaves placed at random, of that leaf area index, over soil. The two-stream equations
// dD/dl = -(1 - tau) D + rho U, dU/dl = (1 - tau) U - rho D are exact for horizontal leaves whatever the direction of the
// light.
struct LevelCanopyLight {
  double reflected = 0.0, on_soil = 0.0, leaves = 0.0;
};
[[nodiscard]] LevelCanopyLight light_in_level_canopy(double leaf_area_index, const FaceOptics& leaf, double soil_reflectance);

// Returns the share of light that passes endless strips, whose width is `width_over_pitch` of their distance and which are
// tilted about their long axis by `tilt_rad`, while their shadows do not overlap. The sun is across them, on the side to which
// they rise if `towards` is 1, on the other side if it is -1.
[[nodiscard]] double passed_by_blind(double width_over_pitch, double tilt_rad, double elevation_rad, double towards);

// Returns the length that an interval [0, length), moved by `shift` and repeated every `period`, has in common with [0, other).
[[nodiscard]] double overlap_after_shift(double length, double other, double period, double shift);

}  // namespace sunfleck
