#include "io/profile_plot.h"

#include "base/check.h"
#include "io/plot_script.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sunfleck {
namespace {

constexpr int width_px = 1600;
constexpr int height_px = 1000;
constexpr double panel_left_px[] = {140.0, 870.0};
constexpr double panel_bottom_px = 125.0;
constexpr double panel_width_px = 680.0;
constexpr double head_px = 120.0;  // title and note
constexpr double legend_row_px = 31.0;
constexpr double ratio_end = 1.02;  // keeps points at 1 clear of the border
constexpr double headroom = 1.05;
constexpr int point_types[] = {7, 5, 9, 13, 11, 15};  // one filled shape per curve
constexpr const char* measured_style = "pointtype 6 pointsize 1.7 linewidth 1.6 linecolor '#000000'";

struct Point {
  double height_m;
  Estimate value;
};
using Points = std::vector<Point>;

Points sunfleck_points(const ProfileTable& profile) {
  Points points;
  for (const ProfileTable::Row& row : profile.rows) points.push_back({row.height_m, row.sunfleck_ratio});
  return points;
}

// Returns the absorbed flux at the middle of each layer, per metre, so that profiles with different layer thicknesses can be
// compared.
Points absorbed_points(const ProfileTable& profile, const std::string& band) {
  const auto found = std::find(profile.bands.begin(), profile.bands.end(), band);
  if (found == profile.bands.end()) return {};
  const auto b = static_cast<std::size_t>(found - profile.bands.begin());
  Points points;
  for (std::size_t i = 0; i + 1 < profile.rows.size(); ++i) {
    const double bottom_m = profile.rows[i].height_m;
    const double top_m = profile.rows[i + 1].height_m;
    if (top_m > bottom_m)
      points.push_back({0.5 * (bottom_m + top_m), profile.rows[i].absorbed[b].scaled(1.0 / (top_m - bottom_m))});
  }
  return points;
}

double half_width(const Estimate& estimate) {
  return std::isfinite(estimate.half_width) ? estimate.half_width : 0.0;
}

bool is_drawn(const Point& point) {
  return std::isfinite(point.value.value);
}

double largest(const std::vector<Points>& curves) {
  double most = 0.0;
  for (const Points& points : curves) {
    for (const Point& point : points) {
      if (is_drawn(point)) most = std::max(most, point.value.value + half_width(point.value));
    }
  }
  return most > 0.0 ? most : 1.0;
}

void add_curves(PlotScript& script, const std::string& panel, const std::vector<Points>& curves) {
  for (std::size_t c = 0; c < curves.size(); ++c) {
    script.begin_data(fmt::format("{}{}", panel, c));
    for (const Point& point : curves[c]) {
      if (!is_drawn(point)) continue;
      const double error = half_width(point.value);
      script.row({point.value.value, point.height_m, point.value.value - error, point.value.value + error});
    }
    script.end_data();
  }
}

std::string curve_style(std::size_t c) {
  return fmt::format("linecolor '{}' pointtype {} pointsize 1.2 linewidth 1.1 dashtype {}",
                     plot_colours[c % std::size(plot_colours)], point_types[c % std::size(point_types)],
                     1 + c / std::size(plot_colours));
}

// Returns the plot command of a panel. It always plots something, because gnuplot draws no panel otherwise.
std::string plot_command(const std::string& panel, const std::vector<Points>& curves) {
  std::string command = "plot NaN notitle";
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (std::none_of(curves[c].begin(), curves[c].end(), is_drawn)) continue;
    command += fmt::format(", ${}{} using 1:2:3:4 with xerrorlines {} notitle", panel, c, curve_style(c));
  }
  return command;
}

// Returns the labels of the curves, then of the field data; nothing if there is only one curve.
std::vector<std::string> legend_labels(const std::vector<ProfileCurve>& curves,
                                       const std::optional<MeasuredProfile>& measured) {
  std::vector<std::string> labels;
  if (curves.size() < 2 && !measured) return labels;
  for (const ProfileCurve& curve : curves) labels.push_back(curve.label);
  if (measured) labels.push_back("measured: " + measured->name);
  return labels;
}

std::string legend_command(const std::vector<std::string>& labels, std::size_t curves) {
  std::string command;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    command += fmt::format(", keyentry with {} title {}",
                           i < curves ? "linespoints " + curve_style(i) : fmt::format("points {}", measured_style),
                           plot_quoted(labels[i]));
  }
  return command;
}

