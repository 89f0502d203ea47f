#pragma once
// Moving a camera by hand. A level horizon stays level.

#include "view/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace sunfleck {

// A camera and the point it turns about, `distance_m` (> 0) straight ahead. A fisheye stands on a vertical axis: it is moved,
// not turned.
struct HandCamera {
  Camera camera;
  double distance_m = 1.0;
};

// Turns about the point of the camera's view that is nearest to `centre_m`.
[[nodiscard]] HandCamera in_hand(const Camera& camera, glm::dvec3 centre_m);

// Around that point: `right_rad` to the right, seen from above counter-clockwise, `up_rad` upwards, as far as straight above
// and straight below. Nothing for a fisheye.
void orbit(HandCamera& hand, double right_rad, double up_rad);

// Sideways and upwards, by shares of the picture's height at the distance of that point; a fisheye is moved to the east and to
// the north by shares of its height above `floor_y_m` or of a metre, whichever is more.
void pan(HandCamera& hand, glm::dvec2 by, double floor_y_m);

// Towards the point (factor below 1) or away from it; parallel rays show less or more instead. Nothing for a fisheye.
void zoom(HandCamera& hand, double factor);

// Looks at the whole box, in the direction it looks. Nothing for a fisheye.
void fit(HandCamera& hand, glm::dvec3 lo_m, glm::dvec3 hi_m);

// To the right, upwards and ahead of where it looks, m; a fisheye to the east, upwards and to the north.
void fly(HandCamera& hand, glm::dvec3 by_m);

// "[camera]" with position, look_at and fov, as a scene file has it. Empty for cameras that are no pinholes.
[[nodiscard]] std::string camera_toml(const HandCamera& hand);

}  // namespace sunfleck
