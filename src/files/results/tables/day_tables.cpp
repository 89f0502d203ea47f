#include "files/results/tables/day_tables.h"

#include "base/units.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"
#include "physics/transport/model/plant_areas.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

std::vector<double> organ_areas_m2(const Canopy& canopy) {
  std::vector<double> areas(canopy.organs.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) areas[canopy.organ_of[e]] += area_m2(canopy.corners[e]);
  return areas;
}

std::vector<std::string> stopped_note(const DayCourse& course, std::span<const StepLight> lights) {
  if (lights.size() == course.steps.size()) return {};
  return {fmt::format("incomplete: the first {} of {} steps", lights.size(), course.steps.size())};
}

std::vector<std::size_t> dates_with_steps(const std::vector<DateSums>& sums) {
  std::vector<std::size_t> dates;
  for (std::size_t d = 0; d < sums.size(); ++d) {
    if (sums[d].steps > 0) dates.push_back(d);
  }
  return dates;
}

// Returns the plants with their places and areas, which no beam changes.
PlantAreas plants_of(const RadiationModel& model) {
  return {model, Surfaces(model), BeamExposure(model, make_counter_layout(model), 1.0)};
}

void add_plants(Table& table, const PlantAreas& plants, std::size_t axis) {
  const std::vector<std::size_t> along{axis};
  const auto add = [&](const char* name, const char* unit, const char* meaning, const auto& value) {
    table.add({name, unit, meaning, in_csv | in_arrays, along}, value);
  };
  add("plant", "1", "number of the plant", [&](std::size_t p) { return plants.sites[p].plant; });
  add("x", "m", "position towards the south", [&](std::size_t p) { return plants.sites[p].position_m.x; });
  add("y", "m", "position upwards", [&](std::size_t p) { return plants.sites[p].position_m.y; });
  add("z", "m", "position towards the west", [&](std::size_t p) { return plants.sites[p].position_m.z; });
  add("height_m", "m", "height from its lowest to its highest point", [&](std::size_t p) { return plants.height_m[p]; });
  add("leaf_area_m2", "m2", "one-sided area of its leaves", [&](std::size_t p) { return plants.leaf_m2[p]; });
}

}  // namespace

Table steps_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights) {
  const std::vector<DayStep>& steps = course.steps;
  Table table{"The course of the day; a step has the light of its middle, a night step none",
              "time: start of the step; step_s: s; elevation, azimuth: of the middle, degrees; incident, absorbed, reflected: "
              "W m-2 of ground; sunlit_leaf_fraction: share; _error: half-width of the confidence interval",
              stopped_note(course, lights),
              {lights.size()},
              {}};
  table.add({"time", "", "start of the step, local time with its offset"},
            [&](std::size_t i) { return local_time_text(steps[i].start, course.offset_minutes); });
  table.add({"step_s", "s", "length of the step"}, [&](std::size_t i) { return steps[i].length_s; });
  table.add({"elevation_deg", "degree", "elevation of the sun at the middle of the step"},
            [&](std::size_t i) { return steps[i].sun.elevation_rad / degree; });
  table.add({"azimuth_deg", "degree", "azimuth of the sun at the middle of the step, clockwise from north"},
            [&](std::size_t i) { return steps[i].sun.azimuth_rad / degree; });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    table.add({band + "_incident", "W m-2", "incident flux per ground area"},
              [&](std::size_t i) { return lights[i].bands[b].incident; });
    table.add({band + "_absorbed_vegetation", "W m-2", "flux absorbed by vegetation per ground area"},
              [&](std::size_t i) { return lights[i].bands[b].absorbed_vegetation; });
    table.add({band + "_absorbed_structure", "W m-2", "flux absorbed by structures and lamps per ground area"},
              [&](std::size_t i) { return lights[i].bands[b].absorbed_structure; });
    table.add({band + "_absorbed_soil", "W m-2", "flux absorbed by soil per ground area"},
              [&](std::size_t i) { return lights[i].bands[b].absorbed_soil; });
    table.add({band + "_reflected", "W m-2", "flux that leaves upwards per ground area"},
              [&](std::size_t i) { return lights[i].bands[b].reflected; });
  }
  table.add({"sunlit_leaf_fraction", "1", "share of the leaf area in direct sun"},
            [&](std::size_t i) { return as_share(lights[i].sunlit_leaf_fraction); });
  add_classes(table, model, "of the leaves", model.plot.area_m2(), in_csv | in_arrays,
              [&](std::size_t i) { return &lights[i].leaf_classes; });
  return table;
}

