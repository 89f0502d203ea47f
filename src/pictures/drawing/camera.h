#pragma once
// The camera: one set of numbers for exported and interactive pictures, and for lines drawn over them.

#include "physics/canopy/plot.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

enum class Projection {
  perspective,   // a pinhole
  orthographic,  // parallel rays along `forward`
  fisheye,       // equidistant hemisphere about `forward`: distance from the circle's centre is proportional to the angle
};

// A camera. All positions are in one frame chosen by the caller, usually the scene's axes.
struct Camera {
  glm::dvec3 position_m{0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};  // `forward`, `right` and `up` are perpendicular unit vectors
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double tan_half_fov = 0.364;  // perspective: of the vertical field of view
  double aspect = 4.0 / 3.0;    // width over height
  Projection kind = Projection::perspective;
  double half_height_m = 1.0;          // orthographic: half the height that the picture shows
  glm::dvec2 circle_centre{0.5, 0.5};  // fisheye: place of `forward` in the picture, x and y as in ray_direction
  double circle_radius = 0.5;          // fisheye: radius of the circle 90 degrees from `forward`, in picture heights

  friend bool operator==(const Camera&, const Camera&) = default;
};

// Returns a camera that looks from `position_m` at `look_at_m` with Y up; straight up or down, X is up in the picture.
[[nodiscard]] Camera look_at(glm::dvec3 position_m, glm::dvec3 look_at_m, double vertical_fov_rad, double aspect);

// Length by which a chart's axes extend beyond the box of plot and canopy, as a share of its largest extent.
inline constexpr double axis_overhang = 0.08;

// Returns the corners of a box and the tips of the user's axes, which begin in a corner of its ground and extend beyond it.
[[nodiscard]] std::vector<glm::dvec3> box_with_axes(glm::dvec3 lo_m, glm::dvec3 hi_m, Axes axes);

// Returns a three-quarter view from the south-west and above that just fits all points with a margin. The margin leaves room
// for titles at the top and a legend at the right. Views need at least two different points.
[[nodiscard]] Camera three_quarter_view(std::span<const glm::dvec3> points_m, double aspect);

// Returns an orthographic view straight down that just fits all points: north is up, east is right. Margins are as above.
[[nodiscard]] Camera top_view(std::span<const glm::dvec3> points_m, double aspect);

// Returns a level orthographic view from the south that just fits all points: east is right, and rows, which run north-south,
// appear side by side as in a section across them. Margins are as above.
[[nodiscard]] Camera side_view(std::span<const glm::dvec3> points_m, double aspect);

// Returns a view straight up from a point that shows the upper hemisphere as a circle, as in canopy photographs: the zenith in
// the centre, the horizon on the edge, north up and therefore east left. Leaves room for titles, the legend and the letters
// around the circle.
[[nodiscard]] Camera fisheye_view(glm::dvec3 position_m, double aspect);

// Returns the origin of the ray through the point (x, y) of the picture; x runs 0..1 to the right, y 0..1 downwards.
[[nodiscard]] glm::dvec3 ray_origin(const Camera& camera, glm::dvec2 at);

// Returns the unit direction through the point (x, y). A fisheye's projection is continued outside its circle.
[[nodiscard]] glm::dvec3 ray_direction(const Camera& camera, glm::dvec2 at);

// The image of a point: x and y as above, and its depth along `forward` in m, which for a fisheye is the distance. project()
// returns none for a point that is not in front of the camera, or not in a fisheye's circle.
struct Appearance {
  glm::dvec2 at{0.0};
  double depth_m = 0.0;
};
[[nodiscard]] std::optional<Appearance> project(const Camera& camera, glm::dvec3 point_m);

// Returns the length in the scene, at that depth, of one pixel's height in a picture `height` pixels high.
[[nodiscard]] double pixel_size_m(const Camera& camera, int height, double depth_m);

}  // namespace sunfleck
