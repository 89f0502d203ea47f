#include "files/results/exports/plane_day_netcdf.h"

#include "base/check.h"
#include "files/results/exports/day_time_axis.h"
#include "files/results/exports/netcdf_writer.h"
#include "files/results/tables/plane_day.h"
#include "files/results/tables/plane_map.h"

#include <limits>
#include <string>

namespace sunfleck {
namespace {

class PlaneWriter {
 public:
  PlaneWriter(const PlaneSteps& of, const std::filesystem::path& file)
      : of_(of),
        map_(of.model.planes[of.plane], of.model.plot),
        file_(plane_day_stem(of.model.planes[of.plane]) + ".nc", file),
        time_(add_time_axis(file_, of.course, of.steps)),
        second_(add_axis(map_.second)),
        first_(add_axis(map_.first)) {}

  void write() {
    add_record(file_, "day", of_.record, of_.model);
    file_.add("height_m", {}, "m", "height of the plane", std::vector{of_.model.planes[of_.plane].height_m});
    define("sunfleck", "1", "share of the cell that the direct beam reaches");
    for (const Waveband& band : of_.model.bands) {
      define(band.name + "_direct", "W m-2", "downward irradiance by the sun's beam");
      define(band.name + "_total", "W m-2", "downward irradiance by all light");
    }
    std::size_t begin = 0;
    for (std::size_t p = 0; p < of_.plane; ++p) begin += plane_map_values(of_.model, p);
    const std::size_t cells = std::size_t{map_.first.cells} * map_.second.cells;
    for (std::size_t step = 0; step < of_.steps; ++step) {
      const std::vector<float> maps = maps_of(step);
      for (std::size_t i = 0; i < variables_.size(); ++i)
        file_.put_rows(variables_[i], step, 1, std::span(maps).subspan(begin + i * cells, cells));
    }
    file_.finish();
  }

 private:
  int add_axis(const MapAxis& axis) {
    const int dimension = file_.dimension(axis.column, axis.cells);
    std::vector<double> centres(axis.cells);
    for (std::size_t cell = 0; cell < centres.size(); ++cell) centres[cell] = axis.centre_m(cell);
    file_.add(axis.column, {dimension}, "m", std::string("centre of the cell, towards the ") + axis.direction, centres);
    return dimension;
  }

  void define(const std::string& name, const char* units, const char* meaning) {
    const int number = file_.variable<float>(name, {time_, second_, first_}, units, meaning);
    file_.attribute(number, "coordinates", "height_m");
    file_.store_by_rows(number);
    variables_.push_back(number);
  }

  [[nodiscard]] std::vector<float> maps_of(std::size_t step) const {
    if (!of_.course.steps[step].unlit()) {
      std::vector<float> maps = of_.maps(step);
      EXPECT(maps.size(), ==, plane_map_values(of_.model));
      return maps;
    }
    std::vector<float> maps;
    for (const PlaneReceiver& plane : of_.model.planes) {
      const std::size_t cells = plane.cells();
      maps.insert(maps.end(), cells, std::numeric_limits<float>::quiet_NaN());
      maps.insert(maps.end(), 2 * of_.model.bands.size() * cells, 0.0F);
    }
    return maps;
  }

  const PlaneSteps& of_;
  UserMap map_;
  NetcdfFile file_;
  int time_, second_, first_;
  std::vector<int> variables_;
};

}  // namespace

void write_plane_steps(const std::filesystem::path& file, const std::filesystem::path& aside, const PlaneSteps& plane) {
  EXPECT(plane.steps, >, std::size_t{0});
  write_aside(file, aside, [&] { PlaneWriter(plane, aside).write(); });
}

}  // namespace sunfleck
