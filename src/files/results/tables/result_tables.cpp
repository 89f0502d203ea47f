#include "files/results/tables/result_tables.h"

#include "base/check.h"
#include "base/units.h"
#include "files/results/tables/flux_terms.h"
#include "physics/canopy/axes.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

constexpr unsigned everywhere_but_meshes = in_csv | in_arrays | in_netcdf;

// Returns the table of the sensors first ... end - 1.
Table table_of_sensors(const RadiationModel& model, const RadiationResult& result, std::size_t first, std::size_t end) {
  EXPECT(result.sensors.size(), ==, model.sensors.size());
  struct Row {
    const Sensor& sensor;
    std::uint32_t point;
    const SensorResult& reading;
  };
  std::vector<Row> rows;
  for (std::size_t s = first; s < end; ++s) {
    const Sensor& sensor = model.sensors.at(s);
    EXPECT(result.sensors[s].size(), ==, sensor.points_m.size());
    for (std::uint32_t p = 0; p < sensor.points_m.size(); ++p) rows.push_back({sensor, p, result.sensors[s][p]});
  }
  Table table{
      "Sensors, point by point", fmt::format("x, y, z: m ({}); {}", axes_text(model.plot.axes), reading_units), {rows.size()}};
  table.add({"sensor", "", "name of the sensor", in_csv}, [&](std::size_t i) { return rows[i].sensor.name; });
  table.add({"point", "1", "number of the point in its sensor, from 0", in_csv}, [&](std::size_t i) { return rows[i].point; });
  add_positions(table, model.plot, {}, [&](std::size_t i) { return rows[i].sensor.points_m[rows[i].point]; });
  add_readings(table, model.bands, everywhere_but_meshes,
               [&](std::size_t i, std::size_t band) { return SensorReading(rows[i].reading, band); });
  return table;
}

}  // namespace

void add_classes(Table& table, const RadiationModel& model, const char* of, std::optional<double> ground_m2, unsigned outputs,
                 const std::function<const ShadeClassResult*(std::size_t)>& classes_of) {
  const auto get = [&](std::size_t i, const auto& value) {
    const ShadeClassResult* classes = classes_of(i);
    return classes != nullptr && !classes->absorbed_sunlit.empty() ? value(*classes) : Estimate{no_value, no_value};
  };
  const auto add_area = [&](const char* name, Estimate ShadeClassResult::*area) {
    table.add({fmt::format("{}_{}", name, ground_m2 ? "leaf_area_index" : "area_m2"), ground_m2 ? "1" : "m2",
               fmt::format("one-sided area {} that is {}{}", of, name, ground_m2 ? ", per ground area" : ""), outputs},
              [&](std::size_t i) {
                return get(i, [&](const auto& classes) { return (classes.*area).scaled(1.0 / ground_m2.value_or(1.0)); });
              });
  };
  add_area("sunlit", &ShadeClassResult::sunlit_m2);
  add_area("shaded", &ShadeClassResult::shaded_m2);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    const auto add = [&](const std::string& name, const std::string& flux, const std::string& photons,
                         std::vector<Estimate> ShadeClassResult::*absorbed) {
      const auto value = [&, b](std::size_t i, double factor) {
        return get(i, [&](const auto& classes) { return (classes.*absorbed).at(b).scaled(factor); });
      };
      table.add({fmt::format("{}_absorbed_{}", band, name), "W m-2", fmt::format("{} {}", flux, of), outputs},
                [&](std::size_t i) { return value(i, 1.0); });
      if (!(umol_per_joule > 0.0)) return;
      table.add(
          {fmt::format("{}_absorbed_{}_umol_m2_s", band, name), "umol m-2 s-1", fmt::format("{} {}", photons, of), outputs},
          [&](std::size_t i) { return value(i, umol_per_joule); });
    };
    const std::string absorbed = " absorbed by both faces per ";
    add("sunlit", "flux" + absorbed + "sunlit area", "photons" + absorbed + "sunlit area", &ShadeClassResult::absorbed_sunlit);
    const auto add_spread = [&](const std::string& part, std::vector<Estimate> ShadeClassResult::*spread) {
      const std::string over = "standard deviation, over the " + part + " area, of the ";
      add(part + "_sd", over + "flux absorbed there", over + "photons absorbed there", spread);
    };
    add_spread("sunlit", &ShadeClassResult::sunlit_sd);
    add("shaded", "flux" + absorbed + "shaded area", "photons" + absorbed + "shaded area", &ShadeClassResult::absorbed_shaded);
    add_spread("shaded", &ShadeClassResult::shaded_sd);
  }
}

void add_organ_names(Table& table, const std::vector<Organ>& organs, std::size_t axis) {
  const std::vector<std::size_t> along{axis};
  const auto add = [&](const char* name, const char* unit, const char* meaning, const auto part) {
    table.add({name, unit, meaning, in_csv | in_arrays, along}, [&](std::size_t o) { return organs[o].*part; });
  };
  add("plant", "1", "number of the plant, 0 for soil", &Organ::plant);
  add("organ", "", "name of the organ", &Organ::name);
  add("rank", "1", "leaf number from the ground, 0 for organs without one", &Organ::rank);
}

