#include "pictures/drawing/scene_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace sunfleck {
namespace {

glm::dvec2 to_pixels(const Appearance& appearance, const Image& image) {
  return {appearance.at.x * image.width, appearance.at.y * image.height};
}

// Returns the rows that are both in the range and in `seen`.
PixelRange seen_rows(PixelRange range, const SurfaceImage& seen) {
  range.top = std::max(range.top, seen.first_row);
  range.bottom = std::min(range.bottom, seen.first_row + seen.height);
  return range;
}

// Returns the share of a pixel's samples that see nothing nearer than `depth_m`. Differences below two pixel sizes are ignored,
// as are surfaces within one pixel size of the ground.
double visible_share(const SeenScene& scene, const Image& image, int column, int row, double depth_m) {
  const SurfaceImage& seen = scene.seen;
  const glm::dvec2 middle((column + 0.5) / image.width, (row + 0.5) / image.height);
  const glm::dvec3 ray = ray_direction(scene.camera, middle);
  const double base_y_m = ray_origin(scene.camera, middle).y;
  const double rise = ray.y / glm::dot(ray, scene.camera.forward);
  const std::size_t first = (static_cast<std::size_t>(row - seen.first_row) * seen.width + column) * seen.samples;
  int visible = 0;
  for (std::size_t sample = first; sample < first + seen.samples; ++sample) {
    const double sample_depth_m = seen.depth_m[sample];
    const double pixel_m = pixel_size_m(scene.camera, image.height, sample_depth_m);
    const bool hides = seen.surface[sample] != SurfaceImage::nothing && sample_depth_m + 2.0 * pixel_m < depth_m &&
                       std::abs(base_y_m + rise * sample_depth_m) > pixel_m;
    if (!hides) ++visible;
  }
  return static_cast<double>(visible) / seen.samples;
}

// A segment as it appears: its ends in pixels, and their depths.
struct Stroke {
  glm::dvec2 from{0.0}, to{0.0};
  double from_depth_m = 0.0, to_depth_m = 0.0;

  Projection kind = Projection::perspective;

  // Returns the depth at the share `t` of the way in the picture; in perspective its reciprocal is linear there.
  [[nodiscard]] double depth_m(double t) const {
    if (kind == Projection::orthographic) return (1.0 - t) * from_depth_m + t * to_depth_m;
    return 1.0 / ((1.0 - t) / from_depth_m + t / to_depth_m);
  }
};

// Returns the part of the segment in front of the camera; none if it is wholly behind.
std::optional<Stroke> appearance(const SeenScene& scene, const Image& image, const Segment& segment) {
  const auto depth = [&](glm::dvec3 point) { return glm::dot(point - scene.camera.position_m, scene.camera.forward); };
  const double nearest_m = 1e-3 * glm::distance(segment.from_m, segment.to_m);
  Segment part = segment;
  const double from_m = depth(part.from_m);
  const double to_m = depth(part.to_m);
  if (std::max(from_m, to_m) <= nearest_m) return std::nullopt;
  if (std::min(from_m, to_m) < nearest_m) {
    const glm::dvec3 cut_m = glm::mix(part.from_m, part.to_m, (nearest_m - from_m) / (to_m - from_m));
    (from_m < to_m ? part.from_m : part.to_m) = cut_m;
  }
  const std::optional<Appearance> from = project(scene.camera, part.from_m);
  const std::optional<Appearance> to = project(scene.camera, part.to_m);
  if (!from || !to) return std::nullopt;
  return Stroke{to_pixels(*from, image), to_pixels(*to, image), from->depth_m, to->depth_m, scene.camera.kind};
}

void draw_stroke(Image& image, const SeenScene& scene, const Stroke& stroke, double width_px, const Paint& paint) {
  const double reach = 0.5 * width_px + 0.5;
  const glm::dvec2 along = stroke.to - stroke.from;
  const double length2 = std::max(glm::dot(along, along), 1e-12);
  const PixelRange rows =
      seen_rows(pixels_in({glm::min(stroke.from, stroke.to) - reach, glm::max(stroke.from, stroke.to) + reach}, image.width,
                          image.height),
                scene.seen);
  for (int row = rows.top; row < rows.bottom; ++row) {
    // The part of the line within reach of this row, and therefore the columns to look at.
    const auto share_at = [&](double y) { return std::clamp((y - stroke.from.y) / along.y, 0.0, 1.0); };
    const bool level = std::abs(along.y) < 1e-9;
    const double x0 = stroke.from.x + along.x * (level ? 0.0 : share_at(row + 0.5 - reach));
    const double x1 = stroke.from.x + along.x * (level ? 1.0 : share_at(row + 0.5 + reach));
    const PixelRange columns = pixels_in({{std::min(x0, x1) - reach, 0.0}, {std::max(x0, x1) + reach, 0.0}}, image.width, 0);
    for (int column = columns.left; column < columns.right; ++column) {
      const glm::dvec2 middle(column + 0.5, row + 0.5);
      const double t = std::clamp(glm::dot(middle - stroke.from, along) / length2, 0.0, 1.0);
      const double coverage = line_coverage(stroke.from, stroke.to, width_px, middle);
      if (coverage == 0.0) continue;
      const std::size_t pixel = static_cast<std::size_t>(row) * image.width + column;
      blend(image.pixels[pixel], paint, coverage * visible_share(scene, image, column, row, stroke.depth_m(t)));
    }
  }
}

void fill_seen_triangle(Image& image, const SeenScene& scene, const FlatTriangle& corners, double depth_m, const Paint& paint) {
  const Rectangle box = {glm::min(glm::min(corners[0], corners[1]), corners[2]) - 1.0,
                         glm::max(glm::max(corners[0], corners[1]), corners[2]) + 1.0};
  const PixelRange range = seen_rows(pixels_in(box, image.width, image.height), scene.seen);
  for (int row = range.top; row < range.bottom; ++row) {
    for (int column = range.left; column < range.right; ++column) {
      const double coverage = triangle_coverage(corners, {column + 0.5, row + 0.5});
      if (coverage == 0.0) continue;
      const std::size_t pixel = static_cast<std::size_t>(row) * image.width + column;
      blend(image.pixels[pixel], paint, coverage * visible_share(scene, image, column, row, depth_m));
    }
  }
}

}  // namespace

void draw_line(Image& image, const SeenScene& scene, const Segment& segment, double width_px, const Paint& paint) {
  if (const std::optional<Stroke> stroke = appearance(scene, image, segment))
    draw_stroke(image, scene, *stroke, width_px, paint);
}

void draw_arrow(Image& image, const SeenScene& scene, const Segment& segment, double width_px, const Paint& paint) {
  std::optional<Stroke> stroke = appearance(scene, image, segment);
  if (!stroke) return;
  const double head_length = 5.0 * width_px;
  const double head_half_width = 1.7 * width_px;
  const double length = glm::distance(stroke->from, stroke->to);
  if (length > head_length) {
    const glm::dvec2 along = (stroke->to - stroke->from) / length;
    const glm::dvec2 aside(-along.y, along.x);
    const glm::dvec2 base = stroke->to - head_length * along;
    fill_seen_triangle(image, scene, {stroke->to, base + head_half_width * aside, base - head_half_width * aside},
                       stroke->to_depth_m, paint);
    const double shaft = 1.0 - 0.8 * head_length / length;  // ends within the head
    stroke->to_depth_m = stroke->depth_m(shaft);
    stroke->to = glm::mix(stroke->from, stroke->to, shaft);
  }
  draw_stroke(image, scene, *stroke, width_px, paint);
}

}  // namespace sunfleck
