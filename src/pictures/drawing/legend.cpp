#include "pictures/drawing/legend.h"

#include "base/check.h"
#include "pictures/drawing/overlay.h"
#include "pictures/drawing/palette.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <set>
#include <string_view>

namespace sunfleck {
namespace {

constexpr std::string_view range_dash = " – ";
constexpr std::size_t fewest_ticks = 4;

// A legend's label, split at its dash. Both numbers are right-aligned, so that their digits line up in columns.
struct Label {
  std::string_view from, to;  // `to` is empty if there is no dash

  explicit Label(std::string_view label) : from(label) {
    const std::size_t dash = label.find(range_dash);
    if (dash == std::string_view::npos) return;
    from = label.substr(0, dash);
    to = label.substr(dash + range_dash.size());
  }
};

// The layout of the legend's panel for a type size of 1, relative to the panel's upper left corner.
struct LegendPlan {
  std::string_view title, unit;
  std::vector<Tick> ticks;  // of the colour bar
  double tick_width = 0.0;
  double from_width = 0.0, dash_width = 0.0, to_width = 0.0;
  double width = 0.0, height = 0.0;
  double bar_top = 0.0, entries_top = 0.0;

  static constexpr double padding = 0.9, swatch_width = 1.9, swatch_height = 1.05, gap = 0.7, row = 1.65;
  static constexpr double title_line = 1.35, below_title = 0.35;
  static constexpr double bar_height = 11.0, tick_length = 0.3;

  LegendPlan(const Typeface& face, const Legend& legend) : title(legend.title) {
    const std::size_t comma = title.rfind(", ");
    if (comma != std::string_view::npos) {
      unit = title.substr(comma + 2);
      title = title.substr(0, comma);
    }
    double labels = label_width(face, legend.entries);
    if (legend.bar) {
      ticks = round_ticks(legend.bar->lo, legend.bar->hi);
      for (const Tick& tick : ticks) tick_width = std::max(tick_width, face.width_px(tick.label, 1.0));
      labels = std::max(labels, tick_width);
    }
    width = 2.0 * padding + std::max({face.width_px(title, 1.0), face.width_px(unit, 1.0), swatch_width + gap + labels});
    const double titles = title_line * ((title.empty() ? 0 : 1) + (unit.empty() ? 0 : 1)) + (title.empty() ? 0.0 : below_title);
    entries_top = padding + titles;
    const double entries = row * static_cast<double>(legend.entries.size());
    bar_top = entries_top + entries;
    height = padding + bar_top + (legend.bar ? bar_height : entries > 0.0 ? swatch_height - row : 0.0);
  }

 private:
  double label_width(const Typeface& face, const std::vector<LegendEntry>& entries) {
    double lone_width = 0.0;
    for (const LegendEntry& entry : entries) {
      const Label label(entry.label);
      if (label.to.empty()) {
        lone_width = std::max(lone_width, face.width_px(label.from, 1.0));
      } else {
        from_width = std::max(from_width, face.width_px(label.from, 1.0));
        to_width = std::max(to_width, face.width_px(label.to, 1.0));
        dash_width = face.width_px(range_dash, 1.0);
      }
    }
    return std::max(from_width + dash_width + to_width, lone_width);
  }
};

// Everything needed to draw the parts of a legend.
struct LegendPen {
  Image& image;
  const Typeface& face;
  const LegendPlan& plan;
  double size;             // type size, px
  glm::dvec2 corner{0.0};  // upper left corner of the panel

  [[nodiscard]] double hairline() const { return std::max(1.0, 0.05 * size); }

