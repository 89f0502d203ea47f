#pragma once
// What a user puts into a scene to look at its light. Receivers stop no ray.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sunfleck {

// A map of the light that comes down through a horizontal plane.
struct PlaneReceiver {
  double height_m = 0.0;  // scene's axes
  int cells_x = 1;        // along X, south
  int cells_z = 1;        // along Z, west
};

enum class SensorResponse { cosine, spherical };

// Points that measure light. Cosine: irradiance on a plane with that normal, from the side it points to. Spherical: the
// irradiance of a sphere's cross-section (fluence rate), from everywhere.
struct Sensor {
  std::string name;
  std::vector<glm::dvec3> points_m;  // scene's axes, at least one
  SensorResponse response = SensorResponse::cosine;
  glm::dvec3 normal{0.0, 1.0, 0.0};  // unit
};

}  // namespace sunfleck
