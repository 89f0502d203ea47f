#pragma once
// The pinhole camera: one set of numbers for exported and interactive pictures, and for lines drawn over them.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace sunfleck {

// All positions in the frame that the caller uses throughout (the scene's axes).
struct Camera {
  glm::dvec3 position_m{0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};  // unit; so are right and up, the three perpendicular to each other
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double tan_half_fov = 0.364;  // vertical
  double aspect = 4.0 / 3.0;    // width over height
};

// A camera that looks from `position_m` at `look_at_m` with Y up (looking straight up or down: X is up in the picture).
[[nodiscard]] Camera look_at(glm::dvec3 position_m, glm::dvec3 look_at_m, double vertical_fov_rad, double aspect);

// How far a chart's axes reach beyond the box of plot and canopy, as a share of its largest extent.
inline constexpr double axis_overhang = 0.08;

// A three-quarter view, from the south-west and above, in which the whole box fits with a margin, as do axes from its lowest
// corner that reach beyond it. The margin at the top leaves room for titles, at the right for a legend.
[[nodiscard]] Camera three_quarter_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect);

// Direction (unit) through the point (x, y) of the picture; x runs 0..1 to the right, y 0..1 downwards.
[[nodiscard]] glm::dvec3 ray_direction(const Camera& camera, glm::dvec2 at);

// Where a point appears: x, y as above and the distance along `forward`, m; none if it is not in front of the camera.
struct Projection {
  glm::dvec2 at{0.0};
  double depth_m = 0.0;
};
[[nodiscard]] std::optional<Projection> project(const Camera& camera, glm::dvec3 point_m);

}  // namespace sunfleck
