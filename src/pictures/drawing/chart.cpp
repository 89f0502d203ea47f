#include "pictures/drawing/chart.h"

#include "base/check.h"
#include "physics/canopy/axes.h"
#include "pictures/drawing/overlay.h"
#include "pictures/drawing/palette.h"
#include "pictures/drawing/scene_lines.h"
#include "pictures/drawing/text.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::array<std::string_view, 3> axis_names = {"X", "Y", "Z"};
constexpr std::array<std::string_view, 4> bearings = {"N", "E", "S", "W"};

// Sizes in pixels, all proportional to the picture's height. At the default 1200 pixels the smallest type measures 21, which
// stays readable at half size.
struct Layout {
  explicit Layout(double height)
      : margin(0.035 * height),
        title(0.030 * height),
        subtitle(0.0215 * height),
        label(0.0215 * height),
        footer(0.0175 * height),
        axis_letter(0.024 * height),
        axis_line(0.0030 * height),
        border_line(0.0022 * height) {}
  double margin, title, subtitle, label, footer, axis_letter, axis_line, border_line;
};

// Returns the sky's colour in a row of a picture of that height.
Colour background_of(int row, int height) {
  const Colour top = from_srgb(sky_top);
  const Colour bottom = from_srgb(sky_bottom);
  const double down = (row + 0.5) / height;
  Colour background{};
  for (std::size_t i = 0; i < 3; ++i) background[i] = top[i] + down * (bottom[i] - top[i]);
  return background;
}

void resolve(Image& image, const SurfaceImage& seen, std::span<const Colour> colours) {
  std::size_t sample = 0;
  for (int row = seen.first_row; row < seen.first_row + seen.height; ++row) {
    const Colour background = background_of(row, image.height);
    const std::array<std::uint8_t, 3> empty = to_srgb(background);
    Colour last = background;  // often that of the next pixel, too
    std::array<std::uint8_t, 3> encoded = empty;
    for (int column = 0; column < seen.width; ++column) {
      auto& pixel = image.pixels[static_cast<std::size_t>(row) * seen.width + column];
      bool any = false;
      Colour sum{};
      for (const std::size_t end = sample + seen.samples; sample < end; ++sample) {
        const std::uint32_t surface = seen.surface[sample];
        const bool sky = surface == SurfaceImage::nothing;
        any = any || !sky;
        DCHECK(sky || surface < colours.size(), ==, true);
        const Colour& colour = sky ? background : colours[surface];
        const bool dimmed = !seen.neighbour.empty() && seen.neighbour[sample] != 0;
        for (std::size_t i = 0; i < 3; ++i) sum[i] += dimmed ? 0.5 * (colour[i] + background[i]) : colour[i];
      }
      for (double& channel : sum) channel /= seen.samples;
      if (any && sum != last) encoded = to_srgb(last = sum);
      pixel = any ? encoded : empty;
    }
  }
}

void draw_border(Image& image, const SeenScene& scene, const Plot& plot, const Layout& layout) {
  const std::array<glm::dvec3, 4> corners = {
      {{0.0, 0.0, 0.0}, {plot.size_x_m, 0.0, 0.0}, {plot.size_x_m, 0.0, plot.size_z_m}, {0.0, 0.0, plot.size_z_m}}};
  for (std::size_t i = 0; i < 4; ++i) {
    draw_line(image, scene, {corners[i], corners[(i + 1) % 4]}, layout.border_line, {Colour{0.0, 0.0, 0.0}});
  }
}

// The user's axis, from the user's origin.
Segment axis_segment(const ChartFrame& frame, int axis) {
  const glm::dvec3 extent_m(frame.plot.size_x_m, frame.height_m, frame.plot.size_z_m);
  const glm::dvec3 along_axes_m = glm::abs(user_direction(frame.plot.axes, extent_m));
  glm::dvec3 to_m(0.0);
  to_m[axis] = along_axes_m[axis] + axis_overhang * std::max({extent_m.x, extent_m.y, extent_m.z});
  return {scene_position_m(frame.plot, glm::dvec3(0.0)), scene_position_m(frame.plot, to_m)};
}

// The letter of an axis seen end-on is placed opposite to the direction of the other axes.
void draw_axis_letters(Image& image, const Typeface& face, const ChartFrame& frame, const Layout& layout) {
  const glm::dvec2 size(image.width, image.height);
  std::array<glm::dvec2, 3> along{};  // px
  std::array<glm::dvec2, 3> tip{};
  std::array<bool, 3> seen{};
  for (int axis = 0; axis < 3; ++axis) {
    const Segment segment = axis_segment(frame, axis);
    const auto from = project(frame.camera, segment.from_m);
    const auto to = project(frame.camera, segment.to_m);
    if (!from || !to) continue;
    seen[axis] = true;
    tip[axis] = to->at * size;
    along[axis] = (to->at - from->at) * size;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!seen[axis]) continue;
    const auto outwards = [](glm::dvec2 v) { return glm::length(v) > 1.0 ? glm::normalize(v) : glm::dvec2(0.0, -1.0); };
    const bool end_on = glm::length(along[axis]) <= 1.0;
    const glm::dvec2 away = end_on ? outwards(-(along[0] + along[1] + along[2])) : outwards(along[axis]);
    draw_letter(image, face, axis_names[axis], tip[axis] + 0.85 * layout.axis_letter * away, layout.axis_letter,
                from_srgb(axis_srgb[axis]));
  }
}

