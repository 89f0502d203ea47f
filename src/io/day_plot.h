#pragma once
// day.png: the course of light over one or several days, in one band.

#include "transport/statistics.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// One step of a day, drawn at its middle. Fluxes are per ground area, in the unit of the plot.
struct DayPlotRow {
  double start_s = 0.0;  // start of the step, as local_clock_s gives it
  double step_s = 0.0;
  Estimate incident, absorbed_vegetation, absorbed_soil, reflected;
  Estimate sunlit_leaf_fraction;  // NaN if there is none, as at night
};

// Returns the time that a local clock shows, in seconds since 1970-01-01 00:00 of that clock. Accepts
// "2002-08-08T10:10:00+08:00", also with a blank for the T, without seconds or without the offset, which is ignored. Returns
// nothing for any other text.
[[nodiscard]] std::optional<double> local_clock_s(std::string_view time);

struct DayPlot {
  std::string title;
  std::string band;
  std::string unit = "W m\u207b\u00b2";
  double confidence = 0.95;
  std::vector<DayPlotRow> rows;  // in order of time, at least one; the curves have a gap where steps are missing
};

// Returns a gnuplot script for draw_plot.
[[nodiscard]] std::string day_plot(const DayPlot& plot);

}  // namespace sunfleck