void add_organ_roles(Table& table, std::span<const Role> roles, std::size_t axis) {
  table.add({"role", "", "leaf, stem, fruit, structure, lamp or soil", in_csv | in_arrays, std::vector<std::size_t>{axis}},
            [&](std::size_t o) { return std::string(role_name(roles[o])); });
}

void add_positions(Table& table, const Plot& plot, const std::optional<std::vector<std::size_t>>& axes,
                   const std::function<glm::dvec3(std::size_t)>& position_of) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string meaning = axis == up_axis(plot.axes) ? "position upwards" : "position " + axis_heading(plot.axes, axis);
    table.add({std::string(1, "xyz"[axis]), "m", meaning, in_csv | in_arrays, axes},
              [&](std::size_t i) { return user_position_m(plot, position_of(i))[axis]; });
  }
}

void add_readings(Table& table, const std::vector<Waveband>& bands, unsigned outputs,
                  const std::function<SensorReading(std::size_t, std::size_t)>& reading_of) {
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const std::string& band = bands[b].name;
    const auto add = [&](const char* name, const char* meaning, Estimate SensorReading::*part) {
      table.add({band + name, "W m-2", meaning, outputs}, [&](std::size_t i) { return reading_of(i, b).*part; });
    };
    add("_direct", "reading of the sun's beam", &SensorReading::direct);
    add("_sky", "reading of unscattered sky light", &SensorReading::sky);
    add("_scattered", "reading of scattered and emitted light", &SensorReading::scattered);
    add("_total", "reading of all light", &SensorReading::total);
    const double umol_per_joule = bands[b].umol_per_joule;
    if (!(umol_per_joule > 0.0)) continue;
    table.add({band + "_total_umol_m2_s", "umol m-2 s-1", "reading of all light, in photons", outputs},
              [&](std::size_t i) { return reading_of(i, b).total.scaled(umol_per_joule); });
  }
}

Table organs_table(const RadiationModel& model, const RadiationResult& result) {
  const std::vector<Organ>& organs = model.canopy.organs;
  const std::vector<OrganResult>& light = result.organs;
  Table table{"Organs, those of soil elements included; the ground of [soil] has no row",
              "area_m2: m2, one-sided; sunlit_fraction: share of the area in direct sun; direct, indirect, absorbed: W m-2, "
              "mean over the organ's one-sided area; umol_m2_s: the same in photons; _sunlit, _shaded: mean over that part of "
              "the area; _sd: standard deviation over it; _error: half-width of the confidence interval",
              {organs.size()}};
  add_organ_names(table, organs, 0);
  table.add({"area_m2", "m2", "one-sided area"}, [&](std::size_t o) { return light[o].area_m2; });
  table.add({"sunlit_fraction", "1", "share of the area in direct sun"},
            [&](std::size_t o) { return as_share(light[o].sunlit_fraction); });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    table.add({band + "_direct", "W m-2", "irradiance of both faces by the sun's beam"},
              [&](std::size_t o) { return light[o].direct[b]; });
    table.add({band + "_indirect", "W m-2", "irradiance of both faces by all light but the sun's beam at its first hit"},
              [&](std::size_t o) { return light[o].indirect[b]; });
    table.add({band + "_absorbed", "W m-2", "flux absorbed by both faces per one-sided area"},
              [&](std::size_t o) { return light[o].absorbed[b]; });
    if (!(umol_per_joule > 0.0)) continue;
    table.add({band + "_absorbed_umol_m2_s", "umol m-2 s-1", "photons absorbed by both faces per one-sided area"},
              [&](std::size_t o) { return light[o].absorbed[b].scaled(umol_per_joule); });
  }
  add_classes(table, model, "of the organ", std::nullopt, in_csv | in_arrays, [&](std::size_t o) { return &light[o].classes; });
  add_organ_roles(table, organ_roles(model), 0);
  return table;
}

Table plants_table(const RadiationModel& model, const RadiationResult& result) {
  const std::vector<PlantResult>& plants = result.plants;
  Table table{
      "Plants: their leaves, stems and fruits together",
      fmt::format(
          "x, y, z: m ({}), where the plant was placed, or below the centroid of a plant whose mesh holds several; height_m: "
          "m, from its lowest to its highest point; leaf_area_m2: m2, one-sided; sunlit_leaf_fraction: share of the leaf area "
          "in direct sun; incident, absorbed: W, of the whole plant; absorbed_umol_s: the same in photons, umol s-1; _error: "
          "half-width of the confidence interval",
          axes_text(model.plot.axes)),
      {plants.size()}};
  table.add({"plant", "1", "number of the plant"}, [&](std::size_t p) { return plants[p].plant; });
  add_positions(table, model.plot, {}, [&](std::size_t p) { return plants[p].position_m; });
  table.add({"height_m", "m", "height from its lowest to its highest point"},
            [&](std::size_t p) { return plants[p].height_m; });
  table.add({"leaf_area_m2", "m2", "one-sided area of its leaves"}, [&](std::size_t p) { return plants[p].leaf_area_m2; });
  table.add({"sunlit_leaf_fraction", "1", "share of the leaf area in direct sun"},
            [&](std::size_t p) { return as_share(plants[p].sunlit_leaf_fraction); });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    table.add({band + "_incident", "W", "flux that reaches both faces of all its organs"},
              [&](std::size_t p) { return plants[p].incident_w[b]; });
    table.add({band + "_absorbed", "W", "flux that all its organs absorb"},
              [&](std::size_t p) { return plants[p].absorbed_w[b]; });
    if (!(umol_per_joule > 0.0)) continue;
    table.add({band + "_absorbed_umol_s", "umol s-1", "photons that all its organs absorb"},
              [&](std::size_t p) { return plants[p].absorbed_w[b].scaled(umol_per_joule); });
  }
  return table;
}

