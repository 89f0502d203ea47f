#include "files/results/exports/day_netcdf.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "files/results/exports/netcdf_file.h"
#include "files/results/exports/netcdf_writer.h"
#include "files/results/tables/day_fields.h"

#include <fmt/format.h>

#include <numbers>

namespace sunfleck {
namespace {

class DayWriter {
 public:
  DayWriter(const DayFields& day, const std::filesystem::path& file)
      : day_(day),
        columns_(day_columns(day.model)),
        file_("day.nc", file),
        time_(file_.dimension("time", day.steps)),
        end_(file_.dimension("bound", 2)),
        triangle_(file_.dimension("triangle", day.model.canopy.size())) {}

  void write() {
    add_record(file_, "day", day_.record, day_.model);
    add_times();
    add_triangles();
    define_light();
    const std::size_t elements = day_.model.canopy.size();
    const std::vector<float> dark(light_.size() * elements);
    for (std::size_t step = 0; step < day_.steps; ++step) {
      const std::vector<float> fields = day_.course.steps[step].night() ? dark : day_.fields(step);
      EXPECT(fields.size(), ==, dark.size());
      for (std::size_t i = 0; i < light_.size(); ++i) {
        file_.put_row(light_[i], step, std::span(fields).subspan(i * elements, elements));
      }
    }
    file_.finish();
  }

 private:
  void add_times() {
    constexpr double per_degree = 180.0 / std::numbers::pi;
    const UtcTime origin{day_.course.steps.front().start.year, 1, 1};
    std::vector<double> starts, bounds, elevations, azimuths;
    std::vector<std::string> local;
    for (std::size_t i = 0; i < day_.steps; ++i) {
      const DayStep& step = day_.course.steps[i];
      starts.push_back(seconds_between(origin, step.start));
      bounds.insert(bounds.end(), {starts.back(), starts.back() + step.length_s});
      elevations.push_back(step.sun.elevation_rad * per_degree);
      azimuths.push_back(step.sun.azimuth_rad * per_degree);
      local.push_back(local_time_text(step.start, day_.course.offset_minutes));
    }
    const std::string units = fmt::format("seconds since {:04}-01-01 00:00:00", origin.year);
    const int time = file_.variable<double>("time", {time_}, units, "start of the step, UTC; its light is that of the middle");
    file_.attribute(time, "standard_name", "time");
    file_.attribute(time, "axis", "T");
    file_.attribute(time, "calendar", "proleptic_gregorian");
    file_.attribute(time, "bounds", "time_bounds");
    file_.put(time, std::span<const double>(starts));
    const int time_bounds = file_.variable<double>("time_bounds", {time_, end_});
    file_.put(time_bounds, std::span<const double>(bounds));
    file_.add("elevation_deg", {time_}, "degree", "elevation of the sun at the middle of the step", elevations);
    file_.add("azimuth_deg", {time_}, "degree", "azimuth of the sun at the middle of the step, clockwise from north", azimuths);
    file_.names("local_time", time_, local, "start of the step, local time with its offset");
  }

  void add_triangles() {
    const ElementFields places = make_element_places(day_.model);
    for (const Column& column : triangles_table(places).columns) {
      if (!column.is_in(in_netcdf) || column.name == "optics") continue;
      file_.add(column, {triangle_});
      if (!column.categories) continue;
      std::vector<std::string> names;
      for (const std::string& name : *column.categories) names.push_back(printable(name));
      file_.names(column.name + "_name", file_.dimension(column.name + "_kind", names.size()), names,
                  fmt::format("name of each value of {}", column.name));
    }
  }

  void define_light() {
    for (const Waveband& band : day_.model.bands) {
      for (const LightColumn column : columns_) {
        const int number = file_.variable<float>(fmt::format("{}_{}", band.name, ending(column)), {time_, triangle_},
                                                 light_units, meaning(column));
        file_.attribute(number, "coordinates", "x y z");
        if (column == LightColumn::absorbed)
          file_.attribute(number, "ancillary_variables", fmt::format("{}_{}", band.name, ending(LightColumn::absorbed_error)));
        file_.store_by_row(number, day_.model.canopy.size());
        light_.push_back(number);
      }
    }
  }

  const DayFields& day_;
  std::vector<LightColumn> columns_;
  NetcdfFile file_;
  int time_, end_, triangle_;
  std::vector<int> light_;  // [band * columns + column]
};

}  // namespace

void write_day_netcdf(const std::filesystem::path& file, const std::filesystem::path& aside, const DayFields& day) {
  EXPECT(day.steps, >, std::size_t{0});
  try {
    DayWriter(day, aside).write();
  } catch (const Error&) {
    std::error_code error;
    std::filesystem::remove(aside, error);
    throw;
  }
  replace_file(file, aside);
}

}  // namespace sunfleck
