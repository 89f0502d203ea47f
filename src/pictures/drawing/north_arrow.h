#pragma once
// Draws an arrow that points north as the camera sees it.

#include "pictures/drawing/camera.h"
#include "pictures/drawing/image.h"
#include "pictures/drawing/text.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sunfleck {

// The circle that arrow and letter fill, in pixels.
struct NorthArrowPlace {
  glm::dvec2 centre_px{0.0};
  double radius_px = 0.0;
};

// Returns in which direction a line to the north runs through a point of the picture of a camera that is no fisheye: to the
// right and upwards. In perspective the direction depends on the point; one outside the picture counts as the nearest one in
// it, and one behind the camera as the middle. The length is 0 where the line is seen end-on, and 1 or more where it is seen
// from the side.
[[nodiscard]] glm::dvec2 apparent_north(const Camera& camera, glm::dvec3 at_m);

// Draws the arrow with the letter N at its tip, as north appears at `at_m`. Where that is within 6 degrees of the line of
// sight, an arrow seen end-on is drawn instead: a ring with a cross for north ahead, with a dot for north behind the camera.
// Draws nothing where the letter would be smaller than 5 pixels, and nothing for a fisheye, which has the points of the compass
// around it.
void draw_north_arrow(Image& image, const Typeface& face, const Camera& camera, glm::dvec3 at_m, const NorthArrowPlace& place);

}  // namespace sunfleck
