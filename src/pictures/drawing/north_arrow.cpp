#include "pictures/drawing/north_arrow.h"

#include "pictures/drawing/overlay.h"
#include "pictures/drawing/palette.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace sunfleck {
namespace {

constexpr glm::dvec3 to_north(-1.0, 0.0, 0.0);
constexpr double end_on = 0.1;  // apparent length, the sine of 6 degrees
constexpr double least_letter_px = 5.0;

// Sizes as shares of the place's radius.
constexpr double letter_size = 0.44, letter_distance = 0.80;
constexpr double tip = 0.50, tail = -0.62, notch = -0.34, half_width = 0.33;
constexpr double ring_radius = 0.34, line_width = 0.045;

// An arrow of two halves, dark and pale, as on maps. `ahead` is a unit vector in pixels, y downwards.
void draw_needle(Image& image, const NorthArrowPlace& place, glm::dvec2 ahead) {
  const double size = place.radius_px;
  const glm::dvec2 aside(-ahead.y, ahead.x);
  const auto at = [&](double along, double across) { return place.centre_px + size * (along * ahead + across * aside); };
  const std::array<glm::dvec2, 4> outline = {at(tip, 0.0), at(tail, half_width), at(notch, 0.0), at(tail, -half_width)};
  const double width_px = std::max(1.0, line_width * size);
  for (std::size_t i = 0; i < 4; ++i) {
    draw_flat_line(image, outline[i], outline[(i + 1) % 4], 3.0 * width_px, {from_srgb(sky_top)});
  }
  fill_triangle(image, {outline[0], outline[1], outline[2]}, {from_srgb(sky_top)});
  fill_triangle(image, {outline[0], outline[2], outline[3]}, {from_srgb(ink)});
  for (std::size_t i = 0; i < 4; ++i) {
    draw_flat_line(image, outline[i], outline[(i + 1) % 4], width_px, {from_srgb(ink)});
  }
}

// An arrow along the view: a ring around its feathers, or around its tip.
void draw_end_on(Image& image, const NorthArrowPlace& place, bool is_ahead) {
  const double radius_px = ring_radius * place.radius_px;
  const double width_px = std::max(1.0, 1.5 * line_width * place.radius_px);
  const Rectangle ring = {place.centre_px - radius_px, place.centre_px + radius_px};
  fill_rectangle(image, ring, {radius_px}, {from_srgb(sky_top)});
  outline_rectangle(image, ring, {radius_px}, width_px, {from_srgb(ink)});
  if (!is_ahead) {
    const double dot_px = 0.3 * radius_px;
    fill_rectangle(image, {place.centre_px - dot_px, place.centre_px + dot_px}, {dot_px}, {from_srgb(ink)});
    return;
  }
  const double arm_px = 0.6 * radius_px;
  for (const double turn : {-1.0, 1.0}) {
    const glm::dvec2 arm = arm_px * glm::dvec2(1.0, turn);
    draw_flat_line(image, place.centre_px - arm, place.centre_px + arm, width_px, {from_srgb(ink)});
  }
}

}  // namespace

glm::dvec2 apparent_north(const Camera& camera, glm::dvec3 at_m) {
  const glm::dvec2 level(glm::dot(to_north, camera.right), glm::dot(to_north, camera.up));
  const std::optional<Appearance> seen = project(camera, at_m);
  if (camera.kind != Projection::perspective || !seen) return level;
  // The derivative of the projection along the line, times the depth.
  const glm::dvec2 at = glm::clamp(seen->at, 0.0, 1.0);
  const glm::dvec2 slope = camera.tan_half_fov * glm::dvec2((2.0 * at.x - 1.0) * camera.aspect, 1.0 - 2.0 * at.y);
  return level - glm::dot(to_north, camera.forward) * slope;
}

void draw_north_arrow(Image& image, const Typeface& face, const Camera& camera, glm::dvec3 at_m, const NorthArrowPlace& place) {
  const double letter_px = letter_size * place.radius_px;
  if (camera.kind == Projection::fisheye || letter_px < least_letter_px) return;
  const glm::dvec2 seen = apparent_north(camera, at_m);
  const bool is_end_on = glm::length(seen) < end_on;
  const glm::dvec2 ahead = is_end_on ? glm::dvec2(0.0, -1.0) : glm::normalize(glm::dvec2(seen.x, -seen.y));
  if (is_end_on) {
    draw_end_on(image, place, glm::dot(to_north, camera.forward) > 0.0);
  } else {
    draw_needle(image, place, ahead);
  }
  draw_letter(image, face, "N", place.centre_px + letter_distance * place.radius_px * ahead, letter_px, from_srgb(ink));
}

}  // namespace sunfleck
