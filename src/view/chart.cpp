#include "view/chart.h"

#include "base/check.h"
#include "view/overlay.h"
#include "view/scene_lines.h"
#include "view/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <string_view>

namespace sunfleck {
namespace {

// sRGB, like all colours of the furniture: near-black ink, greys for what comes second.
constexpr std::array<std::uint8_t, 3> ink = {32, 36, 42};
constexpr std::array<std::uint8_t, 3> grey_ink = {84, 90, 98};
constexpr std::array<std::uint8_t, 3> sky_top = {251, 252, 253};
constexpr std::array<std::uint8_t, 3> sky_bottom = {233, 237, 241};
constexpr std::array<std::array<std::uint8_t, 3>, 3> axis_srgb = {{{205, 32, 38}, {24, 138, 52}, {34, 76, 208}}};
constexpr std::array<std::string_view, 3> axis_names = {"X", "Y", "Z"};
constexpr std::string_view range_dash = " – ";

// Sizes in pixels, all in proportion to the picture's height; at the default 1200 pixels the smallest type measures 21, which
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

Image resolve(const SurfaceImage& seen, std::span<const Colour> colours) {
  Image image{seen.width, seen.height, {}};
  image.pixels.resize(static_cast<std::size_t>(seen.width) * seen.height);
  const Colour top = from_srgb(sky_top);
  const Colour bottom = from_srgb(sky_bottom);
  auto sample = seen.surface.begin();
  for (int row = 0; row < seen.height; ++row) {
    const double down = (row + 0.5) / seen.height;
    Colour background{};
    for (std::size_t i = 0; i < 3; ++i) background[i] = top[i] + down * (bottom[i] - top[i]);
    const std::array<std::uint8_t, 3> empty = to_srgb(background);
    for (int column = 0; column < seen.width; ++column, sample += seen.samples) {
      auto& pixel = image.pixels[static_cast<std::size_t>(row) * seen.width + column];
      pixel = empty;
      if (std::all_of(sample, sample + seen.samples, [](std::uint32_t s) { return s == SurfaceImage::nothing; })) continue;
      Colour sum{};
      for (auto it = sample; it != sample + seen.samples; ++it) {
        DCHECK(*it == SurfaceImage::nothing || *it < colours.size(), ==, true);
        const Colour& colour = *it == SurfaceImage::nothing ? background : colours[*it];
        for (std::size_t i = 0; i < 3; ++i) sum[i] += colour[i];
      }
      for (double& channel : sum) channel /= seen.samples;
      pixel = to_srgb(sum);
    }
  }
  return image;
}

void draw_border(Image& image, const SeenScene& scene, const Plot& plot, const Layout& layout) {
  const std::array<glm::dvec3, 4> corners = {
      {{0.0, 0.0, 0.0}, {plot.size_x_m, 0.0, 0.0}, {plot.size_x_m, 0.0, plot.size_z_m}, {0.0, 0.0, plot.size_z_m}}};
  for (std::size_t i = 0; i < 4; ++i) {
    draw_line(image, scene, {corners[i], corners[(i + 1) % 4]}, layout.border_line, {Colour{0.0, 0.0, 0.0}});
  }
}

// A letter in the middle of `at_px`, with a thin pale edge that keeps it legible on any ground.
void draw_letter(Image& image, const Typeface& face, std::string_view letter, glm::dvec2 at_px, double size_px, Colour colour) {
  const glm::dvec2 baseline_px = at_px + 0.5 * size_px * glm::dvec2(-face.width_px(letter, 1.0), Typeface::cap_height);
  const double edge_px = std::max(1.0, 0.07 * size_px);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      face.draw(image, letter, baseline_px + edge_px * glm::dvec2(x, y), size_px, from_srgb(sky_top));
    }
  }
  face.draw(image, letter, baseline_px, size_px, colour);
}

void draw_axes(Image& image, const SeenScene& scene, const Typeface& face, glm::dvec3 extent_m, const Layout& layout) {
  const double overhang_m = axis_overhang * std::max({extent_m.x, extent_m.y, extent_m.z});
  for (int axis = 0; axis < 3; ++axis) {
    const Colour colour = from_srgb(axis_srgb[axis]);
    Segment segment;
    segment.to_m[axis] = extent_m[axis] + overhang_m;
    draw_arrow(image, scene, segment, layout.axis_line, {colour});

    const auto from = project(scene.camera, segment.from_m);
    const auto to = project(scene.camera, segment.to_m);
    if (!from || !to) continue;
    const glm::dvec2 size(image.width, image.height);
    const glm::dvec2 along = (to->at - from->at) * size;
    const double length = glm::length(along);
    const glm::dvec2 outwards = length > 1.0 ? along / length : glm::dvec2(0.0, -1.0);
    draw_letter(image, face, axis_names[axis], to->at * size + 0.85 * layout.axis_letter * outwards, layout.axis_letter,
                colour);
  }
}

