#include "files/scene/receiver_plausibility.h"

#include "physics/canopy/axes.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace sunfleck {
namespace {

constexpr double widest_plot = 30.0;  // in widths of the stand

struct StandBox {
  glm::dvec3 lo_m{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi_m{-std::numeric_limits<double>::infinity()};
};

// Returns the box around everything but soil; nothing if there is nothing else.
std::optional<StandBox> box_of_stand(const RadiationModel& model) {
  const Surfaces surfaces(model);
  StandBox box;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    if (surfaces.at(e).soil()) continue;
    for (const glm::vec3& corner : model.canopy.corners[e]) {
      const glm::dvec3 at_m = glm::dvec3(corner) + model.canopy.origin_m;
      box.lo_m = glm::min(box.lo_m, at_m);
      box.hi_m = glm::max(box.hi_m, at_m);
    }
  }
  if (box.lo_m.x > box.hi_m.x) return std::nullopt;
  return box;
}

void warn_of_planes(const TomlTable& root, double top_m, std::vector<std::string>& warnings) {
  for (const TomlTable& plane : root.tables("plane")) {
    const auto height_m = plane.number("height", anywhere);
    if (!height_m || *height_m <= top_m) continue;
    warnings.push_back(fmt::format("{}: {:.6g} m lies above the stand, so nothing shades this plane; give less than {:.4g}",
                                   plane.place("height"), *height_m, top_m));
  }
}

// Returns where the first point outside the allowed rectangle lies.
std::optional<glm::dvec3> first_outside(const Sensor& sensor, const Plot& plot) {
  const double beyond = plot.periodic ? 1.0 : 0.0;
  const auto is_outside = [&](const glm::dvec3& at_m) {
    return at_m.x < -beyond * plot.size_x_m || at_m.x > (1.0 + beyond) * plot.size_x_m || at_m.z < -beyond * plot.size_z_m ||
           at_m.z > (1.0 + beyond) * plot.size_z_m;
  };
  const auto found = std::find_if(sensor.points_m.begin(), sensor.points_m.end(), is_outside);
  if (found == sensor.points_m.end()) return std::nullopt;
  return *found;
}

// A point below the soil plane counts as on it. The lowest point of a line is one of its ends.
void warn_of_buried_sensor(const TomlTable& table, const Sensor& sensor, const Plot& plot, std::vector<std::string>& warnings) {
  if (sensor.points_m.empty()) return;
  const bool is_end = sensor.points_m.back().y < sensor.points_m.front().y;
  const double y_m = (is_end ? sensor.points_m.back() : sensor.points_m.front()).y;
  if (y_m >= 0.0) return;
  warnings.push_back(
      fmt::format("{}: {} = {:.6g} m lies below the ground, where a sensor reads the light on the ground; give 0 or more",
                  table.place(is_end ? "to" : "from"), axis_letter(plot.axes, up_axis(plot.axes)), y_m));
}

void warn_of_sensors(const TomlTable& root, const RadiationModel& model, std::vector<std::string>& warnings) {
  const std::vector<TomlTable> tables = root.tables("sensor");
  const Plot& plot = model.plot;
  const auto [first, second] = level_axes(plot.axes);
  const std::array letters = {axis_letter(plot.axes, first), axis_letter(plot.axes, second)};
  const glm::dvec2 size_m = along_level_axes(plot.axes, {plot.size_x_m, plot.size_z_m});
  for (std::size_t s = 0; s < std::min(tables.size(), model.sensors.size()); ++s) {
    if (model.soil) warn_of_buried_sensor(tables[s], model.sensors[s], plot, warnings);
    const auto at_m = first_outside(model.sensors[s], plot);
    if (!at_m) continue;
    const glm::dvec3 user_m = user_position_m(plot, *at_m);
    warnings.push_back(
        fmt::format("{}: {} = {:.6g} m, {} = {:.6g} m lies outside the plot{}; give {} in 0..{:.6g} and {} in "
                    "0..{:.6g}",
                    tables[s].place("from"), letters[0], user_m[first], letters[1], user_m[second],
                    plot.periodic ? " and the periods next to it" : "", letters[0], size_m.x, letters[1], size_m.y));
  }
}

void warn_of_wide_plot(const TomlTable& root, const Plot& plot, const StandBox& box, std::vector<std::string>& warnings) {
  const double width_m = std::max(box.hi_m.x - box.lo_m.x, box.hi_m.z - box.lo_m.z);
  if (width_m <= 0.0 || std::min(plot.size_x_m, plot.size_z_m) <= widest_plot * width_m) return;
  const double times = std::min(plot.size_x_m, plot.size_z_m) / width_m;
  constexpr double too_wide = 200.0;
  const glm::dvec2 size_m = along_level_axes(plot.axes, {plot.size_x_m, plot.size_z_m});
  warnings.push_back(fmt::format(
      "{}: the plot is {:.0f} times wider than the stand, {:.4g} m; if centimetres were meant, give "
      "[{:.6g}, {:.6g}]{}",
      root.table("plot")->place("size"), times, width_m, size_m.x / 100.0, size_m.y / 100.0,
      times < too_wide ? ""
                       : fmt::format(", or else at most {:.4g}: rays may miss all of the soil beside the stand, whose "
                                     "light the errors then leave out",
                                     too_wide * width_m)));
}

}  // namespace

std::vector<std::string> receiver_warnings(const TomlTable& root, const Scene& scene) {
  std::vector<std::string> warnings;
  warn_of_sensors(root, scene.model, warnings);
  const auto box = box_of_stand(scene.model);
  if (!box) return warnings;
  warn_of_planes(root, box->hi_m.y, warnings);
  warn_of_wide_plot(root, scene.model.plot, *box, warnings);
  return warnings;
}

}  // namespace sunfleck
