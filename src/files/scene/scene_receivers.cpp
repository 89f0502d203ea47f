#include "files/scene/scene_receivers.h"

#include "files/scene/plain_name.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <set>
#include <string>

namespace sunfleck {

namespace {

constexpr std::size_t most_planes = 64;
constexpr double most_cells = 64e6;  // of all planes together: 1.5 GB with one band
constexpr double default_cell_m = 0.01;
constexpr double default_cells = 1e6;         // most cells of a plane without `cells`
constexpr std::int64_t most_points = 100000;  // of all sensors together

// Chooses nearly square cells of 1 cm, or larger ones if there would be too many.
void set_default_cells(PlaneReceiver& plane, const Plot& plot) {
  const double cell_m = std::max(default_cell_m, std::sqrt(plot.area_m2() / default_cells));
  const double along_x = std::clamp(std::round(plot.size_x_m / cell_m), 1.0, default_cells);
  const double along_z =
      std::clamp(std::round(plot.size_z_m / cell_m), 1.0, std::max(1.0, std::floor(default_cells / along_x)));
  plane.cells_x = static_cast<int>(along_x);
  plane.cells_z = static_cast<int>(along_z);
}

PlaneReceiver read_plane(const TomlTable& table, const Plot& plot) {
  table.allow({"height", "cells"});
  table.require("height", "height = 0.5, metres above the ground");
  PlaneReceiver plane;
  plane.height_m = *table.number("height", {.lo = 0.0, .hi = farthest_m, .cure = "give metres above the ground"});
  const auto cells =
      table.numbers("cells", 2,
                    {.lo = 1.0,
                     .hi = most_cells,
                     .cure = plot.axes == Axes::south_up_west ? "give whole numbers, along X and along Z, such as [180, 240]"
                                                              : "give whole numbers, along x and along y, such as [180, 240]"});
  if (!cells) {
    set_default_cells(plane, plot);
    return plane;
  }
  for (const double count : *cells) {
    if (count != std::floor(count))
      table.refuse("cells", fmt::format("{} is not a whole number", count), "write it as [180, 240]");
  }
  const glm::dvec2 along_xz = along_level_axes(plot.axes, {(*cells)[0], (*cells)[1]});
  plane.cells_x = static_cast<int>(along_xz.x);
  plane.cells_z = static_cast<int>(along_xz.y);
  return plane;
}

std::string read_sensor_name(const TomlTable& table, std::set<std::string>& earlier) {
  table.require("name", "name = \"ceptometer\"");
  std::string name = *table.text("name");
  if (!is_plain_name(name)) table.refuse("name", plain_name_rule, "give a name such as ceptometer or row_1");
  if (!earlier.insert(name).second) {
    table.refuse("name", "another [[sensor]] has this name", "give every sensor a different name");
  }
  return name;
}

// Returns the points in the scene's coordinates.
std::vector<glm::dvec3> read_points(const TomlTable& table, const Plot& plot) {
  table.require("from", "from = [0.2, 1.2, 0.1]");
  const glm::dvec3 from_m = scene_position_m(plot, *table.triple("from", anywhere));
  if (!table.has("to")) {
    if (table.has("points")) table.refuse("points", "points need `to`", "add `to`, or remove points");
    return {from_m};
  }
  table.require("points", "points = 80, spread from `from` to `to`");
  const glm::dvec3 to_m = scene_position_m(plot, *table.triple("to", anywhere));
  const std::int64_t count = *table.integer("points", 2, most_points);
  std::vector<glm::dvec3> points_m;
  for (std::int64_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    points_m.push_back((1.0 - share) * from_m + share * to_m);
  }
  return points_m;
}

Sensor read_sensor(const TomlTable& table, const Plot& plot, std::set<std::string>& earlier) {
  table.allow({"name", "from", "to", "points", "response", "normal"});
  Sensor sensor;
  sensor.name = read_sensor_name(table, earlier);
  sensor.points_m = read_points(table, plot);
  if (const auto response = table.word("response", {"cosine", "spherical"})) {
    sensor.response = *response == 0 ? SensorResponse::cosine : SensorResponse::spherical;
  }
  const char* example = plot.axes == Axes::south_up_west ? "give a direction, such as [0, 1, 0] for up"
                                                         : "give a direction, such as [0, 0, 1] for up";
  const auto normal = table.triple("normal", {.lo = -1e6, .hi = 1e6, .cure = example});
  if (!normal) return sensor;
  if (sensor.response == SensorResponse::spherical) {
    table.refuse("normal", "a spherical sensor has no normal", "remove it, or response = \"spherical\"");
  }
  const double length = glm::length(*normal);
  if (length < 1e-6) table.refuse("normal", "it has zero length", example);
  sensor.normal = scene_direction(plot.axes, *normal) / length;
  return sensor;
}

}  // namespace

std::vector<PlaneReceiver> read_planes(const TomlTable& root, const Plot& plot) {
  const std::vector<TomlTable> tables = root.tables("plane");
  if (tables.size() > most_planes) {
    root.refuse("plane", fmt::format("there are {}, but at most {} are allowed", tables.size(), most_planes), "remove some");
  }
  std::vector<PlaneReceiver> planes;
  double cells = 0.0;
  for (const TomlTable& table : tables) {
    const PlaneReceiver plane = read_plane(table, plot);
    const std::string stem = plane_stem(plane.height_m);
    if (std::any_of(planes.begin(), planes.end(), [&](const auto& other) { return plane_stem(other.height_m) == stem; })) {
      table.refuse("height", fmt::format("another [[plane]] has this height and the same file, {}.csv", stem),
                   "give every plane a different height, in whole millimetres");
    }
    planes.push_back(plane);
    cells += static_cast<double>(plane.cells());
    if (cells > most_cells) {
      table.refuse(table.has("cells") ? "cells" : "height",
                   fmt::format("the planes have {:.3g} cells so far, but at most {:.3g} are allowed", cells, most_cells),
                   "use fewer");
    }
  }
  std::sort(planes.begin(), planes.end(), [](const auto& a, const auto& b) { return a.height_m < b.height_m; });
  return planes;
}

std::vector<Sensor> read_sensors(const TomlTable& root, const Plot& plot) {
  std::vector<Sensor> sensors;
  std::set<std::string> names;
  std::size_t points = 0;
  for (const TomlTable& table : root.tables("sensor")) {
    sensors.push_back(read_sensor(table, plot, names));
    points += sensors.back().points_m.size();
    if (points > static_cast<std::size_t>(most_points)) {
      table.refuse(table.has("points") ? "points" : "from",
                   fmt::format("the sensors have {} points so far, but at most {} are allowed", points, most_points),
                   "use fewer");
    }
  }
  return sensors;
}

}  // namespace sunfleck
