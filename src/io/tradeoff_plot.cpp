#include "io/tradeoff_plot.h"

#include "io/plot_script.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace sunfleck {
namespace {

constexpr int width_px = 1600;
constexpr int height_px = 900;
constexpr double panel_left_px[] = {150.0, 640.0, 1130.0};
constexpr double panel_bottom_px = 125.0, panel_width_px = 440.0, panel_height_px = 555.0;
constexpr int point_types[] = {7, 5, 9, 13};  // one filled shape per quantity
constexpr int label_pt = 16, slope_pt = 17;
// Margins around the points, as factors of time and error, with space for slopes on the right and names of settings above.
constexpr double room_left = 2.2, room_right = 6.0, room_below = 2.5, room_above = 10.0;

struct Axis {
  double low = 0.1, high = 10.0;
};

struct Axes {
  Axis seconds, percent;
};

void widen(Axis& axis, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return;
  axis.low = std::min(axis.low, value);
  axis.high = std::max(axis.high, value);
}

bool in_panel(const TradeoffRung& rung, Ladder panel) {
  return rung.ladder == panel || (panel == Ladder::bounds && rung.ladder == Ladder::meshes);
}

double percent(double error) {
  return 100.0 * error;
}

double error_of(const TradeoffRung& rung, Quantity quantity) {
  return rung.error[static_cast<std::size_t>(quantity)];
}

Axes make_axes(const TradeoffReport& report, Ladder panel) {
  constexpr double huge = std::numeric_limits<double>::max();
  Axes axes{{huge, 0.0}, {huge, 0.0}};
  for (const TradeoffRung& rung : report.rungs) {
    for (const Quantity quantity : quantities) widen(axes.percent, percent(error_of(rung, quantity)));
    if (in_panel(rung, panel)) widen(axes.seconds, median_seconds(rung));
  }
  if (report.recommendation) {
    widen(axes.percent, percent(report.recommendation->asked_error));
    if (panel == Ladder::bounds) widen(axes.seconds, report.recommendation->seconds);
  }
  if (!(axes.percent.high > 0.0)) axes.percent = {0.1, 10.0};
  if (!(axes.seconds.high > 0.0)) axes.seconds = {0.1, 10.0};
  return {{axes.seconds.low / room_left, axes.seconds.high * room_right},
          {axes.percent.low / room_below, axes.percent.high * room_above}};
}

std::string data_name(Ladder rows, Quantity quantity) {
  constexpr std::array names{"grids", "packets", "bounds", "meshes"};
  return fmt::format("{}{}", names[static_cast<std::size_t>(rows)], static_cast<std::size_t>(quantity));
}

std::string style(Quantity quantity) {
  const auto q = static_cast<std::size_t>(quantity);
  return fmt::format("linecolor '{}' pointtype {} pointsize 1.5", plot_colours[q], point_types[q]);
}

const PowerLaw* fit_of(const TradeoffReport& report, Ladder panel, Quantity quantity) {
  for (const TradeoffFit& fit : report.fits) {
    if (fit.ladder == panel && fit.quantity == quantity) return &fit.of_rays;
  }
  return nullptr;
}

// Writes the columns: seconds, error, error according to the fit.
void add_data(PlotScript& script, const TradeoffReport& report, Ladder panel, Ladder rows, Quantity quantity) {
  const PowerLaw* law = fit_of(report, panel, quantity);
  script.begin_data(data_name(rows, quantity));
  for (const TradeoffRung& rung : report.rungs) {
    const double error = error_of(rung, quantity);
    if (rung.ladder != rows || !(error > 0.0)) continue;
    const double fitted = law != nullptr ? law->factor * std::pow(mean_rays(rung), law->exponent) : error;
    script.row({median_seconds(rung), percent(error), percent(fitted)});
  }
  script.end_data();
}

std::string spacing_text(double grid_m) {
  return grid_m < 0.01 ? fmt::format("{:.3g} mm", 1e3 * grid_m) : fmt::format("{:.3g} cm", 1e2 * grid_m);
}

std::string packets_text(double packets) {
  return packets >= 1024.0 ? fmt::format("{:.0f} k", packets / 1024.0) : fmt::format("{:.0f}", packets);
}

std::string rung_text(const TradeoffRung& rung) {
  switch (rung.ladder) {
    case Ladder::grids:
      return spacing_text(rung.value);
    case Ladder::packets:
      return packets_text(rung.value);
    case Ladder::bounds:
      return fmt::format("{:.3g}", rung.value);
    case Ladder::meshes:
      return fmt::format("mesh {:.3g}", rung.value);
  }
  return "";
}

// Writes the name of each setting beside its highest point, if there is room.
void name_settings(PlotScript& script, const TradeoffReport& report, Ladder panel) {
  constexpr double least_time_ratio = 1.15, least_error_ratio = 1.3;
  double last_s = 0.0, last_error = 0.0;
  for (const TradeoffRung& rung : report.rungs) {
    if (!in_panel(rung, panel)) continue;
    double highest = 0.0;
    for (const Quantity quantity : quantities) {
      if (const double error = error_of(rung, quantity); error > highest) highest = error;
    }
    const double seconds = median_seconds(rung);
    const auto apart = [](double a, double b, double ratio) { return a > ratio * b || b > ratio * a; };
    if (!(highest > 0.0)) continue;
    if (!apart(seconds, last_s, least_time_ratio) && !apart(highest, last_error, least_error_ratio)) continue;
    last_s = seconds;
    last_error = highest;
    script.add("set label {} at {:.6g},{:.6g} left offset 0.6,0.75 noenhanced font ',{}' textcolor '#404040'",
               plot_quoted(rung_text(rung)), seconds, percent(highest), label_pt);
  }
}

// Writes the slope over rays beside the end of each curve, without overlaps.
void name_slopes(PlotScript& script, const TradeoffReport& report, Ladder panel, const Axes& axes) {
  constexpr double line_px = 25.0;
  struct Slope {
    double seconds, percent, exponent;
    Quantity quantity;
  };
  std::vector<Slope> slopes;
  for (const TradeoffRung& rung : report.rungs) {
    if (rung.ladder != panel) continue;
    for (const Quantity quantity : quantities) {
      const PowerLaw* law = fit_of(report, panel, quantity);
      if (law == nullptr || !(error_of(rung, quantity) > 0.0)) continue;
      const auto same = [quantity](const Slope& slope) { return slope.quantity == quantity; };
      slopes.erase(std::remove_if(slopes.begin(), slopes.end(), same), slopes.end());
      slopes.push_back({median_seconds(rung), percent(error_of(rung, quantity)), law->exponent, quantity});
    }
  }
  std::sort(slopes.begin(), slopes.end(), [](const Slope& a, const Slope& b) { return a.percent < b.percent; });
  const double step = std::pow(axes.percent.high / axes.percent.low, line_px / panel_height_px);
  double lowest = 0.0;
  for (const Slope& slope : slopes) {
    const double at = std::max(slope.percent, lowest);
    lowest = at * step;
    script.add("set label {} at {:.6g},{:.6g} left offset 1.2,0 noenhanced font ',{}' textcolor '{}'",
               plot_quoted(fmt::format("{}{:.2f}", slope.exponent < 0.0 ? "\u2212" : "", std::abs(slope.exponent))),
               slope.seconds, at, slope_pt, plot_colours[static_cast<std::size_t>(slope.quantity)]);
  }
}

// Returns the plot command: measured points and fitted lines for the passes, connected points for whole runs.
std::string curves(Ladder panel) {
  std::string command = "plot NaN notitle";
  for (const Quantity quantity : quantities) {
    const auto q = static_cast<std::size_t>(quantity);
    command +=
        fmt::format(", ${0} using 1:3 with lines linewidth 1.3 linecolor '{1}' notitle, ${0} using 1:2 with points {2} notitle",
                    data_name(panel, quantity), plot_colours[q], style(quantity));
    if (panel != Ladder::bounds) continue;
    command += fmt::format(", ${} using 1:2 with points linecolor '{}' pointtype {} pointsize 1.7 linewidth 1.4 notitle",
                           data_name(Ladder::meshes, quantity), plot_colours[q], point_types[q] - 1);
  }
  return command;
}

void mark_recommendation(PlotScript& script, const Recommendation& found) {
  const double asked = percent(found.asked_error);
  script.add(
      "set arrow from graph 0,first {0:.6g} to graph 1,first {0:.6g} nohead back linecolor '#000000' linewidth 1 "
      "dashtype 2",
      asked);
  script.add("set arrow from {0:.6g},graph 0 to {0:.6g},first {1:.6g} nohead back linecolor '#000000' linewidth 1 dashtype 2",
             found.seconds, asked);
  script.add("set label '' at {:.6g},{:.6g} point pointtype 6 pointsize 2.6 linewidth 1.4 linecolor '#000000' front",
             found.seconds, percent(found.expected));
  script.add("set label {} at graph 0.96,0.95 right noenhanced font ',{}' front",
             plot_quoted(fmt::format("{:g} % per {}:", asked, quantity_name(found.quantity))), slope_pt);
  const std::string line = recommendation_line(found);
  const std::size_t begin = line.find("--error");
  const std::size_t end = line.find(" on this");
  script.add("set label {} at graph 0.96,0.895 right noenhanced font ',{}' front", plot_quoted(line.substr(begin, end - begin)),
             slope_pt);
}

void mark_grid(PlotScript& script, const TradeoffReport& report) {
  for (const TradeoffRung& rung : report.rungs) {
    if (rung.ladder != Ladder::grids || !report.marked_grid_m) continue;
    if (std::abs(rung.value / *report.marked_grid_m - 1.0) > 1e-6) continue;
    script.add("set arrow from {0:.6g},graph 0 to {0:.6g},graph 1 nohead back linecolor '#000000' linewidth 1 dashtype 2",
               median_seconds(rung));
    script.add("set label {} at {:.6g},graph 0.95 right offset -0.8,0 noenhanced font ',{}' front",
               plot_quoted(fmt::format("{:.3g} cm grid", 1e2 * rung.value)), median_seconds(rung), slope_pt);
    return;
  }
}

void add_panel(PlotScript& script, const TradeoffReport& report, Ladder panel, std::string_view title) {
  const auto p = static_cast<std::size_t>(panel);
  const Axes axes = make_axes(report, panel);
  script.place({panel_left_px[p], panel_bottom_px, panel_width_px, panel_height_px});
  script.add("unset arrow");
  script.add("set xrange [{:.6g}:{:.6g}]; set yrange [{:.6g}:{:.6g}]", axes.seconds.low, axes.seconds.high, axes.percent.low,
             axes.percent.high);
  script.add("set label {} at graph 0.5,1.0 center offset 0,1.0 noenhanced font ',20'", plot_quoted(title));
  script.x_title("Time of a run (s)");
  if (p == 0) {
    script.upright("Relative error (%), root mean square", 30.0, panel_bottom_px + 0.5 * panel_height_px);
    script.headline(report.record.title, 40.0, 25, 84);
    script.headline("Points: measured. Lines and numbers of the two passes: fitted powers of the number of rays", 82.0, 18,
                    120);
  } else {
    script.add("set format y ''");
  }
  name_settings(script, report, panel);
  name_slopes(script, report, panel, axes);
  if (panel == Ladder::grids) mark_grid(script, report);
  if (panel == Ladder::bounds && report.recommendation) mark_recommendation(script, *report.recommendation);
  if (std::none_of(report.rungs.begin(), report.rungs.end(), [&](const TradeoffRung& rung) { return in_panel(rung, panel); }))
    script.notice("nothing measured");
}

}  // namespace

