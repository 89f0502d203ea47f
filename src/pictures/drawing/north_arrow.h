#pragma once
// Draws an arrow that points north as the camera sees it.

#include "pictures/drawing/camera.h"
#include "pictures/drawing/image.h"
#include "pictures/drawing/text.h"

#include <glm/vec2.hpp>

namespace sunfleck {

// The circle that arrow and letter fill, in pixels.
struct NorthArrowPlace {
  glm::dvec2 centre_px{0.0};
  double radius_px = 0.0;
};

// Returns north as it appears in the picture of a camera that is no fisheye: to the right and upwards. The length is 1 if north
// lies in the plane of the picture, and 0 if the camera looks along it.
[[nodiscard]] glm::dvec2 apparent_north(const Camera& camera);

// Draws the arrow with the letter N at its tip. Where the camera looks within 6 degrees of north or south, an arrow seen end-on
// is drawn instead: a ring with a cross for north ahead, with a dot for north behind the camera. Draws nothing where the letter
// would be smaller than 5 pixels, and nothing for a fisheye, which has the points of the compass around it.
void draw_north_arrow(Image& image, const Typeface& face, const Camera& camera, const NorthArrowPlace& place);

}  // namespace sunfleck
