#include "files/results/tables/day_summary.h"

#include "base/text.h"
#include "files/results/tables/flux_terms.h"
#include "files/results/tables/summary_parts.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_reported_dates = 7;

ordered_json date_json(const DaySummary& day, const std::string& name, const DateSums& date) {
  ordered_json bands = ordered_json::array();
  for (std::size_t b = 0; b < date.bands.size(); ++b) {
    const Waveband& waveband = day.model.bands[b];
    ordered_json band = {{"name", waveband.name}};
    ordered_json errors;
    for (const FluxTerm& term : flux_terms) {
      const Estimate sum = (date.bands[b].*term.flux).scaled(per_mega);
      band[fmt::format("{}_mj_m2", term.name)] = number_or_null(sum.value);
      errors[fmt::format("{}_mj_m2", term.name)] = number_or_null(sum.half_width);
    }
    if (waveband.umol_per_joule > 0.0) {
      const Estimate photons = date.bands[b].absorbed_vegetation.scaled(per_mega * waveband.umol_per_joule);
      band["absorbed_vegetation_mol_m2"] = number_or_null(photons.value);
      errors["absorbed_vegetation_mol_m2"] = number_or_null(photons.half_width);
    }
    band["error"] = errors;
    bands.push_back(std::move(band));
  }
  return {{"date", name}, {"steps", date.steps}, {"bands", bands}};
}

double leaf_area_index(const RadiationModel& model) {
  return area_of_roles_m2(model)[static_cast<std::size_t>(Role::leaf)] / model.plot.area_m2();
}

// Returns what arrived in a band and what became of it, MJ m-2; leaves out half-widths of 0.
std::string sums_line(const std::string& when, const std::string& band, const BandFluxes& joules) {
  std::string line = fmt::format("  {} {}, MJ m-2", when, band);
  char separator = ':';
  for (const FluxTerm& term : flux_terms) {
    const Estimate sum = (joules.*term.flux).scaled(per_mega);
    std::string words = term.name;
    std::replace(words.begin(), words.end(), '_', ' ');
    line += fmt::format("{} {} {:.4g}", std::exchange(separator, ','), words, sum.value);
    if (sum.half_width > 0.0) line += fmt::format(" ± {:.2g}", sum.half_width);
  }
  return line + '\n';
}

// Returns the sums over all dates, a line for each band.
std::string season_lines(const DaySummary& day) {
  const auto dates = std::count_if(day.sums.begin(), day.sums.end(), [](const DateSums& date) { return date.steps > 0; });
  if (dates == 0) return {};
  const std::string& last = day.course.dates[static_cast<std::size_t>(dates) - 1];
  const std::string when = fmt::format("{} to {}, {} dates,", day.course.dates.front(), last, dates);
  std::string text;
  for (std::size_t b = 0; b < day.model.bands.size(); ++b)
    text += sums_line(when, day.model.bands[b].name, sum_over_dates(day.sums, b));
  return text;
}

}  // namespace

std::string day_summary_json(const DaySummary& day) {
  const RunRecord& record = day.record;
  const DayTotals& totals = day.totals;
  const bool fixed = record.grid_m || record.passes;
  ordered_json dates = ordered_json::array();
  for (std::size_t d = 0; d < day.sums.size(); ++d) {
    if (day.sums[d].steps > 0) dates.push_back(date_json(day, day.course.dates[d], day.sums[d]));
  }
  const auto unlit = [](const DayStep& step) { return step.unlit(); };
  ordered_json settings = day.settings;
  settings["scene_file"] = record.scene_file;
  settings["max_seconds"] = value_or_null(record.max_seconds);
  settings["threads"] = record.threads;
  settings["ranks"] = record.ranks;
  const auto bound = [fixed](double asked) { return fixed ? ordered_json(nullptr) : ordered_json(asked); };
  ordered_json summary = {
      {"sunfleck", record.version},
      {"commit", record.commit},
      {"command", "day"},
      {"scene", record.title},
      {"scene_digest", record.scene_digest},
      {"complete", record.complete},
      {"seed", record.seed},
      {"settings", settings},
      {"device", {{"kind", record.device.kind}, {"name", record.device.name}, {"driver", record.device.driver}}},
      {"triangles", day.model.canopy.size()},
      {"organs", day.model.canopy.organs.size()},
      {"plants", numbered_plants(day.model.canopy)},
      {"axes", axes_name(day.model.plot.axes)},
      {"plot_area_m2", day.model.plot.area_m2()},
      {"area_by_role_m2", area_by_role_json(day.model)},
      {"leaf_area_index", leaf_area_index(day.model)},
      {"steps",
       {{"asked", day.course.steps.size()},
        {"done", day.steps_done},
        {"night", std::count_if(day.course.steps.begin(), day.course.steps.end(), unlit)},
        {"short_of_bound", totals.short_of_bound}}},
      {"dates", dates},
      {"lost_rays", totals.lost_rays},
      {"direct",
       {{"rays", totals.rays},
        {"relative_error", value_or_null(totals.direct_error)},
        {"bound", bound(record.accuracy.direct)}}},
      {"indirect",
       {{"packets", totals.packets},
        {"relative_error", value_or_null(totals.indirect_error)},
        {"bound", bound(record.accuracy.indirect)}}},
      {"seconds",
       {{"load", record.seconds.load},
        {"bvh", record.seconds.bvh},
        {"device", record.seconds.device},
        {"steps", totals.seconds},
        {"write", record.seconds.write},
        {"total", record.seconds.total}}}};
  if (!day.model.sensors.empty() && record.accuracy.of == ErrorTarget::sensors)
    summary["sensors"] = {{"relative_error", value_or_null(totals.sensor_error)}, {"bound", bound(record.accuracy.indirect)}};
  if (!record.not_written.empty()) summary["not_written"] = record.not_written;
  return summary.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string day_report(const DaySummary& day) {
  std::string text =
      fmt::format("{}\n  {}, {}, {} of them simulated\n", day.record.title, counted(day.model.canopy.size(), "triangle"),
                  counted(day.steps_done, "step"), day.totals.simulated);
  if (day.sums.size() > most_reported_dates) return text + season_lines(day);
  for (std::size_t d = 0; d < day.sums.size(); ++d) {
    const DateSums& date = day.sums[d];
    for (std::size_t b = 0; date.steps > 0 && b < date.bands.size(); ++b)
      text += sums_line(day.course.dates[d], day.model.bands[b].name, date.bands[b]);
  }
  return text;
}

}  // namespace sunfleck