// Draws a line at `size_px`, or smaller so that it is no wider than `room_px`.
void draw_fitting(Image& image, const Typeface& face, std::string_view line, glm::dvec2 baseline_px, double size_px,
                  double room_px, const std::array<std::uint8_t, 3>& colour) {
  if (line.empty()) return;
  const double fit = std::min(1.0, room_px / face.width_px(line, size_px));
  face.draw(image, line, baseline_px, size_px * fit, from_srgb(colour));
}

void draw_titles(Image& image, const Typeface& face, const ChartText& text, const Layout& layout) {
  const double room_px = image.width - 2.0 * layout.margin;
  const double title_y = layout.margin + Typeface::cap_height * layout.title;
  draw_fitting(image, face, text.title, {layout.margin, title_y}, layout.title, room_px, ink);
  draw_fitting(image, face, text.subtitle, {layout.margin, title_y + 1.6 * layout.subtitle}, layout.subtitle, room_px,
               grey_ink);
  draw_fitting(image, face, text.footer, {layout.margin, image.height - layout.margin}, layout.footer, room_px, grey_ink);
}

// A legend's label, cut at its dash: both numbers are set flush right, so that their digits stand in columns.
struct Label {
  std::string_view from, to;  // `to` is empty where there is no dash

  explicit Label(std::string_view label) : from(label) {
    const std::size_t dash = label.find(range_dash);
    if (dash == std::string_view::npos) return;
    from = label.substr(0, dash);
    to = label.substr(dash + range_dash.size());
  }
};

// The legend's panel: where its parts lie for a type size of 1, from the panel's upper left corner.
struct LegendPlan {
  std::string_view title, unit;
  double from_width = 0.0, dash_width = 0.0, to_width = 0.0;
  double width = 0.0, height = 0.0;

  static constexpr double padding = 0.9, swatch_width = 1.9, swatch_height = 1.05, gap = 0.7, row = 1.65;
  static constexpr double title_line = 1.35, below_title = 0.35;

  LegendPlan(const Typeface& face, const ChartText& text) : title(text.legend_title) {
    const std::size_t comma = title.rfind(", ");
    if (comma != std::string_view::npos) {
      unit = title.substr(comma + 2);
      title = title.substr(0, comma);
    }
    double lone_width = 0.0;
    for (const LegendEntry& entry : text.legend) {
      const Label label(entry.label);
      if (label.to.empty()) {
        lone_width = std::max(lone_width, face.width_px(label.from, 1.0));
      } else {
        from_width = std::max(from_width, face.width_px(label.from, 1.0));
        to_width = std::max(to_width, face.width_px(label.to, 1.0));
        dash_width = face.width_px(range_dash, 1.0);
      }
    }
    const double labels = std::max(from_width + dash_width + to_width, lone_width);
    width = 2.0 * padding + std::max({face.width_px(title, 1.0), face.width_px(unit, 1.0), swatch_width + gap + labels});
    height = rows_top() + row * static_cast<double>(text.legend.size()) - (row - swatch_height) + padding;
  }

  [[nodiscard]] double rows_top() const {
    return padding + title_line * ((title.empty() ? 0 : 1) + (unit.empty() ? 0 : 1)) + (title.empty() ? 0.0 : below_title);
  }
};

void draw_label(Image& image, const Typeface& face, const LegendPlan& plan, const Label& label, glm::dvec2 baseline_px,
                double size) {
  const Colour colour = from_srgb(ink);
  if (label.to.empty()) {
    const double column = plan.to_width > 0.0 ? plan.from_width + plan.dash_width + plan.to_width : 0.0;
    const double indent = std::max(0.0, column - face.width_px(label.from, 1.0));
    face.draw(image, label.from, baseline_px + glm::dvec2(size * indent, 0.0), size, colour);
    return;
  }
  const auto flush_right = [&](std::string_view part, double right) {
    face.draw(image, part, baseline_px + glm::dvec2(size * right - face.width_px(part, size), 0.0), size, colour);
  };
  flush_right(label.from, plan.from_width);
  flush_right(range_dash, plan.from_width + plan.dash_width);
  flush_right(label.to, plan.from_width + plan.dash_width + plan.to_width);
}

