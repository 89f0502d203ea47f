#pragma once
// Lines that stand in the scene, drawn over its picture and hidden where a surface stands before them.

#include "view/camera.h"
#include "view/image.h"
#include "view/overlay.h"
#include "view/surface_image.h"

#include <glm/vec3.hpp>

namespace sunfleck {

// What lines are drawn over: of the whole picture only the rows that `seen` holds are drawn upon. A sample on the ground (y =
// 0, to a pixel's size) hides nothing, so that lines lie upon it. Not for a fisheye, in which lines are curved.
struct SeenScene {
  const SurfaceImage& seen;
  const Camera& camera;
};

struct Segment {
  glm::dvec3 from_m{0.0};
  glm::dvec3 to_m{0.0};
};

// A line of even width with round ends. Of each pixel the share of samples with a nearer surface stays as it is.
void draw_line(Image& image, const SeenScene& scene, const Segment& segment, double width_px, const Paint& paint);

// The same, ending in an arrow head in the plane of the picture whose point is at `to_m`; a line that runs so nearly along
// the view that the head would be longer than the line has none.
void draw_arrow(Image& image, const SeenScene& scene, const Segment& segment, double width_px, const Paint& paint);

}  // namespace sunfleck
