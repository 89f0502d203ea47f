#include "files/results/tables/day_tables.h"

#include "base/units.h"
#include "files/results/tables/day_receivers.h"
#include "files/results/tables/flux_terms.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

constexpr unsigned table_outputs = in_csv | in_arrays;

void note_if_stopped(Table& table, const DayCourse& course, std::size_t steps_done) {
  if (steps_done == course.steps.size()) return;
  table.notes.push_back(fmt::format("incomplete: the first {} of {} steps", steps_done, course.steps.size()));
}

void add_plants(Table& table, const DayStand& stand, std::size_t axis) {
  const PlantAreas& plants = stand.plants;
  const std::vector<std::size_t> along{axis};
  const auto add = [&](const char* name, const char* unit, const char* meaning, const auto& value) {
    table.add({name, unit, meaning, table_outputs, along}, value);
  };
  add("plant", "1", "number of the plant", [&](std::size_t p) { return plants.sites[p].plant; });
  add_positions(table, stand.model.plot, along, [&](std::size_t p) { return plants.sites[p].position_m; });
  add("height_m", "m", "height from its lowest to its highest point", [&](std::size_t p) { return plants.height_m[p]; });
  add("leaf_area_m2", "m2", "one-sided area of its leaves", [&](std::size_t p) { return plants.leaf_m2[p]; });
}

// Returns what a kind of organs absorbed on a date, as a share of what arrived. The half-width bounds that of the quotient for
// any correlation of the two.
Estimate share_of(const Estimate& absorbed, const Estimate& incident) {
  if (!(incident.value > 0.0)) return {no_value, no_value};
  const double share = absorbed.value / incident.value;
  return {share, (absorbed.half_width + share * incident.half_width) / incident.value};
}

}  // namespace

std::vector<std::size_t> DayPart::dates() const {
  std::vector<std::size_t> with_steps;
  for (std::size_t d = 0; d < sums.size(); ++d) {
    if (sums[d].steps > 0) with_steps.push_back(d);
  }
  return with_steps;
}

void add_step_times(Table& table, const DayCourse& course) {
  table.add({"time", "", "start of the step, local time with its offset", table_outputs, std::vector<std::size_t>{0}},
            [&](std::size_t i) { return local_time_text(course.steps[i].start, course.offset_minutes); });
}

void add_dates(Table& table, const DayPart& part) {
  const std::vector<std::size_t> dates = part.dates();
  table.add({"date", "", "local date", table_outputs, std::vector<std::size_t>{0}},
            [&](std::size_t d) { return part.course.dates[dates[d]]; });
}

Table steps_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::vector<DayStep>& steps = part.course.steps;
  const std::span<const StepLight> lights = part.lights;
  Table table{
      "The course of the day; a step has the light of its middle, at night that of lamps alone",
      "time: start of the step; step_s: s; elevation, azimuth: of the middle, degrees; incident, absorbed, reflected, "
      "transmitted, unshot: W m-2 of ground; _sunlit, _shaded: W m-2 of that leaf area; sunlit_leaf_fraction: share; _error: "
      "half-width of the confidence interval",
      {lights.size()}};
  add_step_times(table, part.course);
  table.add({"step_s", "s", "length of the step"}, [&](std::size_t i) { return steps[i].length_s; });
  table.add({"elevation_deg", "degree", "elevation of the sun at the middle of the step"},
            [&](std::size_t i) { return steps[i].sun.elevation_rad / degree; });
  table.add({"azimuth_deg", "degree", "azimuth of the sun at the middle of the step, clockwise from north"},
            [&](std::size_t i) { return steps[i].sun.azimuth_rad / degree; });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    for (const FluxTerm& term : flux_terms) {
      table.add(
          {fmt::format("{}_{}", model.bands[b].name, term.name), "W m-2", fmt::format("{} per ground area", term.meaning)},
          [&](std::size_t i) { return lights[i].bands[b].*term.flux; });
    }
  }
  table.add({"sunlit_leaf_fraction", "1", "share of the leaf area in direct sun"},
            [&](std::size_t i) { return as_share(lights[i].sunlit_leaf_fraction); });
  add_classes(table, model, "of the leaves", model.plot.area_m2(), in_csv | in_arrays,
              [&](std::size_t i) { return &lights[i].leaf_classes; });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    table.add({model.bands[b].name + "_unshot", "W m-2", "flux not followed to its end per ground area"},
              [&, b](std::size_t i) { return lights[i].bands[b].unshot; });
  }
  return table;
}

