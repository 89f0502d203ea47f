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

// Blends every pixel in the box by `coverage_at(middle of the pixel)`.
template <class CoverageAt>
void paint_box(Image& image, const Rectangle& box, const Paint& paint, CoverageAt coverage_at) {
  const PixelRange range = pixels_in(box, image.width, image.height);
  for (int row = range.top; row < range.bottom; ++row) {
    for (int column = range.left; column < range.right; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * image.width + column;
      blend(image.pixels[pixel], paint, coverage_at(glm::dvec2(column + 0.5, row + 0.5)));
    }
  }
}

// Blends every pixel touched by `coverage_at(distance)`, given the signed distance of its middle from the edge.
template <class CoverageAt>
void paint_rectangle(Image& image, const Rectangle& rectangle, Corners corners, const Paint& paint, CoverageAt coverage_at) {
  paint_box(image, rectangle, paint,
            [&](glm::dvec2 at) { return coverage_at(edge_distance_px(rectangle, corners.radius_px, at)); });
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

double triangle_coverage(const FlatTriangle& corners, glm::dvec2 at) {
  const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
  const double turn = cross(corners[1] - corners[0], corners[2] - corners[0]) < 0.0 ? -1.0 : 1.0;
  double inside_px = 1.0;  // smallest distance from the three edges, inwards
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 edge = glm::normalize(corners[(i + 1) % 3] - corners[i]);
    inside_px = std::min(inside_px, turn * cross(edge, at - corners[i]));
  }
  return std::clamp(inside_px + 0.5, 0.0, 1.0);
}

double line_coverage(glm::dvec2 from, glm::dvec2 to, double width_px, glm::dvec2 at) {
  const glm::dvec2 along = to - from;
  const double t = std::clamp(glm::dot(at - from, along) / std::max(glm::dot(along, along), 1e-12), 0.0, 1.0);
  return std::clamp(0.5 * width_px + 0.5 - glm::distance(at, from + t * along), 0.0, 1.0);
}

void fill_triangle(Image& image, const FlatTriangle& corners, const Paint& paint) {
  const Rectangle box = {glm::min(glm::min(corners[0], corners[1]), corners[2]) - 1.0,
                         glm::max(glm::max(corners[0], corners[1]), corners[2]) + 1.0};
  paint_box(image, box, paint, [&](glm::dvec2 at) { return triangle_coverage(corners, at); });
}

void draw_flat_line(Image& image, glm::dvec2 from, glm::dvec2 to, double width_px, const Paint& paint) {
  const double reach = 0.5 * width_px + 0.5;
  paint_box(image, {glm::min(from, to) - reach, glm::max(from, to) + reach}, paint,
            [&](glm::dvec2 at) { return line_coverage(from, to, width_px, at); });
}

void fill_rectangle(Image& image, const Rectangle& rectangle, Corners corners, const Paint& paint) {
  paint_rectangle(image, rectangle, corners, paint, inside);
}

void outline_rectangle(Image& image, const Rectangle& rectangle, Corners corners, double width_px, const Paint& paint) {
  paint_rectangle(image, rectangle, corners, paint,
                  [&](double distance_px) { return inside(distance_px) - inside(distance_px + width_px); });
}

}  // namespace sunfleck
