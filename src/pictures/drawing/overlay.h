#pragma once
// Draws flat marks over a finished picture, in pixels: x to the right, y downwards, (0, 0) is the upper left corner of the
// picture and (0.5, 0.5) the middle of its first pixel. Edges are anti-aliased; parts outside the picture are clipped.

#include "pictures/drawing/colour_scale.h"
#include "pictures/drawing/image.h"

#include <array>
#include <glm/vec2.hpp>

namespace sunfleck {

struct Rectangle {
  glm::dvec2 lo{0.0};
  glm::dvec2 hi{0.0};
};

struct Paint {
  Colour colour{};       // linear
  double opacity = 1.0;  // 0..1
};

struct Corners {
  double radius_px = 0.0;
};

// Blends `paint` into a pixel, of which it covers `coverage` (0..1). Blends linear values, as light adds.
void blend(std::array<std::uint8_t, 3>& pixel, const Paint& paint, double coverage);

// The whole pixels within the picture that a rectangle touches: columns [left, right), rows [top, bottom).
struct PixelRange {
  int left = 0, right = 0, top = 0, bottom = 0;
};
[[nodiscard]] PixelRange pixels_in(const Rectangle& rectangle, int width, int height);

// Corners in either order of rotation.
using FlatTriangle = std::array<glm::dvec2, 3>;

// Returns the share of a pixel, given by its middle, that a triangle covers (0..1): 1/2 where an edge passes through the
// middle.
[[nodiscard]] double triangle_coverage(const FlatTriangle& corners, glm::dvec2 at);
// Returns the share of a pixel that a line with round ends covers.
[[nodiscard]] double line_coverage(glm::dvec2 from, glm::dvec2 to, double width_px, glm::dvec2 at);

void fill_triangle(Image& image, const FlatTriangle& corners, const Paint& paint);
void draw_flat_line(Image& image, glm::dvec2 from, glm::dvec2 to, double width_px, const Paint& paint);

void fill_rectangle(Image& image, const Rectangle& rectangle, Corners corners, const Paint& paint);

// Draws a line of `width_px` along the inside of the rectangle's edge.
void outline_rectangle(Image& image, const Rectangle& rectangle, Corners corners, double width_px, const Paint& paint);

}  // namespace sunfleck