std::string interval_note(const std::vector<ProfileCurve>& curves) {
  const std::optional<double> confidence = curves.front().profile.confidence;
  const bool same = std::all_of(curves.begin(), curves.end(),
                                [&](const ProfileCurve& curve) { return curve.profile.confidence == confidence; });
  if (!same || !confidence) return "Bars: confidence intervals";
  return fmt::format("Bars: {:g} % confidence intervals", 100.0 * *confidence);
}

struct Axis {
  double low = 0.0, high = 1.0, step = 0.2;
};

Axis height_axis(const std::vector<ProfileCurve>& curves, const std::optional<MeasuredProfile>& measured) {
  double lowest = 0.0, highest = 0.0;
  for (const ProfileCurve& curve : curves) {
    lowest = std::min(lowest, curve.profile.rows.front().height_m);
    highest = std::max(highest, curve.profile.rows.back().height_m);
  }
  if (measured) {
    for (const MeasuredRatio& point : measured->points) highest = std::max(highest, point.height_m);
  }
  if (!(highest > lowest)) highest = lowest + 1.0;
  return {lowest, lowest + headroom * (highest - lowest), tic_step(highest - lowest, height_px - head_px, 90.0)};
}

void add_panel(PlotScript& script, std::size_t panel, double panel_height_px, const Axis& x, const std::string& label) {
  script.place({panel_left_px[panel], panel_bottom_px, panel_width_px, panel_height_px});
  script.add("set xrange [{:.9g}:{:.9g}]", x.low, x.high);
  script.add("set xtics {:.9g}", x.step);
  script.x_title(label);
}

// Returns the note under the title.
std::string note_on(const std::vector<ProfileCurve>& curves, const std::optional<MeasuredProfile>& measured, bool beam) {
  std::string intervals = interval_note(curves);
  if (!measured || !beam) return intervals;
  return fmt::format("Agreement with field data: {}   \u00b7   {}",
                     agreement_figures(agreement(curves.front().profile, *measured)), intervals);
}

bool nothing_drawn(const Points& points) {
  return std::none_of(points.begin(), points.end(), is_drawn);
}

}  // namespace

std::string profile_plot(const std::string& title, const std::vector<ProfileCurve>& curves, const std::string& band,
                         const std::optional<MeasuredProfile>& measured) {
  EXPECT(curves.size(), >, std::size_t{0});
  std::vector<Points> sunfleck, absorbed;
  for (const ProfileCurve& curve : curves) {
    sunfleck.push_back(sunfleck_points(curve.profile));
    absorbed.push_back(absorbed_points(curve.profile, band));
  }
  PlotScript script(width_px, height_px);
  add_curves(script, "sunfleck", sunfleck);
  add_curves(script, "absorbed", absorbed);
  script.begin_data("measured");
  if (measured) {
    for (const MeasuredRatio& point : measured->points) script.row({point.sunfleck_ratio, point.height_m});
  }
  script.end_data();

  const Axis height = height_axis(curves, measured);
  const std::vector<std::string> labels = legend_labels(curves, measured);
  const double panel_height_px = height_px - panel_bottom_px - head_px - legend_row_px * static_cast<double>(labels.size());
  script.add("set multiplot");
  script.add("set yrange [{:.9g}:{:.9g}]; set ytics {:.9g}", height.low, height.high, height.step);
  if (!labels.empty()) script.legend(panel_left_px[0], head_px - 15.0, 1);

  add_panel(script, 0, panel_height_px, {0.0, ratio_end, 0.2}, "Sunfleck ratio (share of the plane in direct sun)");
  script.y_title("Height (m)");
  script.headline(title, 40.0, 25, 84);
  script.headline(note_on(curves, measured, !nothing_drawn(sunfleck.front())), 82.0, 18, 120);
  if (std::all_of(sunfleck.begin(), sunfleck.end(), nothing_drawn)) script.notice("no direct beam");
  script.add("{}{}{}", plot_command("sunfleck", sunfleck),
             measured ? fmt::format(", $measured using 1:2 with points {} notitle", measured_style) : "",
             legend_command(labels, curves.size()));

  const double most = headroom * largest(absorbed);
  script.no_legend();
  script.add("set format y ''");
  add_panel(script, 1, panel_height_px, {0.0, most, tic_step(most, panel_width_px, 100.0)},
            fmt::format("Absorbed {} (W m\u207b\u00b2 of ground per m of height)", band));
  if (std::all_of(absorbed.begin(), absorbed.end(), nothing_drawn)) script.notice("no light of this band");
  script.add("{}", plot_command("absorbed", absorbed));
  script.add("unset multiplot");
  return script.text();
}

}  // namespace sunfleck
