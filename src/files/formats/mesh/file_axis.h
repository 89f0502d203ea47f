#pragma once
// The axis of a mesh file that points up.

#include "physics/canopy/axes.h"

#include <glm/vec3.hpp>

namespace sunfleck {

enum class FileAxis { x, y, z };

// Converts a direction of a file's axes to the scene's: X south, Y up, Z west. A z-up file has x east, y north; an x-up file has y
// east, z north; for a y-up file see scene_direction_of_y_up.
[[nodiscard]] inline glm::dvec3 scene_direction(FileAxis up, Axes axes, const glm::dvec3& v) {
  if (up == FileAxis::y) return scene_direction_of_y_up(axes, v);
  return up == FileAxis::z ? glm::dvec3(-v.y, v.z, -v.x) : glm::dvec3(-v.z, v.x, -v.y);
}

}  // namespace sunfleck
