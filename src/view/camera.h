#pragma once
// The camera: one set of numbers for exported and interactive pictures, and for lines drawn over them.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace sunfleck {

enum class Projection {
  perspective,   // a pinhole
  orthographic,  // parallel rays along `forward`
  fisheye,       // equidistant hemisphere about `forward`: distance from the circle's centre is proportional to the angle
};

// All positions in the frame that the caller uses throughout (the scene's axes).
struct Camera {
  glm::dvec3 position_m{0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};  // unit; so are right and up, the three perpendicular to each other
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double tan_half_fov = 0.364;  // perspective: vertical
  double aspect = 4.0 / 3.0;    // width over height
  Projection kind = Projection::perspective;
  double half_height_m = 1.0;          // orthographic: half of what the picture's height shows
  glm::dvec2 circle_centre{0.5, 0.5};  // fisheye: where `forward` appears; x, y as in ray_direction
  double circle_radius = 0.5;          // fisheye: of the circle 90 degrees from `forward`, in heights of the picture
};

// A camera that looks from `position_m` at `look_at_m` with Y up (looking straight up or down: X is up in the picture).
[[nodiscard]] Camera look_at(glm::dvec3 position_m, glm::dvec3 look_at_m, double vertical_fov_rad, double aspect);

// How far a chart's axes reach beyond the box of plot and canopy, as a share of its largest extent.
inline constexpr double axis_overhang = 0.08;

// A three-quarter view, from the south-west and above, in which the whole box fits with a margin, as do axes from its lowest
// corner that reach beyond it. The margin at the top leaves room for titles, at the right for a legend.
[[nodiscard]] Camera three_quarter_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect);

// Straight down, orthographic, the whole box in view: north is up in the picture, east right. Margins as above.
[[nodiscard]] Camera top_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect);

// Level from the south towards north, orthographic, the whole box in view: east is right, and rows, which run north-south,
// stand side by side as in a section across them. Margins as above.
[[nodiscard]] Camera side_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect);

// Straight up from a point, the upper hemisphere in a circle as canopy photographs are taken: zenith in its centre, north up
// and so east left, the horizon on its edge. The circle leaves room for titles, legend and the letters around it.
[[nodiscard]] Camera fisheye_view(glm::dvec3 position_m, double aspect);

// Whether rays leave through the point (x, y) of the picture; a fisheye has none outside its circle.
[[nodiscard]] bool in_view(const Camera& camera, glm::dvec2 at);

// Where the ray through the point (x, y) of the picture begins; x runs 0..1 to the right, y 0..1 downwards.
[[nodiscard]] glm::dvec3 ray_origin(const Camera& camera, glm::dvec2 at);

// Direction (unit) through the point (x, y), which a fisheye continues outside its circle.
[[nodiscard]] glm::dvec3 ray_direction(const Camera& camera, glm::dvec2 at);

// Where a point appears: x, y as above and its depth, m, along `forward`; a fisheye's depth is the distance. None if it is not
// in front of the camera, for a fisheye not in its circle.
struct Appearance {
  glm::dvec2 at{0.0};
  double depth_m = 0.0;
};
[[nodiscard]] std::optional<Appearance> project(const Camera& camera, glm::dvec3 point_m);

// The length in the scene, at that depth, of a pixel's height in a picture `height` pixels high.
[[nodiscard]] double pixel_size_m(const Camera& camera, int height, double depth_m);

}  // namespace sunfleck
