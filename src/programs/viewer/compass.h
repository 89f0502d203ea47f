#pragma once
// The compass over a window's picture: the points of the compass as the camera sees them, and the sun. It takes the place of the
// picture's north arrow.

#include "physics/light/sun.h"
#include "pictures/drawing/camera.h"

#include <glm/vec2.hpp>
#include <optional>

namespace sunfleck {

// Returns the place on a compass of radius 1 of a direction of that azimuth and elevation: x to the right, y up, the zenith in
// the middle, the horizon on the rim. Ahead is up; in a view straight down or up it is what the picture has at its upper edge.
[[nodiscard]] glm::dvec2 place_on_compass(const Camera& camera, double azimuth_rad, double elevation_rad);

// Where the compass lies in the window, px.
struct CompassPlace {
  glm::vec2 centre_px{0.0F};
  float radius_px = 0.0F;  // of the horizon
  float reach_px = 0.0F;   // of the disc, which holds the letters too
};
// Returns the place over the north arrow of a picture that begins at `left_px`, which the disc covers.
[[nodiscard]] CompassPlace compass_place(float left_px, float width_px, float height_px);

// Draws it with Dear ImGui within a frame, below the panels. The sun is shown while it is above the horizon.
void draw_compass(const CompassPlace& place, const Camera& camera, const std::optional<SunPosition>& sun);

}  // namespace sunfleck
