#include "files/results/exports/day_time_axis.h"

#include "base/file.h"
#include "base/units.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace sunfleck {

int add_time_axis(NetcdfFile& file, const DayCourse& course, std::size_t steps) {
  const int time = file.dimension("time", steps);
  const int bound = file.dimension("bound", 2);
  const UtcTime origin{course.steps.front().start.year, 1, 1};
  std::vector<double> starts, bounds, elevations, azimuths;
  std::vector<std::string> local;
  for (std::size_t i = 0; i < steps; ++i) {
    const DayStep& step = course.steps[i];
    starts.push_back(seconds_between(origin, step.start));
    bounds.insert(bounds.end(), {starts.back(), starts.back() + step.length_s});
    elevations.push_back(step.sun.elevation_rad / degree);
    azimuths.push_back(step.sun.azimuth_rad / degree);
    local.push_back(local_time_text(step.start, course.offset_minutes));
  }
  const std::string units = fmt::format("seconds since {:04}-01-01 00:00:00", origin.year);
  const int number = file.variable<double>("time", {time}, units, "start of the step, UTC; its light is that of the middle");
  file.attribute(number, "standard_name", "time");
  file.attribute(number, "axis", "T");
  file.attribute(number, "calendar", "proleptic_gregorian");
  file.attribute(number, "bounds", "time_bounds");
  file.put(number, std::span<const double>(starts));
  const int time_bounds = file.variable<double>("time_bounds", {time, bound});
  file.put(time_bounds, std::span<const double>(bounds));
  file.add("elevation_deg", {time}, "degree", "elevation of the sun at the middle of the step", elevations);
  file.add("azimuth_deg", {time}, "degree", "azimuth of the sun at the middle of the step, clockwise from north", azimuths);
  file.names("local_time", time, local, "start of the step, local time with its offset");
  return time;
}

void write_aside(const std::filesystem::path& file, const std::filesystem::path& aside, const std::function<void()>& write) {
  try {
    write();
  } catch (...) {
    std::error_code error;
    std::filesystem::remove(aside, error);
    throw;
  }
  replace_file(file, aside);
}

}  // namespace sunfleck