  // Draws text that ends at `right_x`, with its capitals centred on the height `middle_y`.
  void flush_right(std::string_view text, double right_x, double middle_y) const {
    const glm::dvec2 baseline(right_x - face.width_px(text, size), middle_y + 0.5 * Typeface::cap_height * size);
    face.draw(image, text, baseline, size, from_srgb(ink));
  }
};

void draw_label(const LegendPen& pen, const Label& label, double left_x, double middle_y) {
  const LegendPlan& plan = pen.plan;
  const double column = plan.from_width + plan.dash_width + plan.to_width;
  if (label.to.empty()) {
    const double own = pen.face.width_px(label.from, 1.0);
    pen.flush_right(label.from, left_x + pen.size * std::max(plan.to_width > 0.0 ? column : 0.0, own), middle_y);
    return;
  }
  pen.flush_right(label.from, left_x + pen.size * plan.from_width, middle_y);
  pen.flush_right(range_dash, left_x + pen.size * (plan.from_width + plan.dash_width), middle_y);
  pen.flush_right(label.to, left_x + pen.size * column, middle_y);
}

void draw_entries(const LegendPen& pen, const std::vector<LegendEntry>& entries) {
  glm::dvec2 at = pen.corner + pen.size * glm::dvec2(LegendPlan::padding, pen.plan.entries_top);
  for (const LegendEntry& entry : entries) {
    const Rectangle swatch = {at, at + pen.size * glm::dvec2(LegendPlan::swatch_width, LegendPlan::swatch_height)};
    fill_rectangle(pen.image, swatch, {0.12 * pen.size}, {entry.colour});
    outline_rectangle(pen.image, swatch, {0.12 * pen.size}, pen.hairline(), {from_srgb(ink), 0.35});
    draw_label(pen, Label(entry.label), swatch.hi.x + LegendPlan::gap * pen.size, 0.5 * (swatch.lo.y + swatch.hi.y));
    at.y += LegendPlan::row * pen.size;
  }
}

// Returns the colour at `share` of the way from the first to the last.
Colour colour_at(const std::vector<Colour>& colours, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(place), colours.size() - 1);
  const std::size_t upper = std::min(lower + 1, colours.size() - 1);
  Colour mixed = colours[lower];
  const double rest = place - static_cast<double>(lower);
  for (std::size_t i = 0; i < 3; ++i) mixed[i] += rest * (colours[upper][i] - mixed[i]);
  return mixed;
}

void draw_bar(const LegendPen& pen, const ColourBar& bar) {
  EXPECT(bar.colours.empty(), ==, false);
  const glm::dvec2 lo = glm::round(pen.corner + pen.size * glm::dvec2(LegendPlan::padding, pen.plan.bar_top));
  const glm::dvec2 size = glm::round(pen.size * glm::dvec2(LegendPlan::swatch_width, LegendPlan::bar_height));
  const Rectangle frame = {lo, lo + size};
  for (double y = lo.y; y < frame.hi.y; y += 1.0) {
    const Colour colour = colour_at(bar.colours, (frame.hi.y - y - 0.5) / size.y);
    fill_rectangle(pen.image, {{lo.x, y}, {frame.hi.x, y + 1.0}}, {}, {colour});
  }
  outline_rectangle(pen.image, frame, {}, pen.hairline(), {from_srgb(ink), 0.35});
  const double labels_end = frame.hi.x + pen.size * (LegendPlan::gap + pen.plan.tick_width);
  for (const Tick& tick : pen.plan.ticks) {
    const double share = bar.hi > bar.lo ? (tick.value - bar.lo) / (bar.hi - bar.lo) : 0.5;
    const double y = frame.hi.y - share * size.y;
    const double half = 0.5 * pen.hairline();
    fill_rectangle(pen.image, {{frame.hi.x, y - half}, {frame.hi.x + LegendPlan::tick_length * pen.size, y + half}}, {},
                   {from_srgb(ink)});
    pen.flush_right(tick.label, labels_end, y);
  }
}

}  // namespace

