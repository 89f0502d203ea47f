#include "pictures/drawing/camera.h"

#include "base/check.h"
#include "base/units.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace sunfleck {
namespace {

// The part of the picture that the scene may fill, measured from the middle; half the picture is `half_height` high, as a
// tangent or a length. The free strips hold the titles at the top, the footer at the bottom, an axis' letter at the left and
// the legend at the right. The type size, and so the width of letter and legend, scales with the picture's height.
struct FreeWindow {
  double left, right, bottom, top;
};

FreeWindow free_window(double half_height, double aspect) {
  constexpr double top_margin = 0.15, bottom_margin = 0.085;
  const double left_margin = std::min(0.065 / aspect, 0.15);
  const double legend_width = std::min(0.36 / aspect, 0.4 + 0.035 / aspect);
  const auto horizontal = [&](double x) { return (2.0 * x - 1.0) * half_height * aspect; };
  const auto vertical = [&](double y) { return (1.0 - 2.0 * y) * half_height; };
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

// Returns the position, for a fixed direction, from which all points just fit into the window. In coordinates (a, b, d) along
// right, up and forward a point appears at the tangent (a - a0)/(d - d0). That it lies between the tangents l and r is linear
// in the camera's (a0, d0):  a0 - l d0 <= min(a - l d)  and  a0 - r d0 >= max(a - r d).  The farthest-forward d0 for which an
// a0 exists is (min - max)/(r - l); the same holds for b with bottom and top.
glm::dvec3 fitting_position(const Camera& camera, const FreeWindow& window, std::span<const glm::dvec3> points_m) {
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

// Returns an orthographic camera of that direction that shows the smallest picture containing the points and stands in front of
// them all.
Camera fitting_orthographic(glm::dvec3 forward, glm::dvec3 right, double aspect, std::span<const glm::dvec3> points_m) {
  EXPECT(aspect, >, 0.0);
  Camera camera;
  camera.kind = Projection::orthographic;
  camera.aspect = aspect;
  camera.forward = forward;
  camera.right = right;
  camera.up = glm::cross(right, forward);
  Interval across, upwards, along;
  const auto take_in = [](Interval& interval, double value) { interval.take_in(value, value); };
  for (const glm::dvec3& point : points_m) {
    take_in(across, glm::dot(point, camera.right));
    take_in(upwards, glm::dot(point, camera.up));
    take_in(along, glm::dot(point, camera.forward));
  }
  const FreeWindow unit = free_window(1.0, aspect);
  camera.half_height_m =
      std::max((across.hi - across.lo) / (unit.right - unit.left), (upwards.hi - upwards.lo) / (unit.top - unit.bottom));
  const double a0 = 0.5 * (across.lo + across.hi - camera.half_height_m * (unit.left + unit.right));
  const double b0 = 0.5 * (upwards.lo + upwards.hi - camera.half_height_m * (unit.bottom + unit.top));
  const double d0 = along.lo - 2.0 * camera.half_height_m;
  camera.position_m = a0 * camera.right + b0 * camera.up + d0 * camera.forward;
  return camera;
}

// Returns the point (x, y) of the picture relative to its middle, in half heights of the picture.
glm::dvec2 from_middle(const Camera& camera, glm::dvec2 at) {
  return {(2.0 * at.x - 1.0) * camera.aspect, 1.0 - 2.0 * at.y};
}

// Returns the point relative to the centre of a fisheye's circle, in radii of the circle.
glm::dvec2 from_zenith(const Camera& camera, glm::dvec2 at) {
  return glm::dvec2((at.x - camera.circle_centre.x) * camera.aspect, camera.circle_centre.y - at.y) / camera.circle_radius;
}

std::optional<Appearance> project_hemisphere(const Camera& camera, glm::dvec3 offset_m) {
  const double distance_m = glm::length(offset_m);
  const double ahead_m = glm::dot(offset_m, camera.forward);
  if (!(distance_m > 0.0) || ahead_m < 0.0) return std::nullopt;
  const glm::dvec2 aside_m(glm::dot(offset_m, camera.right), glm::dot(offset_m, camera.up));
  const double aside = glm::length(aside_m);
  const double radii = std::atan2(aside, ahead_m) / (0.5 * std::numbers::pi);
  const glm::dvec2 from_centre = aside > 0.0 ? aside_m * (radii * camera.circle_radius / aside) : glm::dvec2(0.0);
  return Appearance{camera.circle_centre + glm::dvec2(from_centre.x / camera.aspect, -from_centre.y), distance_m};
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
  // rad: nearer to the vertical than this, Y defines no direction in the picture.
  constexpr double vertical = 1e-9;
  camera.right =
      glm::normalize(glm::length(across) > vertical ? across : glm::cross(camera.forward, glm::dvec3(1.0, 0.0, 0.0)));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tan_half_fov = std::tan(0.5 * vertical_fov_rad);
  camera.aspect = aspect;
  return camera;
}

std::vector<glm::dvec3> box_with_axes(glm::dvec3 lo_m, glm::dvec3 hi_m, Axes axes) {
  const glm::dvec3 extent_m = hi_m - lo_m;
  const double overhang_m = axis_overhang * std::max({extent_m.x, extent_m.y, extent_m.z});
  EXPECT(std::min({extent_m.x, extent_m.y, extent_m.z}), >=, 0.0);
  EXPECT(overhang_m, >, 0.0);
  std::vector<glm::dvec3> points_m;
  for (unsigned corner = 0; corner < 8; ++corner) {
    points_m.emplace_back((corner & 1U) != 0 ? hi_m.x : lo_m.x, (corner & 2U) != 0 ? hi_m.y : lo_m.y,
                          (corner & 4U) != 0 ? hi_m.z : lo_m.z);
  }
  // The axes of east_north_up run from the south-west corner towards lower X and Z.
  const bool from_south_west = axes == Axes::east_north_up;
  const glm::dvec3 origin_m = from_south_west ? glm::dvec3(hi_m.x, lo_m.y, hi_m.z) : lo_m;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 tip_m = origin_m;
    tip_m[axis] = from_south_west && axis != 1 ? lo_m[axis] - overhang_m : hi_m[axis] + overhang_m;
    points_m.push_back(tip_m);
  }
  return points_m;
}

Camera three_quarter_view(std::span<const glm::dvec3> points_m, double aspect) {
  constexpr double vertical_fov_rad = 26.0 * degree;  // mild perspective, as of a telephoto lens
  constexpr double elevation_rad = 27.0 * degree;
  constexpr double from_south_rad = 38.0 * degree;  // towards the west
  const glm::dvec3 towards_camera(std::cos(elevation_rad) * std::cos(from_south_rad), std::sin(elevation_rad),
                                  std::cos(elevation_rad) * std::sin(from_south_rad));
  Camera camera = look_at(towards_camera, glm::dvec3(0.0), vertical_fov_rad, aspect);
  camera.position_m = fitting_position(camera, free_window(camera.tan_half_fov, aspect), points_m);
  return camera;
}

Camera top_view(std::span<const glm::dvec3> points_m, double aspect) {
  return fitting_orthographic({0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}, aspect, points_m);
}

Camera side_view(std::span<const glm::dvec3> points_m, double aspect) {
  return fitting_orthographic({-1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, aspect, points_m);
}

Camera fisheye_view(glm::dvec3 position_m, double aspect) {
  EXPECT(aspect, >, 0.0);
  constexpr double letter_room = 0.035;  // around the circle, in picture heights
  const FreeWindow window = free_window(0.5, aspect);
  Camera camera;
  camera.kind = Projection::fisheye;
  camera.aspect = aspect;
  camera.position_m = position_m;
  camera.forward = {0.0, 1.0, 0.0};
  camera.right = {0.0, 0.0, 1.0};
  camera.up = {-1.0, 0.0, 0.0};
  camera.circle_centre = {0.5 + 0.5 * (window.left + window.right) / aspect, 0.5 - 0.5 * (window.bottom + window.top)};
  const double room = 0.5 * std::min(window.right - window.left, window.top - window.bottom);
  camera.circle_radius = std::max(room - letter_room, 0.5 * room);
  return camera;
}

glm::dvec3 ray_origin(const Camera& camera, glm::dvec2 at) {
  if (camera.kind != Projection::orthographic) return camera.position_m;
  const glm::dvec2 aside_m = from_middle(camera, at) * camera.half_height_m;
  return camera.position_m + camera.right * aside_m.x + camera.up * aside_m.y;
}

glm::dvec3 ray_direction(const Camera& camera, glm::dvec2 at) {
  if (camera.kind == Projection::orthographic) return camera.forward;
  if (camera.kind == Projection::fisheye) {
    const glm::dvec2 radii = from_zenith(camera, at);
    const double angle_rad = 0.5 * std::numbers::pi * glm::length(radii);
    const glm::dvec2 aside = angle_rad > 0.0 ? radii * (std::sin(angle_rad) / glm::length(radii)) : glm::dvec2(0.0);
    return glm::normalize(std::cos(angle_rad) * camera.forward + aside.x * camera.right + aside.y * camera.up);
  }
  const glm::dvec2 aside = from_middle(camera, at) * camera.tan_half_fov;
  return glm::normalize(camera.forward + camera.right * aside.x + camera.up * aside.y);
}

std::optional<Appearance> project(const Camera& camera, glm::dvec3 point_m) {
  const glm::dvec3 offset_m = point_m - camera.position_m;
  if (camera.kind == Projection::fisheye) return project_hemisphere(camera, offset_m);
  const double depth_m = glm::dot(offset_m, camera.forward);
  if (!(depth_m > 0.0)) return std::nullopt;
  const double half_height_m = camera.kind == Projection::orthographic ? camera.half_height_m : depth_m * camera.tan_half_fov;
  return Appearance{{0.5 + 0.5 * glm::dot(offset_m, camera.right) / (half_height_m * camera.aspect),
                     0.5 - 0.5 * glm::dot(offset_m, camera.up) / half_height_m},
                    depth_m};
}

double pixel_size_m(const Camera& camera, int height, double depth_m) {
  switch (camera.kind) {
    case Projection::perspective:
      return 2.0 * camera.tan_half_fov * depth_m / height;
    case Projection::orthographic:
      return 2.0 * camera.half_height_m / height;
    case Projection::fisheye:
      return 0.5 * std::numbers::pi / camera.circle_radius * depth_m / height;
  }
  return 0.0;
}

}  // namespace sunfleck
