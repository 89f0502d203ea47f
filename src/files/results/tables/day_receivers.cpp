#include "files/results/tables/day_receivers.h"

#include "files/results/tables/result_tables.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

constexpr unsigned outputs = in_csv | in_arrays;

void add_sensor_names(Table& table, const std::vector<Sensor>& sensors) {
  const std::vector<std::size_t> by_sensor{1};
  table.add({"sensor", "", "name of the sensor", outputs, by_sensor}, [&](std::size_t s) { return sensors[s].name; });
  table.add({"points", "1", "number of its points", outputs, by_sensor},
            [&](std::size_t s) { return static_cast<std::uint32_t>(sensors[s].points_m.size()); });
}

void add_heights(Table& table, const std::vector<PlaneReceiver>& planes) {
  table.add({"height_m", "m", "height of the plane", outputs, std::vector<std::size_t>{1}},
            [&](std::size_t p) { return planes[p].height_m; });
}

}  // namespace

Table sensors_day_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  struct Point {
    const Sensor& sensor;
    std::uint32_t number;
  };
  std::vector<Point> points;
  for (const Sensor& sensor : model.sensors) {
    for (std::uint32_t p = 0; p < sensor.points_m.size(); ++p) points.push_back({sensor, p});
  }
  const std::vector<std::size_t> by_point{1};
  Table table{"Sensors at each step, point by point",
              fmt::format("time: start of the step; x, y, z: m ({}); {}", axes_text(model.plot.axes), reading_units),
              {part.lights.size(), points.size()}};
  add_step_times(table, part.course);
  table.add({"sensor", "", "name of the sensor", outputs, by_point}, [&](std::size_t p) { return points[p].sensor.name; });
  table.add({"point", "1", "number of the point in its sensor, from 0", outputs, by_point},
            [&](std::size_t p) { return points[p].number; });
  add_positions(table, model.plot, by_point, [&](std::size_t p) { return points[p].sensor.points_m[points[p].number]; });
  add_readings(table, model.bands, outputs, [&](std::size_t row, std::size_t band) {
    return part.lights[row / points.size()].points[row % points.size() * model.bands.size() + band];
  });
  return table;
}

Table sensor_means_day_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::size_t sensors = model.sensors.size();
  Table table{"Sensors at each step, each the mean over its points",
              fmt::format("time: start of the step; {}", reading_units),
              {part.lights.size(), sensors}};
  add_step_times(table, part.course);
  add_sensor_names(table, model.sensors);
  add_readings(table, model.bands, outputs, [&](std::size_t row, std::size_t band) {
    return part.lights[row / sensors].sensors[row % sensors * model.bands.size() + band];
  });
  return table;
}

Table sensor_day_sums_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::size_t sensors = model.sensors.size();
  const std::vector<std::size_t> dates = part.dates();
  Table table{"Sensors on each date, the mean over their points summed over the steps",
              "direct, sky, scattered, total: MJ m-2 and mol of photons m-2, on a plane (cosine response) or on a sphere's "
              "cross-section (spherical); _error: half-width of the confidence interval",
              {dates.size(), sensors}};
  add_dates(table, part);
  add_sensor_names(table, model.sensors);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const auto add = [&, b](const char* name, const char* fate, Estimate SensorReading::*of) {
      add_sum(table, model.bands[b], name, fate, [&, b, of](std::size_t row) {
        return part.sums[dates[row / sensors]].sensors[row % sensors * model.bands.size() + b].*of;
      });
    };
    add("_direct", "of the sun's beam", &SensorReading::direct);
    add("_sky", "of unscattered sky light", &SensorReading::sky);
    add("_scattered", "of scattered and emitted light", &SensorReading::scattered);
    add("_total", "of all light", &SensorReading::total);
  }
  return table;
}

Table planes_day_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::size_t planes = model.planes.size();
  Table table{"The light that comes down through horizontal planes at each step",
              "time: start of the step; height_m: m; sunfleck_ratio: share of the plane that the direct beam reaches; down: W "
              "m-2; down_umol_m2_s: the same in photons, umol m-2 s-1; _error: half-width of the confidence interval",
              {part.lights.size(), planes}};
  add_step_times(table, part.course);
  add_heights(table, model.planes);
  table.add({"sunfleck_ratio", "1", "share of the plane that the direct beam reaches"},
            [&](std::size_t row) { return part.lights[row / planes].plane_sunfleck[row % planes]; });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const Waveband& band = model.bands[b];
    const auto down = [&, b](std::size_t row) {
      return part.lights[row / planes].plane_down[row % planes * model.bands.size() + b];
    };
    table.add({band.name + "_down", "W m-2", "flux through the plane, downwards"}, down);
    if (!(band.umol_per_joule > 0.0)) continue;
    table.add({band.name + "_down_umol_m2_s", "umol m-2 s-1", "photons through the plane, downwards"},
              [&](std::size_t row) { return down(row).scaled(band.umol_per_joule); });
  }
  return table;
}

Table plane_day_sums_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::size_t planes = model.planes.size();
  const std::vector<std::size_t> dates = part.dates();
  Table table{"The light that came down through horizontal planes on each date",
              "height_m: m; down: MJ m-2 and mol of photons m-2; _error: half-width of the confidence interval",
              {dates.size(), planes}};
  add_dates(table, part);
  add_heights(table, model.planes);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    add_sum(table, model.bands[b], "_down", "of all light through the plane, downwards", [&, b](std::size_t row) {
      return part.sums[dates[row / planes]].plane_down[row % planes * model.bands.size() + b];
    });
  }
  return table;
}

}  // namespace sunfleck