std::string tradeoff_plot(const TradeoffReport& report) {
  PlotScript script(width_px, height_px);
  for (const Ladder panel : {Ladder::grids, Ladder::packets, Ladder::bounds}) {
    for (const Quantity quantity : quantities) add_data(script, report, panel, panel, quantity);
  }
  for (const Quantity quantity : quantities) add_data(script, report, Ladder::bounds, Ladder::meshes, quantity);
  script.add("set multiplot");
  script.add("set logscale xy; set format x '%g'; set format y '%g'; set mxtics 10; set mytics 10");
  script.legend(panel_left_px[0], 104.0, 4);
  script.add("set key vertical maxrows 1");
  std::string legend;
  for (const Quantity quantity : quantities)
    legend += fmt::format(", keyentry with linespoints linewidth 1.3 {} title '{}'", style(quantity), quantity_name(quantity));
  add_panel(script, report, Ladder::grids, "Sun's direct light: grids");
  script.add("{}{}", curves(Ladder::grids), legend);
  script.no_legend();
  add_panel(script, report, Ladder::packets, "All other light: packets");
  script.add("{}", curves(Ladder::packets));
  add_panel(script, report, Ladder::bounds, "Whole runs: --error");
  script.add("{}", curves(Ladder::bounds));
  script.add("unset multiplot");
  return script.text();
}

}  // namespace sunfleck
