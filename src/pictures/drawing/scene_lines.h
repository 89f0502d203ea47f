#pragma once
// Draws lines placed in the scene over its picture, hidden behind nearer surfaces.

#include "pictures/drawing/camera.h"
#include "pictures/drawing/image.h"
#include "pictures/drawing/overlay.h"
#include "pictures/drawing/surface_image.h"

#include <glm/vec3.hpp>

namespace sunfleck {

// What lines are drawn over: only the rows of the picture that `seen` holds are changed. A sample on the ground (y = 0 within a
// pixel's size) hides nothing, so that lines can lie on the ground. Not for a fisheye, in which lines are curved.
struct SeenScene {
  const SurfaceImage& seen;
  const Camera& camera;
};

struct Segment {
  glm::dvec3 from_m{0.0};
  glm::dvec3 to_m{0.0};
};

// Draws a line of constant width with round ends. In each pixel, the share of samples with a nearer surface stays unchanged.
void draw_line(Image& image, const SeenScene& scene, const Segment& segment, double width_px, const Paint& paint);

// Draws such a line with an arrow head in the plane of the picture whose point is at `to_m`. A line so nearly parallel to the
// view that the head would be longer than the line gets no head.
void draw_arrow(Image& image, const SeenScene& scene, const Segment& segment, double width_px, const Paint& paint);

}  // namespace sunfleck
