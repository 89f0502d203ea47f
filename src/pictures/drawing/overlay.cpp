#include "pictures/drawing/overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

// Returns the signed distance to the edge of a rounded rectangle, negative inside.
double edge_distance_px(const Rectangle& rectangle, double radius_px, glm::dvec2 at) {
  const glm::dvec2 half = 0.5 * (rectangle.hi - rectangle.lo);
  const glm::dvec2 beyond = glm::abs(at - 0.5 * (rectangle.lo + rectangle.hi)) - half + radius_px;
  return glm::length(glm::max(beyond, 0.0)) + std::min(std::max(beyond.x, beyond.y), 0.0) - radius_px;
}

// Blends every pixel touched by `coverage_at(distance)`, given the signed distance of its middle from the edge.
template <class CoverageAt>
void paint_rectangle(Image& image, const Rectangle& rectangle, Corners corners, const Paint& paint, CoverageAt coverage_at) {
  const PixelRange range = pixels_in(rectangle, image.width, image.height);
  for (int row = range.top; row < range.bottom; ++row) {
    for (int column = range.left; column < range.right; ++column) {
      const double distance_px = edge_distance_px(rectangle, corners.radius_px, {column + 0.5, row + 0.5});
      const std::size_t pixel = static_cast<std::size_t>(row) * image.width + column;
      blend(image.pixels[pixel], paint, coverage_at(distance_px));
    }
  }
}

double inside(double distance_px) {
  return std::clamp(0.5 - distance_px, 0.0, 1.0);
}

}  // namespace

void blend(std::array<std::uint8_t, 3>& pixel, const Paint& paint, double coverage) {
  const double share = paint.opacity * coverage;
  if (share <= 0.0) return;
  Colour mixed = from_srgb(pixel);
  for (std::size_t i = 0; i < 3; ++i) mixed[i] += share * (paint.colour[i] - mixed[i]);
  pixel = to_srgb(mixed);
}

PixelRange pixels_in(const Rectangle& rectangle, int width, int height) {
  const auto within = [](double px, int size) { return static_cast<int>(std::clamp(px, 0.0, static_cast<double>(size))); };
  return {within(std::floor(rectangle.lo.x), width), within(std::ceil(rectangle.hi.x), width),
          within(std::floor(rectangle.lo.y), height), within(std::ceil(rectangle.hi.y), height)};
}

void fill_rectangle(Image& image, const Rectangle& rectangle, Corners corners, const Paint& paint) {
  paint_rectangle(image, rectangle, corners, paint, inside);
}

void outline_rectangle(Image& image, const Rectangle& rectangle, Corners corners, double width_px, const Paint& paint) {
  paint_rectangle(image, rectangle, corners, paint,
                  [&](double distance_px) { return inside(distance_px) - inside(distance_px + width_px); });
}

}  // namespace sunfleck
