#include "io/day_tables.h"

#include "io/table_text.h"

#include <fmt/format.h>

#include <limits>
#include <numbers>

namespace sunfleck {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string stopped_line(const DayCourse& course, std::span<const StepLight> lights) {
  if (lights.size() == course.steps.size()) return "";
  return fmt::format("# incomplete: the first {} of {} steps\n", lights.size(), course.steps.size());
}

}  // namespace

std::vector<double> organ_areas_m2(const Canopy& canopy) {
  std::vector<double> areas(canopy.organs.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) areas[canopy.organ_of[e]] += area_m2(canopy.corners[e]);
  return areas;
}

std::string day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                    std::span<const StepLight> lights) {
  std::string text = table_head(record, "The course of the day; a step has the light of its middle, a night step none",
                                "time: start of the step; step_s: s; elevation, azimuth: of the middle, degrees; incident, "
                                "absorbed, reflected: W m-2 of ground; sunlit_leaf_fraction: share; _error: half-width of the "
                                "confidence interval");
  text += stopped_line(course, lights);
  text += "time,step_s,elevation_deg,azimuth_deg";
  for (const Waveband& band : model.bands) {
    text += fmt::format(
        ",{0}_incident,{0}_incident_error,{0}_absorbed_vegetation,{0}_absorbed_vegetation_error,{0}_absorbed_soil,"
        "{0}_absorbed_soil_error,{0}_reflected,{0}_reflected_error",
        band.name);
  }
  text += ",sunlit_leaf_fraction,sunlit_leaf_fraction_error\n";
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const DayStep& step = course.steps[i];
    std::string row = local_time_text(step.start, course.offset_minutes);
    append_number(row, step.length_s);
    append_number(row, step.sun.elevation_rad / degree);
    append_number(row, step.sun.azimuth_rad / degree);
    for (const StepBand& band : lights[i].bands) {
      append_estimate(row, band.incident);
      append_estimate(row, band.absorbed_vegetation);
      append_estimate(row, band.absorbed_soil);
      append_estimate(row, band.reflected);
    }
    append_estimate(row, as_share(lights[i].sunlit_leaf_fraction));
    text += row + '\n';
  }
  return text;
}

std::string organs_day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                           std::span<const StepLight> lights) {
  constexpr double per_mega = 1e-6;
  std::string text = table_head(
      record, "What organs absorbed over the steps of each date, soil elements included; the ground of [soil] has no row",
      "area_m2: m2, one-sided; absorbed: per one-sided area; _error: relative half-width of the confidence interval of "
      "absorbed");
  text += stopped_line(course, lights);
  text += "date,plant,organ,rank,area_m2";
  for (const Waveband& band : model.bands) {
    text += fmt::format(",{0}_absorbed_mj_m2,{0}_error", band.name);
    if (band.umol_per_joule > 0.0) text += fmt::format(",{}_absorbed_mol_m2", band.name);
  }
  text += '\n';
  const std::vector<DateSums> sums = sum_dates(model, course, lights);
  const std::vector<double> areas_m2 = organ_areas_m2(model.canopy);
  const std::size_t bands = model.bands.size();
  for (std::size_t d = 0; d < course.dates.size(); ++d) {
    const DateSums& date = sums[d];
    if (date.steps == 0) continue;
    for (std::size_t o = 0; o < model.canopy.organs.size(); ++o) {
      const Organ& organ = model.canopy.organs[o];
      std::string row = fmt::format("{},{},{},{}", course.dates[d], organ.plant, csv_field(organ.name), organ.rank);
      append_number(row, areas_m2[o]);
      for (std::size_t b = 0; b < bands; ++b) {
        const Estimate& absorbed_j_m2 = date.organ_absorbed[o * bands + b];
        append_number(row, absorbed_j_m2.value * per_mega);
        append_number(row, absorbed_j_m2.value > 0.0 ? absorbed_j_m2.half_width / absorbed_j_m2.value : none);
        const double umol_per_joule = model.bands[b].umol_per_joule;
        if (umol_per_joule > 0.0) append_number(row, absorbed_j_m2.value * umol_per_joule * per_mega);
      }
      text += row + '\n';
    }
  }
  return text;
}

}  // namespace sunfleck
