#include "pictures/drawing/camera_motion.h"

#include "base/units.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace sunfleck {
namespace {

constexpr glm::dvec3 above(0.0, 1.0, 0.0);
constexpr glm::dvec3 north(-1.0, 0.0, 0.0);
constexpr glm::dvec3 east(0.0, 0.0, -1.0);
constexpr double least_distance_m = 0.01;
constexpr double largest_distance_m = 1e5;

glm::dvec3 turned_about_vertical(const glm::dvec3& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

// Returns the height that the picture shows at the point the camera turns about.
double shown_height_m(const HandCamera& hand) {
  if (hand.camera.kind == Projection::orthographic) return 2.0 * hand.camera.half_height_m;
  return 2.0 * hand.camera.tan_half_fov * hand.distance_m;
}

}  // namespace

HandCamera in_hand(const Camera& camera, glm::dvec3 centre_m) {
  const double ahead = glm::dot(centre_m - camera.position_m, camera.forward);
  return {camera, ahead > least_distance_m ? ahead : 1.0};
}

void orbit(HandCamera& hand, double right_rad, double up_rad) {
  Camera& camera = hand.camera;
  if (camera.kind == Projection::fisheye) return;
  const glm::dvec3 pivot = camera.position_m + hand.distance_m * camera.forward;
  const glm::dvec3 right = glm::normalize(turned_about_vertical({camera.right.x, 0.0, camera.right.z}, right_rad));
  const glm::dvec3 level = glm::cross(above, right);  // straight ahead and level
  const glm::dvec3 ahead = turned_about_vertical(camera.forward, right_rad);
  const double now = std::atan2(ahead.y, glm::dot(ahead, level));
  const double next = std::clamp(now - up_rad, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  camera.right = right;
  camera.forward = glm::normalize(std::cos(next) * level + std::sin(next) * above);
  camera.up = glm::normalize(std::cos(next) * above - std::sin(next) * level);
  camera.position_m = pivot - hand.distance_m * camera.forward;
}

void pan(HandCamera& hand, glm::dvec2 by, double floor_y_m) {
  Camera& camera = hand.camera;
  if (camera.kind == Projection::fisheye) {
    const double step_m = std::max(1.0, camera.position_m.y - floor_y_m);
    camera.position_m += step_m * (by.x * east + by.y * north);
    return;
  }
  camera.position_m += shown_height_m(hand) * (by.x * camera.right + by.y * camera.up);
}

void zoom(HandCamera& hand, double factor) {
  Camera& camera = hand.camera;
  if (camera.kind == Projection::fisheye) return;
  if (camera.kind == Projection::orthographic) {
    camera.half_height_m = std::clamp(camera.half_height_m * factor, least_distance_m, largest_distance_m);
    return;
  }
  const double distance_m = std::clamp(hand.distance_m * factor, least_distance_m, largest_distance_m);
  camera.position_m += (hand.distance_m - distance_m) * camera.forward;
  hand.distance_m = distance_m;
}

void fit(HandCamera& hand, glm::dvec3 lo_m, glm::dvec3 hi_m) {
  Camera& camera = hand.camera;
  if (camera.kind == Projection::fisheye) return;
  const glm::dvec3 centre = 0.5 * (lo_m + hi_m);
  const double radius = std::max(least_distance_m, 0.5 * glm::length(hi_m - lo_m));
  const double narrow = std::min(1.0, camera.aspect);
  if (camera.kind == Projection::orthographic) {
    camera.half_height_m = radius / narrow;
    hand.distance_m = std::max(hand.distance_m, 2.0 * radius);
  } else {
    hand.distance_m = radius / std::sin(std::atan(camera.tan_half_fov * narrow));
  }
  camera.position_m = centre - hand.distance_m * camera.forward;
}

void fly(HandCamera& hand, glm::dvec3 by_m) {
  Camera& camera = hand.camera;
  camera.position_m += camera.kind == Projection::fisheye
                           ? by_m.x * east + by_m.y * above + by_m.z * north
                           : by_m.x * camera.right + by_m.y * camera.up + by_m.z * camera.forward;
}

std::string camera_toml(const HandCamera& hand, const Plot& plot) {
  const Camera& camera = hand.camera;
  if (camera.kind != Projection::perspective) return {};
  const glm::dvec3 from = user_position_m(plot, camera.position_m);
  const glm::dvec3 at = user_position_m(plot, camera.position_m + hand.distance_m * camera.forward);
  const double fov_deg = in_degrees(2.0 * std::atan(camera.tan_half_fov));
  return fmt::format("[camera]\nposition = [{:.4f}, {:.4f}, {:.4f}]\nlook_at = [{:.4f}, {:.4f}, {:.4f}]\nfov = {:.4f}\n",
                     from.x, from.y, from.z, at.x, at.y, at.z, fov_deg);
}

}  // namespace sunfleck
