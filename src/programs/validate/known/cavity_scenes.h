#pragma once
// Builds cavities whose light is known exactly.

#include "physics/transport/model/model.h"
#include "programs/validate/known/case_scenes.h"

#include <array>
#include <span>

namespace sunfleck {

inline constexpr std::size_t box_walls = 6;
inline constexpr std::array furnace_reflectances = {0.1, 0.5, 0.9, 0.95};

// Returns a closed box of 1 x 0.6 x 0.8 m whose upper faces look inwards, one organ for each wall, which is cut into cells x
// cells rectangles; and the same box with an organ of leaves in it that do not intersect the walls.
[[nodiscard]] Mesh empty_box(int cells);
[[nodiscard]] Mesh furnished_box(int cells);

// Returns a model of such a box without sun and soil.
[[nodiscard]] RadiationModel dark_box(const Mesh& box, std::size_t bands);
// Returns such a model with a band for each of the furnace's reflectances, in which all walls emit 1 W m-2; of leaves, rho + tau
// is 1. Every surface then receives 1 / (1 - reflectance), on both sides of leaves.
[[nodiscard]] RadiationModel furnace(const Mesh& box);

// Half a sphere of radius 0.5 m, open upwards, with a black outside, over black ground.
struct Bowl {
  RadiationModel model;
  double opening_m2 = 0.0;
  double kept = 0.0;  // share of the light leaving the inside that meets the inside again

  // Returns the share of a beam into the bowl that comes out again: of a beam from any direction into a spherical cavity that is
  // the share f of its sphere, rho (1 - f) / (1 - rho f). In a cavity of plane facets a facet does not see itself, so f is
  // 1 - opening / inner area (reciprocity).
  [[nodiscard]] double escaping_share(double reflectance) const {
    return reflectance * (1.0 - kept) / (1.0 - reflectance * kept);
  }
};
// Returns a bowl of `around` facets in each ring, with a band for each reflectance of its inside.
[[nodiscard]] Bowl bowl_under(const SunPosition& sun, int around, std::span<const double> reflectances);

}  // namespace sunfleck