Table day_sums_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::vector<DateSums>& sums = part.sums;
  const std::vector<std::size_t> dates = part.dates();
  Table table{
      "The light of each date: sums over its steps",
      "steps: their number; incident, absorbed, reflected, transmitted, unshot: per ground area, MJ m-2 and mol of photons "
      "m-2; _error: half-width of the confidence interval",
      {dates.size()}};
  add_dates(table, part);
  table.add({"steps", "1", "number of its steps"},
            [&](std::size_t d) { return static_cast<std::uint32_t>(sums[dates[d]].steps); });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const auto add = [&, b](const std::string& name, const std::string& fate, Estimate BandFluxes::*term) {
      add_sum(table, model.bands[b], name, fate + " per ground area",
              [&, b, term](std::size_t d) -> const Estimate& { return sums[dates[d]].bands[b].*term; });
    };
    add("_incident", "that arrived", &BandFluxes::incident);
    add("_absorbed_vegetation", "absorbed by vegetation", &BandFluxes::absorbed_vegetation);
    add("_absorbed_structure", "absorbed by structures and lamps", &BandFluxes::absorbed_structure);
    add("_absorbed_soil", "absorbed by soil", &BandFluxes::absorbed_soil);
    add("_reflected", "that left upwards", &BandFluxes::reflected);
    add("_transmitted", "that left downwards", &BandFluxes::transmitted);
  }
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    table.add({model.bands[b].name + "_unshot_mj_m2", "MJ m-2", "energy not followed to its end per ground area"},
              [&, b](std::size_t d) { return per_mega * sums[dates[d]].bands[b].unshot; });
  }
  return table;
}

Table organs_day_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::vector<std::size_t> by_organ{1};
  const std::vector<Organ>& organs = model.canopy.organs;
  const std::vector<DateSums>& sums = part.sums;
  const std::vector<std::size_t> dates = part.dates();
  Table table{"What organs absorbed over the steps of each date, soil elements included; the ground of [soil] has no row",
              "area_m2: m2, one-sided; absorbed: per one-sided area, MJ m-2 and mol of photons m-2; _error: half-width of the "
              "confidence interval",
              {dates.size(), organs.size()}};
  add_dates(table, part);
  add_organ_names(table, organs, 1);
  table.add({"area_m2", "m2", "one-sided area", table_outputs, by_organ}, stand.kinds.organ_m2);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const auto joules = [&, b](std::size_t row) -> const Estimate& {
      return sums[dates[row / organs.size()]].organ_absorbed[row % organs.size() * model.bands.size() + b];
    };
    add_sum(table, model.bands[b], "_absorbed", "absorbed by both faces per one-sided area", joules);
  }
  add_organ_roles(table, stand.kinds.organ_roles, 1);
  return table;
}

Table plants_day_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::vector<DateSums>& sums = part.sums;
  const std::vector<std::size_t> dates = part.dates();
  const PlantAreas& plants = stand.plants;
  Table table{
      "What plants, their leaves, stems and fruits together, absorbed over the steps of each date",
      fmt::format(
          "x, y, z: m ({}); height_m: m; leaf_area_m2: m2, one-sided; absorbed: of the whole plant, MJ and mol of photons; "
          "_error: half-width of the confidence interval",
          axes_text(model.plot.axes)),
      {dates.size(), plants.size()}};
  add_dates(table, part);
  add_plants(table, stand, 1);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    const auto joules = [&, b](std::size_t row) -> const Estimate& {
      return sums[dates[row / plants.size()]].plant_absorbed[row % plants.size() * model.bands.size() + b];
    };
    table.add({band + "_absorbed_mj", "MJ", "energy that all its organs absorbed"},
              [&](std::size_t row) { return joules(row).scaled(per_mega); });
    if (!(umol_per_joule > 0.0)) continue;
    table.add({band + "_absorbed_mol", "mol", "photons that all its organs absorbed"},
              [&](std::size_t row) { return joules(row).scaled(umol_per_joule * per_mega); });
  }
  return table;
}

