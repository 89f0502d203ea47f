#include "files/results/exports/day_netcdf.h"

#include "base/check.h"
#include "files/results/exports/day_time_axis.h"
#include "files/results/exports/netcdf_file.h"
#include "files/results/exports/netcdf_rows.h"
#include "files/results/exports/netcdf_writer.h"
#include "files/results/tables/day_fields.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

class DayWriter {
 public:
  DayWriter(const DayFields& day, const std::filesystem::path& aside)
      : day_(day),
        columns_(day_columns(day.model)),
        aside_(aside),
        file_("day.nc", aside),
        time_(add_time_axis(file_, day.course, day.steps)),
        triangle_(file_.dimension("triangle", day.model.canopy.size())) {}

  void write() {
    add_record(file_, "day", day_.record, day_.model);
    add_triangles();
    define_light();
    file_.finish();
    const std::size_t elements = day_.model.canopy.size();
    NetcdfRows rows("day.nc", aside_, light_, elements);
    const std::vector<float> dark(light_.size() * elements);
    for (std::size_t step = 0; step < day_.steps; ++step) {
      rows.put(step, day_.course.steps[step].unlit() ? dark : day_.fields(step));
    }
    rows.finish();
  }

 private:
  void add_triangles() {
    const ElementFields places = make_element_places(day_.model);
    for (const Column& column : triangles_table(places).columns) {
      if (!column.is_in(in_netcdf)) continue;
      if (column.categories) {
        add_kinds(file_, column, triangle_);
      } else {
        file_.add(column, {triangle_});
      }
    }
  }

  void define_light() {
    for (const Waveband& band : day_.model.bands) {
      for (const LightColumn column : columns_) {
        light_.push_back(fmt::format("{}_{}", band.name, ending(column)));
        const int number = file_.variable<float>(light_.back(), {time_, triangle_}, light_units, meaning(column));
        file_.attribute(number, "coordinates", "x y z");
        if (column == LightColumn::absorbed)
          file_.attribute(number, "ancillary_variables", fmt::format("{}_{}", band.name, ending(LightColumn::absorbed_error)));
        file_.store_by_rows(number);
      }
    }
  }

  const DayFields& day_;
  std::vector<LightColumn> columns_;
  std::filesystem::path aside_;
  NetcdfFile file_;
  int time_, triangle_;
  std::vector<std::string> light_;  // names of the variables, [band * columns + column]
};

}  // namespace

void write_day_netcdf(const std::filesystem::path& file, const std::filesystem::path& aside, const DayFields& day) {
  EXPECT(day.steps, >, std::size_t{0});
  write_aside(file, aside, [&] { DayWriter(day, aside).write(); });
}

}  // namespace sunfleck
