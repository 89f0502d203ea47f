#include "io/day_netcdf.h"

#include "base/check.h"
#include "base/error.h"
#include "io/export_formats.h"
#include "io/file.h"
#include "io/netcdf_file.h"
#include "io/step_store.h"

#include <fmt/format.h>

#include <array>
#include <numbers>

namespace sunfleck {
namespace {

constexpr int whole_file = -1;

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
    define_record();
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
  void define_record() {
    const RunRecord& record = day_.record;
    file_.attribute(whole_file, "Conventions", "CF-1.8");
    file_.attribute(whole_file, "source", fmt::format("sunfleck {}", clean_text(record.version)));
    file_.attribute(whole_file, "history", fmt::format("sunfleck day {}", clean_text(record.scene_file)));
    for (const RecordEntry& entry : record_entries(record, day_.model)) file_.attribute(whole_file, entry.key, entry.value);
  }

  template <class T>
  int describe(const std::string& name, const std::vector<int>& dimensions, std::string_view units, std::string_view meaning) {
    const int number = file_.variable<T>(name, dimensions);
    file_.attribute(number, "long_name", meaning);
    if (!units.empty()) file_.attribute(number, "units", units);
    return number;
  }
  template <class T>
  int add(const std::string& name, const std::vector<int>& dimensions, std::string_view units, std::string_view meaning,
          const std::vector<T>& values) {
    const int number = describe<T>(name, dimensions, units, meaning);
    file_.put(number, std::span<const T>(values));
    return number;
  }
  template <class T>
  void add(const PlaceColumn& column, const std::vector<T>& values) {
    add(column.name, {triangle_}, column.units, column.meaning, values);
  }

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
    const int time = describe<double>("time", {time_}, units, "start of the step, UTC; its light is that of the middle");
    file_.attribute(time, "standard_name", "time");
    file_.attribute(time, "axis", "T");
    file_.attribute(time, "calendar", "proleptic_gregorian");
    file_.attribute(time, "bounds", "time_bounds");
    file_.put(time, std::span<const double>(starts));
    const int time_bounds = file_.variable<double>("time_bounds", {time_, end_});
    file_.put(time_bounds, std::span<const double>(bounds));
    add("elevation_deg", {time_}, "degree", "elevation of the sun at the middle of the step", elevations);
    add("azimuth_deg", {time_}, "degree", "azimuth of the sun at the middle of the step, clockwise from north", azimuths);
    file_.names("local_time", time_, local, "start of the step, local time with its offset");
  }

  void add_triangles() {
    const ElementFields places = make_element_places(day_.model.canopy);
    std::vector<std::int64_t> numbers;
    for (std::size_t e = 0; e < places.size(); ++e) numbers.push_back(static_cast<std::int64_t>(e));
    add(triangle_column, numbers);
    add(plant_column, std::vector<std::int64_t>(places.plant.begin(), places.plant.end()));
    add(rank_column, places.rank);
    std::vector<std::string> organs;
    for (const std::string& name : places.organ_names) organs.push_back(clean_text(name));
    add(organ_column, places.organ);
    file_.names("organ_name", file_.dimension("organ_kind", organs.size()), organs, "name of each value of organ");
    add(area_column, places.area_m2);
    constexpr std::array axes = {"x", "y", "z"};
    constexpr std::array directions = {"towards the south", "up", "towards the west"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      add(axes[axis], {triangle_}, "m", fmt::format("centroid, {}", directions[axis]), places.centroid_m[axis]);
    }
  }

  void define_light() {
    for (const Waveband& band : day_.model.bands) {
      for (const LightColumn column : columns_) {
        const int number =
            describe<float>(fmt::format("{}_{}", band.name, ending(column)), {time_, triangle_}, light_units, meaning(column));
        file_.attribute(number, "coordinates", "x y z");
        if (column == LightColumn::absorbed) file_.attribute(number, "ancillary_variables", band.name + "_error");
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