Table season_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::vector<OrganKind>& kinds = stand.kinds.of;
  const std::vector<std::size_t> by_kind{1}, dates = part.dates();
  const double plot_m2 = model.plot.area_m2();
  Table table{
      "What each kind of organs, such as leaf, stem and soil, absorbed on each date; soil is all soil, the ground of [soil] "
      "included",
      "organs: their number; area_m2: m2, one-sided, of soil as seen from above; area_index: the same per ground area; "
      "absorbed_ground: per ground area, MJ m-2 and mol of photons m-2; absorbed_share: share of what arrived; absorbed: per "
      "one-sided area of the kind, MJ m-2 and mol m-2; _error: half-width of the confidence interval",
      {dates.size(), kinds.size()}};
  add_dates(table, part);
  const auto add = [&](const char* name, const char* unit, const char* meaning, const auto& value) {
    table.add({name, unit, meaning, table_outputs, by_kind}, value);
  };
  add("organ", "", "name of the kind of organs", [&](std::size_t k) { return kinds[k].name; });
  add("role", "", "leaf, stem, fruit, structure, lamp or soil",
      [&](std::size_t k) { return std::string(role_name(kinds[k].role)); });
  add("organs", "1", "number of organs of the kind",
      [&](std::size_t k) { return static_cast<std::uint32_t>(kinds[k].organs); });
  add("area_m2", "m2", "one-sided area", [&](std::size_t k) { return kinds[k].area_m2; });
  add("area_index", "1", "one-sided area per ground area", [&](std::size_t k) { return kinds[k].area_m2 / plot_m2; });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    const auto joules = [&, b](std::size_t row) -> const Estimate& {
      return part.sums[dates[row / kinds.size()]].kind_absorbed[row % kinds.size() * model.bands.size() + b];
    };
    const auto per_area = [&](std::size_t row) {
      const double area_m2 = kinds[row % kinds.size()].area_m2;
      return area_m2 > 0.0 ? plot_m2 / area_m2 : no_value;
    };
    add_sum(table, model.bands[b], "_absorbed_ground", "absorbed per ground area", joules);
    table.add({band + "_absorbed_share", "1", "share of what arrived"},
              [&](std::size_t row) { return share_of(joules(row), part.sums[dates[row / kinds.size()]].bands[b].incident); });
    table.add({band + "_absorbed_mj_m2", "MJ m-2", "energy absorbed by both faces per one-sided area"},
              [&](std::size_t row) { return joules(row).scaled(per_mega * per_area(row)); });
    if (!(umol_per_joule > 0.0)) continue;
    table.add({band + "_absorbed_mol_m2", "mol m-2", "photons absorbed by both faces per one-sided area"},
              [&](std::size_t row) { return joules(row).scaled(umol_per_joule * per_mega * per_area(row)); });
  }
  return table;
}

Table organ_steps_table(const DayStand& stand, const DayPart& part) {
  const RadiationModel& model = stand.model;
  const std::vector<Organ>& organs = model.canopy.organs;
  Table table{"What organs absorb at each step", "W m-2 of one-sided area", {part.lights.size(), organs.size()}};
  add_step_times(table, part.course);
  add_organ_names(table, organs, 1);
  table.add({"area_m2", "m2", "one-sided area", table_outputs, std::vector<std::size_t>{1}}, stand.kinds.organ_m2);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    table.add({model.bands[b].name + "_absorbed", "W m-2", "flux absorbed by both faces per one-sided area",
               in_csv | in_arrays | in_netcdf},
              [&, b](std::size_t row) {
                const StepLight& light = part.lights[row / organs.size()];
                return light.organ_absorbed[row % organs.size() * model.bands.size() + b];
              });
  }
  add_organ_roles(table, stand.kinds.organ_roles, 1);
  return table;
}

std::span<const DayTable> day_tables() {
  constexpr auto always = [](const RadiationModel&) { return true; };
  constexpr auto with_sensors = [](const RadiationModel& model) { return !model.sensors.empty(); };
  constexpr auto with_planes = [](const RadiationModel& model) { return !model.planes.empty(); };
  static constexpr DayTable all[] = {{"day.csv", steps_table, always},
                                     {"day_sums.csv", day_sums_table, always},
                                     {"season.csv", season_table, always},
                                     {"organs_day.csv", organs_day_table, always},
                                     {"plants_day.csv", plants_day_table, always},
                                     {"sensors_day.csv", sensors_day_table, with_sensors},
                                     {"sensor_means_day.csv", sensor_means_day_table, with_sensors},
                                     {"sensor_day_sums.csv", sensor_day_sums_table, with_sensors},
                                     {"planes_day.csv", planes_day_table, with_planes},
                                     {"plane_day_sums.csv", plane_day_sums_table, with_planes}};
  return all;
}

std::vector<DayTable> day_tables(const RadiationModel& model) {
  std::vector<DayTable> tables;
  for (const DayTable& table : day_tables()) {
    if (table.is_of(model)) tables.push_back(table);
  }
  return tables;
}

std::string day_text(const DayTable& table, const RunRecord& record, const DayStand& stand, const DayPart& day) {
  Table made = table.make(stand, day);
  note_if_stopped(made, day.course, day.lights.size());
  return csv_text(record, made);
}

std::string day_head(const DayTable& table, const RunRecord& record, const DayStand& stand, const DayPart& part,
                     const DayCourse& whole, std::size_t steps_done) {
  Table made = table.make(stand, part);
  note_if_stopped(made, whole, steps_done);
  return csv_head(record, made);
}

}  // namespace sunfleck
