#include "io/day_plot.h"

#include "base/check.h"
#include "io/plot_script.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

namespace sunfleck {
namespace {

constexpr int width_px = 1600;
constexpr int height_px = 1100;
constexpr PlotScript::Box fluxes_box{150.0, 440.0, 1360.0, 485.0};
constexpr PlotScript::Box sunlit_box{150.0, 125.0, 1360.0, 265.0};
// With more steps than this, curves are drawn as lines without points.
constexpr std::size_t most_points = 48;
constexpr double seconds_per_day = 86400.0;
constexpr double seconds_per_hour = 3600.0;

// Returns the number of exactly `digits` digits at `at`, or nothing.
std::optional<int> digits_at(std::string_view text, std::size_t at, std::size_t digits) {
  if (text.size() < at + digits) return {};
  int number = 0;
  for (const char c : text.substr(at, digits)) {
    if (c < '0' || c > '9') return {};
    number = 10 * number + (c - '0');
  }
  return number;
}

std::chrono::year_month_day date_of(double clock_s) {
  return std::chrono::sys_days(std::chrono::days(static_cast<int>(std::floor(clock_s / seconds_per_day))));
}

std::string date_text(double clock_s) {
  const std::chrono::year_month_day date = date_of(clock_s);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

struct Curve {
  const char* data;
  const char* label;
  Estimate DayPlotRow::*value;
};
constexpr Curve fluxes[] = {{"incident", "incident", &DayPlotRow::incident},
                            {"vegetation", "absorbed by vegetation", &DayPlotRow::absorbed_vegetation},
                            {"soil", "absorbed by soil", &DayPlotRow::absorbed_soil},
                            {"reflected", "reflected", &DayPlotRow::reflected}};
constexpr const char* flux_colours[] = {"#000000", "#009E73", "#D55E00", "#0072B2"};
constexpr Curve sunlit{"sunlit", "", &DayPlotRow::sunlit_leaf_fraction};
constexpr const char* sunlit_colour = "#D55E00";

double high_end(const Estimate& estimate) {
  return estimate.value + (std::isfinite(estimate.half_width) ? estimate.half_width : 0.0);
}

// Writes the columns: middle of the step, value, ends of its interval.
void add_curve(PlotScript& script, const DayPlot& plot, const Curve& curve) {
  script.begin_data(curve.data);
  double last_end_s = plot.rows.front().start_s;
  bool open = false;
  for (const DayPlotRow& row : plot.rows) {
    const Estimate& estimate = row.*curve.value;
    const bool there = std::isfinite(estimate.value);
    if (open && (!there || row.start_s > last_end_s + 0.5)) {
      script.gap();
      open = false;
    }
    last_end_s = row.start_s + row.step_s;
    if (!there) continue;
    script.row({row.start_s + 0.5 * row.step_s, estimate.value, 2.0 * estimate.value - high_end(estimate), high_end(estimate)});
    open = true;
  }
  script.end_data();
}

std::string curve_style(const DayPlot& plot, const char* colour, std::size_t dash) {
  return fmt::format("{} linecolor '{}' linewidth 1.4 dashtype {} pointtype 7 pointsize 0.7",
                     plot.rows.size() > most_points ? "lines" : "linespoints", colour, dash);
}

std::string curve_command(const Curve& curve, const char* colour, const std::string& style) {
  return fmt::format(
      ", ${0} using 1:3:4 with filledcurves fillstyle transparent solid 0.3 noborder linecolor '{1}' notitle, "
      "'' using 1:2 with {2} notitle",
      curve.data, colour, style);
}

// Labels full hours if there is one date, and dates if there are several.
void set_time_axis(PlotScript& script, double begin_s, double end_s) {
  constexpr double room_px = 110.0;
  const double range_s = end_s - begin_s;
  const double finest_s = range_s * room_px / fluxes_box.width_px;
  script.add("set xrange [{:.9g}:{:.9g}]", begin_s, end_s);
  if (range_s <= seconds_per_day) {
    double step_s = 6.0 * seconds_per_hour;
    for (const double candidate_s : {300.0, 600.0, 1800.0, 3600.0, 7200.0, 10800.0}) {
      if (candidate_s >= finest_s) {
        step_s = candidate_s;
        break;
      }
    }
    script.add("set xtics {:.9g}", step_s);
    script.add("set xtics time format '%H:%M'");
  } else {
    const double days = std::max(1.0, std::ceil(1.6 * finest_s / seconds_per_day));
    script.add("set xtics {:.9g},{:.9g}", begin_s, days * seconds_per_day);
    script.add("set xtics time format '%Y-%m-%d'");
  }
}

double tallest(const DayPlot& plot) {
  double most = 0.0;
  for (const DayPlotRow& row : plot.rows) {
    for (const Curve& curve : fluxes) {
      const double high = high_end(row.*curve.value);
      if (std::isfinite(high)) most = std::max(most, high);
    }
  }
  return most > 0.0 ? 1.08 * most : 1.0;
}

}  // namespace

std::optional<double> local_clock_s(std::string_view time) {
  const std::optional<int> year = digits_at(time, 0, 4), month = digits_at(time, 5, 2), day = digits_at(time, 8, 2);
  const std::optional<int> hour = digits_at(time, 11, 2), minute = digits_at(time, 14, 2);
  if (!year || !month || !day || !hour || !minute || time[4] != '-' || time[7] != '-' || time[13] != ':') return {};
  if ((time[10] != 'T' && time[10] != ' ') || *hour > 24 || *minute > 59) return {};
  std::optional<int> second = 0;
  if (time.size() > 16 && time[16] == ':') second = digits_at(time, 17, 2);
  if (!second || *second > 60) return {};
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return {};
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return seconds_per_day * static_cast<double>(days) + 3600.0 * *hour + 60.0 * *minute + *second;
}

std::string day_plot(const DayPlot& plot) {
  EXPECT(plot.rows.size(), >, std::size_t{0});
  double begin_s = plot.rows.front().start_s;
  double end_s = std::max(plot.rows.back().start_s + plot.rows.back().step_s, begin_s + 60.0);
  const std::string first_date = date_text(begin_s);
  const std::string last_date = date_text(end_s - 1.0);
  if (end_s - begin_s > seconds_per_day) {
    begin_s = std::floor(begin_s / seconds_per_day) * seconds_per_day;
    end_s = std::ceil(end_s / seconds_per_day) * seconds_per_day;
  }

  PlotScript script(width_px, height_px);
  for (const Curve& curve : fluxes) add_curve(script, plot, curve);
  add_curve(script, plot, sunlit);
  script.add("set multiplot");
  set_time_axis(script, begin_s, end_s);

  const double high = tallest(plot);
  script.place(fluxes_box);
  script.headline(plot.title, 40.0, 25, 84);
  script.headline(fmt::format("Shaded: {:g} % confidence intervals", 100.0 * plot.confidence), 82.0, 18, 120);
  script.y_title(fmt::format("{} ({} of ground)", plot.band, plot.unit));
  script.add("set format x ''");
  script.add("set yrange [0:{:.9g}]; set ytics {:.9g}", high, tic_step(high, fluxes_box.height_px, 70.0));
  script.legend(fluxes_box.left_px, 104.0, 2);
  std::string command = "plot NaN notitle";
  for (std::size_t c = 0; c < std::size(fluxes); ++c) {
    const std::string style = curve_style(plot, flux_colours[c], c + 1);
    command += curve_command(fluxes[c], flux_colours[c], style);
    command += fmt::format(", keyentry with {} title '{}'", style, fluxes[c].label);
  }
  script.add("{}", command);

  script.no_legend();
  script.place(sunlit_box);
  set_time_axis(script, begin_s, end_s);
  script.add("set yrange [0:1]; set ytics 0.25");
  script.y_title("Sunlit leaf fraction");
  script.x_title(first_date == last_date ? "Local time, " + first_date : "Local time");
  script.add("plot NaN notitle{}", curve_command(sunlit, sunlit_colour, curve_style(plot, sunlit_colour, 1)));
  script.add("unset multiplot");
  return script.text();
}

}  // namespace sunfleck
