#pragma once
// Virtual instruments that a user adds to a scene. They do not stop any ray.

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sunfleck {

// A map of the light that comes down through a horizontal plane.
struct PlaneReceiver {
  double height_m = 0.0;  // scene axes
  int cells_x = 1;        // along X, south
  int cells_z = 1;        // along Z, west

  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(cells_x) * static_cast<std::size_t>(cells_z); }
};

// Returns the name of a plane after its height in whole millimetres, e.g. "plane_0.500": the stem of its files.
[[nodiscard]] std::string plane_stem(double height_m);

enum class SensorResponse { cosine, spherical };

// Points that measure light. `cosine` gives the irradiance on a plane with the given normal, from the side it points to;
// `spherical` gives the flux per cross-section of a sphere (fluence rate), from all directions.
struct Sensor {
  std::string name;
  std::vector<glm::dvec3> points_m;  // scene axes, at least one
  SensorResponse response = SensorResponse::cosine;
  glm::dvec3 normal{0.0, 1.0, 0.0};  // unit vector
};

}  // namespace sunfleck
