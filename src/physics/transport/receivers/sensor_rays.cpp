#include "physics/transport/receivers/sensor_rays.h"

#include "base/check.h"
#include "physics/bvh/bvh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace sunfleck {

double SensorPoint::sees(const glm::dvec3& to_light) const {
  return response == SensorResponse::spherical ? 1.0 : std::max(0.0, glm::dot(normal, to_light));
}

SensorRays::SensorRays(const RadiationModel& model, const CounterLayout& layout)
    : model_(model),
      offset_m_(std::ldexp(layout.box.extent_m(), -17)),
      ground_y_m_(layout.box.ground_y_m),
      soil_back_(model.bands.size()) {
  if (!model.soil) return;
  for (const double reflectance : model.soil->reflectance) soil_front_.push_back({reflectance, 0.0});
}

std::vector<SensorPoint> SensorRays::points() const {
  std::vector<SensorPoint> points;
  for (const Sensor& sensor : model_.sensors)
    for (const glm::dvec3& scene_point_m : sensor.points_m) {
      SensorPoint point{scene_point_m - model_.canopy.origin_m, sensor.response, sensor.normal};
      if (model_.soil) point.point_m.y = std::max(point.point_m.y, ground_y_m_ + offset_m_);
      points.push_back(point);
    }
  return points;
}

MetSurface SensorRays::surface(const shared::Landing& landing) const {
  MetSurface met;
  if (landing.surface == shared::landed_on_ground) {
    met.point_m = {landing.place_a, ground_y_m_, landing.place_b};
    met.front = soil_front_;
    met.back = soil_back_;
    return met;
  }
  DCHECK(landing.surface, <, shared::landed_on_ground);
  met.element = landing.surface / 2;
  const bool upper = landing.surface % 2 == 0;
  const Triangle& corners = model_.canopy.corners[met.element];
  const glm::dvec3 corner(corners[0]);
  met.point_m = corner + (glm::dvec3(corners[1]) - corner) * double{landing.place_a} +
                (glm::dvec3(corners[2]) - corner) * double{landing.place_b};
  met.normal = unit_normal(corners) * (upper ? 1.0 : -1.0);
  const SurfaceOptics& optics = model_.optics[model_.canopy.optics_of[met.element]];
  met.front = upper ? optics.upper : optics.lower;
  met.back = upper ? optics.lower : optics.upper;
  if (upper) met.emission_w_m2 = optics.emission_w_m2;
  return met;
}

shared::Packet SensorRays::from(const SensorPoint& point, const glm::dvec3& direction) const {
  const double ahead_m = point.response == SensorResponse::cosine ? offset_m_ : 0.0;
  return start(point.point_m + point.normal * ahead_m, shared::no_element, direction);
}

shared::Packet SensorRays::from(const MetSurface& surface, const glm::dvec3& direction) const {
  const double side = glm::dot(surface.normal, direction) > 0.0 ? 1.0 : -1.0;
  return start(surface.point_m + surface.normal * (side * offset_m_), surface.element, direction);
}

shared::Packet SensorRays::start(glm::dvec3 point_m, std::uint32_t element, const glm::dvec3& direction) const {
  shared::Packet packet;
  packet.element = element;
  packet.direction = direction;
  packet.image = 0;
  const glm::dvec2 period_m = model_.canopy.period_m;
  if (period_m.x > 0.0) {  // move into the period that the tree covers
    const double dx = std::floor(point_m.x / period_m.x);
    const double dz = std::floor(point_m.z / period_m.y);
    point_m.x -= dx * period_m.x;
    point_m.z -= dz * period_m.y;
    if (element != shared::no_element) packet.image = pack_image(-static_cast<int>(dx), -static_cast<int>(dz));
  }
  packet.origin = point_m;
  return packet;
}

glm::dvec3 direction_on_sphere(double u, double v) {
  const double y = 1.0 - 2.0 * u;
  const double level = std::sqrt(std::max(0.0, 1.0 - y * y));
  const double angle = 2.0 * std::numbers::pi * v;
  return {level * std::cos(angle), y, level * std::sin(angle)};
}

// Returns a cosine-distributed direction: seen from the point of touch, points spread evenly over a unit sphere that touches
// the surface's plane are cosine-distributed.
glm::dvec3 direction_about(const glm::dvec3& normal, double u, double v) {
  const glm::dvec3 chord = normal + direction_on_sphere(u, v);
  const double length = glm::length(chord);
  return length > 1e-7 ? chord / length : normal;
}

}  // namespace sunfleck