Table layers_table(const RadiationModel& model, const RadiationResult& result) {
  const std::vector<LayerResult>& layers = result.layers;
  const auto is_top_plane = [&](std::size_t i) { return layers[i].absorbed.empty(); };
  Table table{
      "Layers from the ground up, each with the horizontal plane at its lower edge; the last row is the top plane",
      "height_m: m; down, up: W m-2 through the plane; absorbed: W m-2 of ground in the layer; _sunlit, _shaded: W m-2 "
      "of that leaf area; _sd: standard deviation over it; umol_m2_s: in photons; leaf_area_index: m2 of leaves on a m2 of "
      "ground; others: shares; _error: half-width of the confidence interval",
      {layers.size()}};
  table.add({"height_m", "m", "height of the horizontal plane", everywhere_but_meshes},
            [&](std::size_t i) { return layers[i].height_m; });
  table.add({"leaf_area_index", "1", "one-sided leaf area in the layer per ground area"},
            [&](std::size_t i) { return is_top_plane(i) ? no_value : layers[i].leaf_area_index; });
  table.add({"sunfleck_ratio", "1",
             "share of the plane that the direct beam reaches; for an isolated stand, of the beam that meets stand or plot",
             everywhere_but_meshes},
            [&](std::size_t i) { return layers[i].sunfleck_ratio; });
  table.add({"sunlit_leaf_fraction", "1", "share of the leaf area in the layer in direct sun"},
            [&](std::size_t i) { return as_share(layers[i].sunlit_leaf_fraction); });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    table.add({band + "_down", "W m-2", "flux through the plane, downwards", everywhere_but_meshes},
              [&](std::size_t i) { return layers[i].down[b]; });
    table.add({band + "_up", "W m-2", "flux through the plane, upwards", everywhere_but_meshes},
              [&](std::size_t i) { return layers[i].up[b]; });
    table.add({band + "_absorbed", "W m-2", "flux absorbed by vegetation in the layer per ground area"},
              [&](std::size_t i) { return is_top_plane(i) ? Estimate{no_value} : layers[i].absorbed[b]; });
    table.add({band + "_absorbed_structure", "W m-2", "flux absorbed by structures and lamps in the layer per ground area"},
              [&](std::size_t i) { return is_top_plane(i) ? Estimate{no_value} : layers[i].absorbed_structure[b]; });
  }
  add_classes(table, model, "of the leaves in the layer", model.plot.area_m2(), in_csv | in_arrays | in_netcdf,
              [&](std::size_t i) { return is_top_plane(i) ? nullptr : &layers[i].leaf_classes; });
  return table;
}

Table balance_table(const RadiationResult& result) {
  const std::vector<BandResult>& bands = result.bands;
  Table table{"Bands", "W m-2 of ground", {bands.size()}};
  const auto add = [&](const char* name, const std::string& meaning, const auto flux) {
    table.add({name, "W m-2", meaning + " per ground area", in_netcdf | in_arrays},
              [&](std::size_t b) { return bands[b].*flux; });
  };
  for (const FluxTerm& term : flux_terms) add(term.name, term.meaning, term.flux);
  add("unshot", "flux not followed to its end", &BandResult::unshot);
  return table;
}

Table sensors_table(const RadiationModel& model, const RadiationResult& result) {
  return table_of_sensors(model, result, 0, model.sensors.size());
}

Table sensor_table(const RadiationModel& model, const RadiationResult& result, std::size_t sensor) {
  return table_of_sensors(model, result, sensor, sensor + 1);
}

Table sensor_means_table(const RadiationModel& model, const RadiationResult& result) {
  EXPECT(result.sensor_means.size(), ==, model.sensors.size());
  Table table{"Sensors, each the mean over its points", reading_units, {model.sensors.size()}};
  table.add({"sensor", "", "name of the sensor"}, [&](std::size_t s) { return model.sensors[s].name; });
  table.add({"points", "1", "number of its points", everywhere_but_meshes},
            [&](std::size_t s) { return static_cast<std::uint32_t>(model.sensors[s].points_m.size()); });
  add_readings(table, model.bands, everywhere_but_meshes,
               [&](std::size_t s, std::size_t band) { return SensorReading(result.sensor_means[s], band); });
  return table;
}

}  // namespace sunfleck
