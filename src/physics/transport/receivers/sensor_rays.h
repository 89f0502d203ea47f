#pragma once
// The starts of sensor rays: measuring points, and places where a ray followed backwards met a surface.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "shared/layout.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sunfleck {

struct SensorPoint {
  glm::dvec3 point_m{0.0};  // local frame
  SensorResponse response = SensorResponse::cosine;
  glm::dvec3 normal{0.0, 1.0, 0.0};  // unit vector

  // Returns the share of light from that direction, given per area normal to it, that the point measures.
  [[nodiscard]] double sees(const glm::dvec3& to_light) const;
};

// A place on a side, seen from the front of that side.
struct MetSurface {
  glm::dvec3 point_m{0.0};
  glm::dvec3 normal{0.0, 1.0, 0.0};  // of the side that was met
  std::uint32_t element = shared::no_element;
  // [waveband], for light that arrives on the side that was met, and on the other side.
  std::span<const FaceOptics> front, back;
  std::span<const double> emission_w_m2;  // [waveband], exitance of the side that was met; empty if it is no lamp
};

class SensorRays {
 public:
  // All arguments must outlive the object.
  SensorRays(const RadiationModel& model, const CounterLayout& layout);

  // Returns the points of the model's sensors in order, in the local frame.
  [[nodiscard]] std::vector<SensorPoint> points() const;

  // Returns the place of a landing on an element or on the soil plane.
  [[nodiscard]] MetSurface surface(const shared::Landing& landing) const;

  // Returns a ray that starts at the point.
  [[nodiscard]] shared::Packet from(const SensorPoint& point, const glm::dvec3& direction) const;
  // Returns a ray that starts on the side facing the direction.
  [[nodiscard]] shared::Packet from(const MetSurface& surface, const glm::dvec3& direction) const;

 private:
  [[nodiscard]] shared::Packet start(glm::dvec3 point_m, std::uint32_t element, const glm::dvec3& direction) const;

  const RadiationModel& model_;
  double offset_m_;
  double ground_y_m_;
  std::vector<FaceOptics> soil_front_, soil_back_;  // [waveband]
};

// Returns a direction uniform over the unit sphere, for u and v in [0, 1).
[[nodiscard]] glm::dvec3 direction_on_sphere(double u, double v);

// Returns a direction that is cosine-distributed about the unit normal.
[[nodiscard]] glm::dvec3 direction_about(const glm::dvec3& normal, double u, double v);

}  // namespace sunfleck
