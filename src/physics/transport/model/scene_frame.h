#pragma once
// Dimensions of the scene in the canopy's local frame: its box, its ground, and the margins that rounding requires.

#include "physics/transport/model/model.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace sunfleck {

// The box around all elements and the plot's rectangle at the ground. Without soil the ground is the lower of y = 0 and the
// lowest element.
struct SceneBox {
  glm::dvec3 lo_m{0.0}, hi_m{0.0};
  double ground_y_m = 0.0;
  double seen_y_m = 0.0;  // top of the box or the highest receiver: light enters above it

  [[nodiscard]] double extent_m() const { return std::max({hi_m.x - lo_m.x, hi_m.y - lo_m.y, hi_m.z - lo_m.z}); }
  // Returns a height that is above the highest element by a thousandth of the scene, so that rays from there meet a leaf
  // in the top plane.
  [[nodiscard]] double above_m() const { return hi_m.y + std::ldexp(extent_m(), -10); }
};

[[nodiscard]] SceneBox scene_box(const RadiationModel& model);

// Returns how far the boxes of the tree are padded, so that rounding in the walk loses no hit: 2^-19 of the scene's extent.
[[nodiscard]] float box_padding_m(const RadiationModel& model);

}  // namespace sunfleck
