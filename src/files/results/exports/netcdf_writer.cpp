#include "files/results/exports/netcdf_writer.h"

#include "base/file.h"
#include "files/results/exports/record_entries.h"
#include "files/results/tables/result_tables.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

// Returns a flag meaning; CF 1.8, section 3.5 restricts these words to letters, digits and _ - . + @.
std::string flag_word(const std::string& name) {
  std::string word = name;
  for (char& c : word) {
    const bool allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                         std::string_view("_-.+@").find(c) != std::string_view::npos;
    if (!allowed) c = '_';
  }
  return word.empty() ? "_" : word;
}

class ResultsWriter {
 public:
  explicit ResultsWriter(const ExportData& data)
      : data_(data), triangle_(file_.dimension("triangle", data.fields.size())), vertex_(file_.dimension("vertex", 3)) {}

  std::string take() {
    add_record(file_, "run", data_.record, data_.model);
    add_triangles();
    add_bands();
    add_profile();
    add_sensors();
    return file_.take();
  }

 private:
  void add_light(const Column& column) {
    const int number = file_.variable(column, {triangle_});
    file_.attribute(number, "coordinates", "x y z");
    file_.put(number, column);
  }

  void add_corners(int axis) {
    std::vector<double> corners;
    for (std::size_t e = 0; e < data_.fields.size(); ++e) {
      for (std::size_t k = 0; k < 3; ++k) corners.push_back(corner_m(data_.model, e, k)[axis]);
    }
    file_.add(fmt::format("corner_{}", "xyz"[axis]), {triangle_, vertex_}, "m",
              fmt::format("corners, counter-clockwise seen from the upper face, {}", axis_heading(data_.model.plot.axes, axis)),
              corners);
  }

  void add_triangles() {
    for (const Column& column : triangles_table(data_.fields).columns) {
      if (!column.is_in(in_netcdf)) continue;
      if (is_light(column)) {
        add_light(column);
      } else if (column.categories) {
        add_kinds(file_, column, triangle_);
      } else {
        file_.add(column, {triangle_});
      }
      for (int axis = 0; axis < 3; ++axis) {
        if (column.name == std::string(1, "xyz"[axis])) add_corners(axis);
      }
    }
  }

  void add_bands() {
    std::vector<std::string> names;
    for (const Waveband& band : data_.model.bands) names.push_back(band.name);
    const int band = file_.dimension("band", names.size());
    file_.names("band_name", band, names, "waveband");
    for (const Column& column : balance_table(data_.result).columns) {
      const int number = file_.add(column, {band});
      if (!column.name.ends_with("_error")) file_.attribute(number, "coordinates", "band_name");
    }
    file_.add("plot_area_m2", {}, "m2", "area of the plot", std::vector{data_.model.plot.area_m2()});
    file_.add("leaf_area_index", {}, "1", "one-sided leaf area per ground area", std::vector{data_.result.leaf_area_index});
  }

  void add_profile() {
    if (data_.result.layers.empty()) return;
    const int plane = file_.dimension("plane_height", data_.result.layers.size());
    for (Column& column : layers_table(data_.model, data_.result).columns) {
      if (!column.is_in(in_netcdf)) continue;
      const bool is_height = column.name == "height_m";
      if (is_height) column.name = "plane_height";
      const int number = file_.add(column, {plane});
      if (!is_height) continue;
      file_.attribute(number, "positive", "up");
      file_.attribute(number, "axis", "Z");
    }
  }

  // Adds the columns of a sensor table that are in_arrays under names that begin with `prefix`; its texts are names of sensors.
  void add_sensor_table(const Table& table, const std::string& prefix, int dimension) {
    for (Column column : table.columns) {
      if (const auto* names = std::get_if<std::span<const std::string>>(&column.values)) {
        file_.names(prefix + "name", dimension, *names, column.meaning);
      } else if (column.is_in(in_arrays)) {
        column.name.insert(0, prefix);
        if (!column.error_column.empty()) column.error_column.insert(0, prefix);
        file_.add(column, {dimension});
      }
    }
  }

  void add_sensors() {
    if (data_.result.sensors.empty()) return;
    const Table points = sensors_table(data_.model, data_.result);
    add_sensor_table(points, "sensor_point_", file_.dimension("sensor_point", points.rows()));
    const Table means = sensor_means_table(data_.model, data_.result);
    add_sensor_table(means, "sensor_", file_.dimension("sensor", means.rows()));
  }

  const ExportData& data_;
  NetcdfFile file_{"results.nc"};
  int triangle_, vertex_;
};

}  // namespace

void add_kinds(NetcdfFile& file, Column kinds, int dimension) {
  kinds.unit.clear();
  const int number = file.variable(kinds, {dimension});
  std::vector<std::int32_t> flags;
  std::string meanings;
  for (const std::string& name : *kinds.categories) {
    if (!flags.empty()) meanings += ' ';
    meanings += flag_word(name);
    flags.push_back(static_cast<std::int32_t>(flags.size()));
  }
  if (!flags.empty()) {
    file.attribute(number, "flag_values", flags);
    file.attribute(number, "flag_meanings", meanings);
  }
  file.put(number, kinds);
  file.names(kinds.name + "_name", file.dimension(kinds.name + "_kind", flags.size()), *kinds.categories,
             fmt::format("name of each value of {}", kinds.name));
}

void add_record(NetcdfFile& file, std::string_view command, const RunRecord& record, const RadiationModel& model) {
  constexpr int whole_file = -1;
  file.attribute(whole_file, "Conventions", "CF-1.8");
  file.attribute(whole_file, "source", fmt::format("sunfleck {}", printable(record.version)));
  file.attribute(whole_file, "history", fmt::format("sunfleck {} {}", command, printable(record.scene_file)));
  for (const RecordEntry& entry : record_entries(record, model)) file.attribute(whole_file, entry.key, entry.value);
}

std::string netcdf_bytes(const ExportData& data) {
  return ResultsWriter(data).take();
}

}  // namespace sunfleck
