#pragma once
// Moves a camera by hand. A level horizon stays level.

#include "pictures/drawing/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace sunfleck {

// A camera and the point it turns about, `distance_m` (> 0) straight ahead. A fisheye always looks straight up: it moves but
// does not turn.
struct HandCamera {
  Camera camera;
  double distance_m = 1.0;
};

// Returns the camera with the point of its line of sight that is nearest to `centre_m` as the point to turn about.
[[nodiscard]] HandCamera in_hand(const Camera& camera, glm::dvec3 centre_m);

// Turns the camera around that point: `right_rad` to the right (counter-clockwise seen from above), `up_rad` upwards, at most
// to straight above or below. Does nothing for a fisheye.
void orbit(HandCamera& hand, double right_rad, double up_rad);

// Moves sideways and upwards, by shares of the picture's height at the distance of that point. A fisheye moves east and north,
// by shares of its height above `floor_y_m` or of one metre, whichever is larger.
void pan(HandCamera& hand, glm::dvec2 by, double floor_y_m);

// Moves towards the point (factor below 1) or away from it; with parallel rays it shows less or more instead. Does nothing for
// a fisheye.
void zoom(HandCamera& hand, double factor);

// Moves so that the whole box is in view, without changing direction. Does nothing for a fisheye.
void fit(HandCamera& hand, glm::dvec3 lo_m, glm::dvec3 hi_m);

// Moves right, up and ahead relative to the view, m; a fisheye moves east, up and north.
void fly(HandCamera& hand, glm::dvec3 by_m);

// Returns "[camera]" with position, look_at and fov as in a file of a scene with that plot, in its axes; empty for a camera
// that is not a pinhole.
[[nodiscard]] std::string camera_toml(const HandCamera& hand, const Plot& plot);

}  // namespace sunfleck