void draw_legend(Image& image, const Typeface& face, const ChartText& text, const Layout& layout) {
  if (text.legend.empty()) return;
  const LegendPlan plan(face, text);
  const double room_px = std::min(0.4 * image.width, image.width - 2.0 * layout.margin);
  const double size = std::min(layout.label, room_px / plan.width);
  const glm::dvec2 corner(image.width - layout.margin - size * plan.width, 0.135 * image.height);
  const Rectangle panel = {corner, corner + size * glm::dvec2(plan.width, plan.height)};
  fill_rectangle(image, panel, {0.4 * size}, {Colour{1.0, 1.0, 1.0}, 0.86});
  outline_rectangle(image, panel, {0.4 * size}, std::max(1.0, 0.05 * size), {from_srgb({196, 202, 208})});

  glm::dvec2 at = corner + size * LegendPlan::padding;
  for (const std::string_view line : {plan.title, plan.unit}) {
    if (line.empty()) continue;
    const glm::dvec2 baseline_px = at + glm::dvec2(0.0, Typeface::cap_height * size);
    face.draw(image, line, baseline_px, size, from_srgb(line.data() == plan.title.data() ? ink : grey_ink));
    at.y += LegendPlan::title_line * size;
  }
  at.y = corner.y + plan.rows_top() * size;
  for (const LegendEntry& entry : text.legend) {
    const Rectangle swatch = {at, at + size * glm::dvec2(LegendPlan::swatch_width, LegendPlan::swatch_height)};
    fill_rectangle(image, swatch, {0.12 * size}, {entry.colour});
    outline_rectangle(image, swatch, {0.12 * size}, std::max(1.0, 0.05 * size), {from_srgb(ink), 0.35});
    const glm::dvec2 baseline_px(swatch.hi.x + LegendPlan::gap * size,
                                 0.5 * (swatch.lo.y + swatch.hi.y) + 0.5 * Typeface::cap_height * size);
    draw_label(image, face, plan, Label(entry.label), baseline_px, size);
    at.y += LegendPlan::row * size;
  }
}

}  // namespace

std::vector<LegendEntry> rank_legend(const RankScale& scale) {
  const double largest = scale.bounds.back();
  int decimals = largest > 0.0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(largest))), 0, 12) : 0;
  const auto number = [&](double value) { return fmt::format("{:.{}f}", value, decimals); };
  const std::set<double> different(scale.bounds.begin(), scale.bounds.end());
  for (int more = 0; more < 3; ++more) {
    std::set<std::string> printed;
    for (const double bound : different) printed.insert(number(bound));
    if (printed.size() == different.size()) break;
    ++decimals;
  }
  std::vector<LegendEntry> legend;
  for (int rank = static_cast<int>(scale.bounds.size()) - 2; rank >= 0; --rank) {
    const double from = scale.bounds[rank];
    const double to = scale.bounds[rank + 1];
    if (from < to) {
      legend.push_back({rank_colour(rank), number(from).append(range_dash).append(number(to))});
    } else if (rank == rank_of(scale, from)) {
      legend.push_back({rank_colour(rank), number(from)});
    }
  }
  return legend;
}

Image draw_chart(const SurfaceImage& seen, std::span<const Colour> colours, const Camera& camera, const Plot& plot,
                 double height_m, const ChartText& text) {
  EXPECT(std::min({seen.width, seen.height, seen.samples}), >, 0);
  const std::size_t samples = static_cast<std::size_t>(seen.width) * seen.height * seen.samples;
  EXPECT(seen.surface.size(), ==, samples);
  EXPECT(seen.depth_m.size(), ==, samples);
  const Layout layout(seen.height);
  const Typeface face;
  const SeenScene scene{seen, camera};

  Image image = resolve(seen, colours);
  draw_border(image, scene, plot, layout);
  draw_axes(image, scene, face, {plot.size_x_m, height_m, plot.size_z_m}, layout);
  draw_titles(image, face, text, layout);
  draw_legend(image, face, text, layout);
  return image;
}

}  // namespace sunfleck
