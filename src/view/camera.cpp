#include "view/camera.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <span>

namespace sunfleck {
namespace {

// The part of the picture that three_quarter_view fills, as tangents of the angles to `forward` for a half picture of 1.
// Kept free: a strip at the top for the titles, at the bottom for the footer, at the left for an axis' letter and at the right
// for the legend. The type's size, and so the width of letter and legend, follows the picture's height.
struct Window {
  double left, right, bottom, top;
};

Window free_window(double tan_half_fov, double aspect) {
  constexpr double top_margin = 0.15, bottom_margin = 0.085;
  const double left_margin = std::min(0.065 / aspect, 0.15);
  const double legend_width = std::min(0.36 / aspect, 0.4);
  const auto horizontal = [&](double x) { return (2.0 * x - 1.0) * tan_half_fov * aspect; };
  const auto vertical = [&](double y) { return (1.0 - 2.0 * y) * tan_half_fov; };
  return {horizontal(left_margin), horizontal(1.0 - legend_width), vertical(1.0 - bottom_margin), vertical(top_margin)};
}

struct Interval {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void take_in(double value_a, double value_b) {
    lo = std::min(lo, value_a);
    hi = std::max(hi, value_b);
  }
};

// Where the camera must stand, keeping its direction, so that all points just fit into the window. In coordinates (a, b, d)
// along right, up and forward a point appears at the tangent (a - a0)/(d - d0); that it lies between the tangents l and r is
// linear in the camera's (a0, d0):  a0 - l d0 <= min(a - l d)  and  a0 - r d0 >= max(a - r d).  The farthest-forward d0 for
// which an a0 exists is (min - max)/(r - l); the same holds for b with bottom and top.
glm::dvec3 fitting_position(const Camera& camera, const Window& window, std::span<const glm::dvec3> points_m) {
  Interval across, upwards;
  for (const glm::dvec3& point : points_m) {
    const double a = glm::dot(point, camera.right);
    const double b = glm::dot(point, camera.up);
    const double d = glm::dot(point, camera.forward);
    across.take_in(a - window.left * d, a - window.right * d);
    upwards.take_in(b - window.bottom * d, b - window.top * d);
  }
  const double d0 = std::min((across.lo - across.hi) / (window.right - window.left),
                             (upwards.lo - upwards.hi) / (window.top - window.bottom));
  const double a0 = 0.5 * (across.lo + window.left * d0 + across.hi + window.right * d0);
  const double b0 = 0.5 * (upwards.lo + window.bottom * d0 + upwards.hi + window.top * d0);
  return a0 * camera.right + b0 * camera.up + d0 * camera.forward;
}

}  // namespace

Camera look_at(glm::dvec3 position_m, glm::dvec3 look_at_m, double vertical_fov_rad, double aspect) {
  EXPECT(glm::distance(position_m, look_at_m), >, 0.0);
  EXPECT(vertical_fov_rad, >, 0.0);
  EXPECT(vertical_fov_rad, <, std::numbers::pi);
  EXPECT(aspect, >, 0.0);
  Camera camera;
  camera.position_m = position_m;
  camera.forward = glm::normalize(look_at_m - position_m);
  const glm::dvec3 across = glm::cross(camera.forward, glm::dvec3(0.0, 1.0, 0.0));
  constexpr double vertical = 1e-9;  // rad: nearer to the vertical than this, Y gives no direction in the picture
  camera.right =
      glm::normalize(glm::length(across) > vertical ? across : glm::cross(camera.forward, glm::dvec3(1.0, 0.0, 0.0)));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tan_half_fov = std::tan(0.5 * vertical_fov_rad);
  camera.aspect = aspect;
  return camera;
}

Camera three_quarter_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect) {
  constexpr double degree = std::numbers::pi / 180.0;
  constexpr double vertical_fov_rad = 26.0 * degree;  // mild perspective, as of a telephoto lens
  constexpr double elevation_rad = 27.0 * degree;
  constexpr double from_south_rad = 38.0 * degree;  // towards the west
  const glm::dvec3 extent_m = hi_m - lo_m;
  const double overhang_m = axis_overhang * std::max({extent_m.x, extent_m.y, extent_m.z});
  EXPECT(std::min({extent_m.x, extent_m.y, extent_m.z}), >=, 0.0);
  EXPECT(overhang_m, >, 0.0);

  std::array<glm::dvec3, 11> points_m;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    points_m[corner] = {(corner & 1U) != 0 ? hi_m.x : lo_m.x, (corner & 2U) != 0 ? hi_m.y : lo_m.y,
                        (corner & 4U) != 0 ? hi_m.z : lo_m.z};
  }
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 tip_m = lo_m;
    tip_m[axis] = hi_m[axis] + overhang_m;
    points_m[8U + static_cast<std::size_t>(axis)] = tip_m;
  }
  const glm::dvec3 towards_camera(std::cos(elevation_rad) * std::cos(from_south_rad), std::sin(elevation_rad),
                                  std::cos(elevation_rad) * std::sin(from_south_rad));
  Camera camera = look_at(towards_camera, glm::dvec3(0.0), vertical_fov_rad, aspect);
  camera.position_m = fitting_position(camera, free_window(camera.tan_half_fov, aspect), points_m);
  return camera;
}

glm::dvec3 ray_direction(const Camera& camera, glm::dvec2 at) {
  return glm::normalize(camera.forward + camera.right * ((2.0 * at.x - 1.0) * camera.tan_half_fov * camera.aspect) +
                        camera.up * ((1.0 - 2.0 * at.y) * camera.tan_half_fov));
}

std::optional<Projection> project(const Camera& camera, glm::dvec3 point_m) {
  const glm::dvec3 offset_m = point_m - camera.position_m;
  const double depth_m = glm::dot(offset_m, camera.forward);
  if (!(depth_m > 0.0)) return std::nullopt;
  const double half_height_m = depth_m * camera.tan_half_fov;
  return Projection{{0.5 + 0.5 * glm::dot(offset_m, camera.right) / (half_height_m * camera.aspect),
                     0.5 - 0.5 * glm::dot(offset_m, camera.up) / half_height_m},
                    depth_m};
}

}  // namespace sunfleck
