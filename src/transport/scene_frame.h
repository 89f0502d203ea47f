#pragma once
// The scene's measures in the canopy's local frame: its box, its ground, the margins that rounding needs.

#include "transport/model.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace sunfleck {

// Elements and the plot's rectangle at the ground. Without soil the ground is the lower of y = 0 and the lowest element.
struct SceneBox {
  glm::dvec3 lo_m{0.0}, hi_m{0.0};
  double ground_y_m = 0.0;
  double seen_y_m = 0.0;  // top of the box, or the highest receiver: light comes in from above it

  [[nodiscard]] double extent_m() const { return std::max({hi_m.x - lo_m.x, hi_m.y - lo_m.y, hi_m.z - lo_m.z}); }
  // Above the highest element by a thousandth of the scene: rays from there meet a leaf that lies in the top plane.
  [[nodiscard]] double above_m() const { return hi_m.y + std::ldexp(extent_m(), -10); }
};

[[nodiscard]] SceneBox scene_box(const RadiationModel& model);

// How far boxes of the tree are padded, so that rounding in the walk loses nothing: 2^-19 of the scene's extent.
[[nodiscard]] float box_padding_m(const RadiationModel& model);

}  // namespace sunfleck
