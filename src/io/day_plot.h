#pragma once
// day.png: the course of light over a day or several, in one band.

#include "transport/statistics.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// A step of a day; fluxes in the plot's unit, per ground area. The middle of the step is where it is drawn.
struct DayPlotRow {
  double start_s = 0.0;  // local_clock_s of its start
  double step_s = 0.0;
  Estimate incident, absorbed_vegetation, absorbed_soil, reflected;
  Estimate sunlit_leaf_fraction;  // value NaN: none, as at night
};

// What a local clock shows, in seconds since 1970-01-01 00:00 of that clock: of "2002-08-08T10:10:00+08:00" or the same with a
// blank for T, without seconds, or without offset, which is left aside. Empty for other text.
[[nodiscard]] std::optional<double> local_clock_s(std::string_view time);

struct DayPlot {
  std::string title;
  std::string band;
  std::string unit = "W m\u207b\u00b2";
  double confidence = 0.95;
  std::vector<DayPlotRow> rows;  // in order of time, at least one; curves are interrupted where steps are left out
};

// A gnuplot script, for draw_plot.
[[nodiscard]] std::string day_plot(const DayPlot& plot);

}  // namespace sunfleck
