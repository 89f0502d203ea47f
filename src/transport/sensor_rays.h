#pragma once
// Where sensors' rays start: points that measure, and places where a ray that went backwards met a surface.

#include "shared/layout.h"
#include "transport/counters.h"
#include "transport/model.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sunfleck {

struct SensorPoint {
  glm::dvec3 point_m{0.0};  // local frame
  SensorResponse response = SensorResponse::cosine;
  glm::dvec3 normal{0.0, 1.0, 0.0};  // unit

  // How much of light from there, given per area normal to it, the point sees.
  [[nodiscard]] double sees(const glm::dvec3& to_light) const;
};

// A place on a side, seen from that side's front.
struct MetSurface {
  glm::dvec3 point_m{0.0};
  glm::dvec3 normal{0.0, 1.0, 0.0};  // of the side that was met
  std::uint32_t element = shared::no_element;
  std::span<const FaceOptics> front, back;  // [waveband], for light that arrives on the side that was met, and on the other
  std::span<const double> emission_w_m2;    // [waveband], exitance of the side that was met; empty: no lamp
};

class SensorRays {
 public:
  // All must outlive it.
  SensorRays(const RadiationModel& model, const CounterLayout& layout);

  // The model's points in order, in the local frame.
  [[nodiscard]] std::vector<SensorPoint> points() const;

  // `landing` on an element or on the soil plane.
  [[nodiscard]] MetSurface surface(const shared::Landing& landing) const;

  [[nodiscard]] shared::Packet from(const SensorPoint& point, const glm::dvec3& direction) const;
  // From the side that the direction points away from.
  [[nodiscard]] shared::Packet from(const MetSurface& surface, const glm::dvec3& direction) const;

 private:
  [[nodiscard]] shared::Packet start(glm::dvec3 point_m, std::uint32_t element, const glm::dvec3& direction) const;

  const RadiationModel& model_;
  double offset_m_;
  double ground_y_m_;
  std::vector<FaceOptics> soil_front_, soil_back_;  // [waveband]
};

// Even over the unit sphere, for u and v in [0, 1).
[[nodiscard]] glm::dvec3 direction_on_sphere(double u, double v);

// Cosine-distributed about the unit normal.
[[nodiscard]] glm::dvec3 direction_about(const glm::dvec3& normal, double u, double v);

}  // namespace sunfleck
