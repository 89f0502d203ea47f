#pragma once
// Draws flat marks over a finished picture, in pixels: x to the right, y downwards, (0, 0) is the upper left corner of the
// picture and (0.5, 0.5) the middle of its first pixel. Edges are anti-aliased; parts outside the picture are clipped.

#include "pictures/drawing/colour_scale.h"
#include "pictures/drawing/image.h"

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

void fill_rectangle(Image& image, const Rectangle& rectangle, Corners corners, const Paint& paint);

// Draws a line of `width_px` along the inside of the rectangle's edge.
void outline_rectangle(Image& image, const Rectangle& rectangle, Corners corners, double width_px, const Paint& paint);

}  // namespace sunfleck