std::vector<LegendEntry> rank_legend(const RankScale& scale, const std::optional<std::array<double, 6>>& shares) {
  const double largest = scale.open ? scale.bounds[scale.bounds.size() - 2] : scale.bounds.back();  // the largest printed bound
  int decimals = largest > 0.0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(largest))), 0, 12) : 0;
  const auto number = [&](double value) { return fmt::format("{:.{}f}", value, decimals); };
  const std::set<double> different(scale.bounds.begin(), scale.bounds.end());
  for (int more = 0; more < 3; ++more) {
    std::set<std::string> printed;
    for (const double bound : different) printed.insert(number(bound));
    if (printed.size() == different.size()) break;
    ++decimals;
  }
  const auto share = [&](std::size_t rank) {
    if (!shares) return std::string();
    const std::string percent = fmt::format("{:.0f}", 100.0 * (*shares)[rank]);
    return (percent.size() < 2 ? "   \u2007" : "   ") + percent + " %";  // padded by a space as wide as a digit
  };
  std::vector<LegendEntry> legend;
  for (int rank = static_cast<int>(scale.bounds.size()) - 2; rank >= 0; --rank) {
    const double from = scale.bounds[rank];
    const double to = scale.bounds[rank + 1];
    if (scale.open && legend.empty()) {
      legend.push_back({rank_colour(rank), "≥ " + number(from) + share(rank)});
    } else if (from < to) {
      legend.push_back({rank_colour(rank), number(from).append(range_dash).append(number(to)) + share(rank)});
    } else if (rank == rank_of(scale, from)) {
      legend.push_back({rank_colour(rank), number(from) + share(rank)});
    }
  }
  constexpr std::size_t unlit = 5;
  if (shares && (*shares)[unlit] > 0.0) legend.push_back({rank_colour(unlit_rank), "unlit" + share(unlit)});
  return legend;
}

std::vector<Tick> round_ticks(double lo, double hi) {
  EXPECT(lo, <=, hi);
  if (lo == hi) return {{lo, fmt::format("{:.3g}", lo)}};
  // Tries steps from one that gives at most two ticks down to the first that gives enough: 1, 2, 5 and powers of ten times
  // these.
  int power = static_cast<int>(std::ceil(std::log10(hi - lo))) + 1;
  for (;; --power) {
    for (const double factor : {5.0, 2.0, 1.0}) {
      const double step = power < 0 ? factor / std::pow(10.0, -power) : factor * std::pow(10.0, power);
      // Ends that are multiples except for rounding count as multiples.
      const double first = std::ceil(lo / step - 1e-9) + 0.0;  // + 0.0 avoids -0
      const double last = std::floor(hi / step + 1e-9);
      if (last - first + 1.0 < static_cast<double>(fewest_ticks)) continue;
      std::vector<Tick> ticks;
      const bool plain = power >= -6 && std::max(std::abs(lo), std::abs(hi)) < 1e7;
      for (double k = first; k <= last; k += 1.0) {
        const double value = std::clamp(k * step, lo, hi);
        ticks.push_back({value, plain ? fmt::format("{:.{}f}", k * step, std::max(0, -power)) : fmt::format("{:g}", k * step)});
      }
      return ticks;
    }
  }
}

void draw_legend(Image& image, const Typeface& face, const Legend& legend, const LegendRoom& room, double size_px) {
  if (legend.entries.empty() && !legend.bar) return;
  const LegendPlan plan(face, legend);
  const double size = std::min({size_px, room.width_px / plan.width, room.height_px / plan.height});
  const glm::dvec2 corner = room.corner_px - glm::dvec2(size * plan.width, 0.0);
  const Rectangle panel = {corner, corner + size * glm::dvec2(plan.width, plan.height)};
  const LegendPen pen{image, face, plan, size, corner};
  fill_rectangle(image, panel, {0.4 * size}, {Colour{1.0, 1.0, 1.0}, 0.86});
  outline_rectangle(image, panel, {0.4 * size}, pen.hairline(), {from_srgb({196, 202, 208})});

  glm::dvec2 baseline_px = corner + size * glm::dvec2(LegendPlan::padding, LegendPlan::padding + Typeface::cap_height);
  for (const std::string_view line : {plan.title, plan.unit}) {
    if (line.empty()) continue;
    face.draw(image, line, baseline_px, size, from_srgb(line.data() == plan.title.data() ? ink : grey_ink));
    baseline_px.y += LegendPlan::title_line * size;
  }
  draw_entries(pen, legend.entries);
  if (legend.bar) draw_bar(pen, *legend.bar);
}

}  // namespace sunfleck