// Draws the circle of a fisheye, the horizon, with the points of the compass around it.
void draw_horizon(Image& image, const Typeface& face, const Camera& camera, const Layout& layout) {
  const glm::dvec2 centre_px = camera.circle_centre * glm::dvec2(image.width, image.height);
  const double radius_px = camera.circle_radius * image.height + layout.border_line;  // the line lies outside the circle
  outline_rectangle(image, {centre_px - radius_px, centre_px + radius_px}, {radius_px}, layout.border_line, {from_srgb(ink)});
  const std::array<glm::dvec3, 4> directions = {{{-1, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 0, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 away(glm::dot(directions[i], camera.right), -glm::dot(directions[i], camera.up));
    if (glm::length(away) < 1e-6) continue;
    draw_letter(image, face, bearings[i], centre_px + (radius_px + 0.85 * layout.axis_letter) * glm::normalize(away),
                layout.axis_letter, from_srgb(ink));
  }
}

// Draws a line of text at `size_px`, or smaller so that it is no wider than `room_px`.
void draw_fitting(Image& image, const Typeface& face, std::string_view line, glm::dvec2 baseline_px, double size_px,
                  double room_px, const std::array<std::uint8_t, 3>& colour) {
  if (line.empty()) return;
  const double fit = std::min(1.0, room_px / face.width_px(line, size_px));
  draw_with_halo(image, face, line, baseline_px, size_px * fit, from_srgb(colour));
}

void draw_titles(Image& image, const Typeface& face, const ChartText& text, const Layout& layout) {
  const double room_px = image.width - 2.0 * layout.margin;
  const double title_y = layout.margin + Typeface::cap_height * layout.title;
  draw_fitting(image, face, text.title, {layout.margin, title_y}, layout.title, room_px, ink);
  draw_fitting(image, face, text.subtitle, {layout.margin, title_y + 1.6 * layout.subtitle}, layout.subtitle, room_px,
               grey_ink);
  draw_fitting(image, face, text.footer, {layout.margin, image.height - layout.margin}, layout.footer, room_px, grey_ink);
}

}  // namespace

NorthArrowPlace north_arrow_place(double width_px, double height_px) {
  const Layout layout(height_px);
  const double radius_px = 0.055 * height_px;
  const double footer_top = height_px - layout.margin - 2.0 * layout.footer;
  return {{width_px - layout.margin - radius_px, footer_top - radius_px}, radius_px};
}

ChartCanvas::ChartCanvas(const ChartFrame& frame, std::vector<Colour> colours)
    : frame_(frame), colours_(std::move(colours)), image_{frame.width, frame.height, {}} {
  EXPECT(std::min(frame.width, frame.height), >, 0);
  image_.pixels.resize(static_cast<std::size_t>(frame.width) * frame.height);
}

void ChartCanvas::paint(const SurfaceImage& seen) {
  EXPECT(std::min(seen.height, seen.samples), >, 0);
  EXPECT(seen.width, ==, frame_.width);
  EXPECT(seen.first_row, >=, 0);
  EXPECT(seen.first_row + seen.height, <=, frame_.height);
  const std::size_t samples = static_cast<std::size_t>(seen.width) * seen.height * seen.samples;
  EXPECT(seen.surface.size(), ==, samples);
  EXPECT(seen.depth_m.size(), ==, samples);
  EXPECT(seen.neighbour.empty() || seen.neighbour.size() == samples, ==, true);
  resolve(image_, seen, colours_);
  if (frame_.camera.kind == Projection::fisheye) return;
  const Layout layout(frame_.height);
  const SeenScene scene{seen, frame_.camera};
  draw_border(image_, scene, frame_.plot, layout);
  for (int axis = 0; axis < 3; ++axis) {
    draw_arrow(image_, scene, axis_segment(frame_, axis), layout.axis_line, {from_srgb(axis_srgb[axis])});
  }
}

Image ChartCanvas::finish(const ChartText& text) {
  const Layout layout(frame_.height);
  const Typeface face;
  if (frame_.camera.kind == Projection::fisheye) {
    draw_horizon(image_, face, frame_.camera, layout);
  } else {
    draw_axis_letters(image_, face, frame_, layout);
    const glm::dvec3 middle_m(0.5 * frame_.plot.size_x_m, 0.0, 0.5 * frame_.plot.size_z_m);
    draw_north_arrow(image_, face, frame_.camera, middle_m, north_arrow_place(frame_.width, frame_.height));
  }
  draw_titles(image_, face, text, layout);
  const double top_px = 0.135 * frame_.height;
  const LegendRoom room = {{frame_.width - layout.margin, top_px},
                           std::min(0.4 * frame_.width, frame_.width - 2.0 * layout.margin),
                           frame_.height - top_px - layout.margin};
  draw_legend(image_, face, text.legend, room, layout.label);
  return std::move(image_);
}

Image draw_chart(const SurfaceImage& seen, std::span<const Colour> colours, const Camera& camera, const Plot& plot,
                 double height_m, const ChartText& text) {
  ChartCanvas canvas({seen.width, seen.height, camera, plot, height_m}, {colours.begin(), colours.end()});
  canvas.paint(seen);
  return canvas.finish(text);
}

}  // namespace sunfleck
