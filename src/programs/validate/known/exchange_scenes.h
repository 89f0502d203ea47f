#pragma once
// Builds scenes of surfaces that exchange scattered light.

#include "physics/transport/model/model.h"
#include "programs/validate/known/case_scenes.h"
#include "programs/validate/known/known_formulas.h"

#include <array>
#include <span>
#include <vector>

namespace sunfleck {

// Two surfaces whose upper faces see each other, one organ each.
struct FacingPair {
  const char* what;
  Mesh mesh;
  std::array<double, 2> area_m2;
  double factor;  // view factor from the first to the second
};
// Returns pairs of squares and discs with the closed forms of Howell's catalogue of configuration factors (C-11 parallel
// squares, C-14 perpendicular, C-41 discs).
[[nodiscard]] std::vector<FacingPair> facing_pairs();

// Reflectances of two plates in one band.
struct PlatePair {
  double lamp, other;
};
// Returns two plates of the plot's size that face each other, one organ each; the lower one, the first, emits 1 W m-2 in each
// band.
[[nodiscard]] RadiationModel lamp_below_plate(double gap_m, std::span<const PlatePair> bands);

inline constexpr PlateStack par_plates{{0.12, 0.06}, {0.12, 0.06}, 0.15};
inline constexpr PlateStack nir_plates{{0.45, 0.45}, {0.45, 0.45}, 0.20};
inline constexpr PlateStack two_faced_plates{{0.30, 0.10}, {0.05, 0.55}, 0.40};

// The face that plates turn to the sky.
enum class SkyFace { upper, lower };
// Returns plates of the plot's size over soil, the top one first, one organ each, with the optics of one band from each stack.
[[nodiscard]] RadiationModel plates_over_soil(std::size_t count, std::span<const PlateStack> bands,
                                              SkyFace face = SkyFace::upper);

// Returns leaning strips that scatter NIR, endless along Z, one every half metre.
[[nodiscard]] RadiationModel leaning_strips(int strips);

}  // namespace sunfleck