Table day_sums_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights) {
  const std::vector<DateSums> sums = sum_dates(model, course, lights);
  const std::vector<std::size_t> dates = dates_with_steps(sums);
  Table table{
      "The light of each date: sums over its steps",
      "steps: their number; incident, absorbed, reflected: per ground area, MJ m-2 and mol of photons m-2; _error: half-width "
      "of the confidence interval",
      stopped_note(course, lights),
      {dates.size()},
      {}};
  table.add({"date", "", "local date"}, [&](std::size_t d) { return course.dates[dates[d]]; });
  table.add({"steps", "1", "number of its steps"},
            [&](std::size_t d) { return static_cast<std::uint32_t>(sums[dates[d]].steps); });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    const auto add = [&, b](const std::string& name, const std::string& fate, Estimate StepBand::*term) {
      const auto joules = [&, b, term](std::size_t d) -> const Estimate& { return sums[dates[d]].bands[b].*term; };
      table.add({band + name + "_mj_m2", "MJ m-2", "energy " + fate + " per ground area"},
                [&](std::size_t d) { return joules(d).scaled(per_mega); });
      if (!(umol_per_joule > 0.0)) return;
      table.add({band + name + "_mol_m2", "mol m-2", "photons " + fate + " per ground area"},
                [&](std::size_t d) { return joules(d).scaled(umol_per_joule * per_mega); });
    };
    add("_incident", "that arrived", &StepBand::incident);
    add("_absorbed_vegetation", "absorbed by vegetation", &StepBand::absorbed_vegetation);
    add("_absorbed_structure", "absorbed by structures and lamps", &StepBand::absorbed_structure);
    add("_absorbed_soil", "absorbed by soil", &StepBand::absorbed_soil);
    add("_reflected", "that left upwards", &StepBand::reflected);
  }
  return table;
}

Table organs_day_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights) {
  const std::vector<std::size_t> by_date{0}, by_organ{1};
  constexpr unsigned outputs = in_csv | in_arrays;
  const std::vector<Organ>& organs = model.canopy.organs;
  const std::vector<DateSums> sums = sum_dates(model, course, lights);
  const std::vector<std::size_t> dates = dates_with_steps(sums);
  Table table{"What organs absorbed over the steps of each date, soil elements included; the ground of [soil] has no row",
              "area_m2: m2, one-sided; absorbed: per one-sided area, MJ m-2 and mol of photons m-2; _error: half-width of the "
              "confidence interval",
              stopped_note(course, lights),
              {dates.size(), organs.size()},
              {}};
  table.add({"date", "", "local date", outputs, by_date}, [&](std::size_t d) { return course.dates[dates[d]]; });
  add_organ_names(table, organs, 1);
  table.add({"area_m2", "m2", "one-sided area", outputs, by_organ}, organ_areas_m2(model.canopy));
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    const auto joules = [&, b](std::size_t row) -> const Estimate& {
      return sums[dates[row / organs.size()]].organ_absorbed[row % organs.size() * model.bands.size() + b];
    };
    table.add({band + "_absorbed_mj_m2", "MJ m-2", "energy absorbed by both faces per one-sided area"},
              [&](std::size_t row) { return joules(row).scaled(per_mega); });
    if (!(umol_per_joule > 0.0)) continue;
    table.add({band + "_absorbed_mol_m2", "mol m-2", "photons absorbed by both faces per one-sided area"},
              [&](std::size_t row) { return joules(row).scaled(umol_per_joule * per_mega); });
  }
  add_organ_roles(table, model, 1);
  return table;
}

Table plants_day_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights) {
  const std::vector<DateSums> sums = sum_dates(model, course, lights);
  const std::vector<std::size_t> dates = dates_with_steps(sums);
  const PlantAreas plants = plants_of(model);
  Table table{
      "What plants, their leaves, stems and fruits together, absorbed over the steps of each date",
      "x, y, z: m (X south, Y up, Z west); height_m: m; leaf_area_m2: m2, one-sided; absorbed: of the whole plant, MJ and "
      "mol of photons; _error: half-width of the confidence interval",
      stopped_note(course, lights),
      {dates.size(), plants.size()},
      {}};
  table.add({"date", "", "local date", in_csv | in_arrays, std::vector<std::size_t>{0}},
            [&](std::size_t d) { return course.dates[dates[d]]; });
  add_plants(table, plants, 1);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    const auto absorbed = [&, b](std::size_t row, double per_joule) -> Estimate {
      const Estimate& joules = sums[dates[row / plants.size()]].plant_absorbed[row % plants.size() * model.bands.size() + b];
      return {joules.value * per_joule, joules.half_width * per_joule};
    };
    table.add({band + "_absorbed_mj", "MJ", "energy that all its organs absorbed"},
              [&](std::size_t row) { return absorbed(row, per_mega); });
    if (!(umol_per_joule > 0.0)) continue;
    table.add({band + "_absorbed_mol", "mol", "photons that all its organs absorbed"},
              [&](std::size_t row) { return absorbed(row, umol_per_joule * per_mega); });
  }
  return table;
}

std::string day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                    std::span<const StepLight> lights) {
  return csv_text(record, steps_table(model, course, lights));
}

std::string day_sums_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                         std::span<const StepLight> lights) {
  return csv_text(record, day_sums_table(model, course, lights));
}

std::string organs_day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                           std::span<const StepLight> lights) {
  return csv_text(record, organs_day_table(model, course, lights));
}

std::string plants_day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                           std::span<const StepLight> lights) {
  return csv_text(record, plants_day_table(model, course, lights));
}

}  // namespace sunfleck
