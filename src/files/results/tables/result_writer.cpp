#include "files/results/tables/result_writer.h"

#include "base/units.h"
#include "files/results/tables/flux_terms.h"
#include "files/results/tables/judged_figure.h"
#include "files/results/tables/summary_parts.h"
#include "files/results/tables/table.h"
#include "files/results/tables/work_settings.h"
#include "physics/canopy/axes.h"

#include <array>
#include <nlohmann/json.hpp>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

// Adds the band's fluxes, each multiplied by `factor`.
void add_fluxes(ordered_json& to, const BandFluxes& band, double factor) {
  for (const FluxTerm& term : flux_terms) to[term.name] = (band.*term.flux).value * factor;
}

// Returns the half-widths of the band's fluxes, each multiplied by `factor`.
ordered_json half_widths_json(const BandFluxes& band, double factor) {
  ordered_json half_widths;
  for (const FluxTerm& term : flux_terms) half_widths[term.name] = number_or_null((band.*term.flux).half_width * factor);
  return half_widths;
}

ordered_json band_json(const BandResult& band) {
  ordered_json json = {{"name", band.name}};
  add_fluxes(json, band, 1.0);
  json["unshot"] = band.unshot;
  json["residual"] = band.ledger.residual();
  json["quanta"] = {{"incident", band.ledger.incident},
                    {"absorbed_vegetation", band.ledger.absorbed_vegetation},
                    {"absorbed_structure", band.ledger.absorbed_structure},
                    {"absorbed_soil", band.ledger.absorbed_soil},
                    {"reflected", band.ledger.reflected},
                    {"transmitted", band.ledger.transmitted},
                    {"unshot", band.ledger.unshot}};
  json["error"] = half_widths_json(band, 1.0);
  return json;
}

// Returns the same fluxes in photons, umol m-2 s-1 of ground, for bands with umol_per_joule.
ordered_json photons_json(const BandResult& band, double umol_per_joule) {
  ordered_json json;
  add_fluxes(json, band, umol_per_joule);
  json["error"] = half_widths_json(band, umol_per_joule);
  return json;
}

ordered_json bands_json(const RadiationModel& model, const RadiationResult& result) {
  ordered_json bands = ordered_json::array();
  for (std::size_t b = 0; b < result.bands.size(); ++b) {
    bands.push_back(band_json(result.bands[b]));
    const Waveband& band = model.bands[b];
    if (band.to_nm > 0.0) bands.back()["range_nm"] = {band.from_nm, band.to_nm};
    if (!band.weighted_by.empty()) bands.back()["spectra_weighted_by"] = band.weighted_by;
    const double umol_per_joule = model.bands[b].umol_per_joule;
    if (umol_per_joule > 0.0) bands.back()["umol_m2_s"] = photons_json(result.bands[b], umol_per_joule);
  }
  return bands;
}

// Returns the sunlit and the shaded leaf area and what each absorbs by band, W m-2 of its own area.
ordered_json leaf_classes_json(const RadiationModel& model, const RadiationResult& result) {
  const ShadeClassResult& classes = result.leaf_classes;
  const auto of_bands = [&](const std::vector<Estimate>& figures) {
    ordered_json bands = ordered_json::object();
    for (std::size_t b = 0; b < figures.size(); ++b) bands[model.bands[b].name] = estimate_json(figures[b]);
    return bands;
  };
  const auto of_class = [&](const Estimate& leaf_m2, const std::vector<Estimate>& absorbed,
                            const std::vector<Estimate>& spread) {
    return ordered_json{
        {"leaf_area_m2", estimate_json(leaf_m2)}, {"absorbed", of_bands(absorbed)}, {"absorbed_sd", of_bands(spread)}};
  };
  return {{"sunlit", of_class(classes.sunlit_m2, classes.absorbed_sunlit, classes.sunlit_sd)},
          {"shaded", of_class(classes.shaded_m2, classes.absorbed_shaded, classes.shaded_sd)}};
}

ordered_json sun_json(const RadiationModel& model) {
  if (!model.sun) return nullptr;
  return {{"elevation_deg", in_degrees(model.sun->elevation_rad)}, {"azimuth_deg", in_degrees(model.sun->azimuth_rad)}};
}

ordered_json planes_json(const RadiationResult& result) {
  ordered_json planes = ordered_json::array();
  for (const PlaneResult& plane : result.planes) {
    ordered_json down = ordered_json::array();
    ordered_json error = ordered_json::array();
    for (const Estimate& total : plane.total_down) {
      down.push_back(total.value);
      error.push_back(number_or_null(total.half_width));
    }
    planes.push_back({{"height_m", plane.height_m},
                      {"sunfleck_ratio", number_or_null(plane.sunfleck_ratio.value)},
                      {"sunfleck_ratio_error", number_or_null(plane.sunfleck_ratio.half_width)},
                      {"down", down},
                      {"down_error", error}});
  }
  return planes;
}

// Returns the typical relative error of what a triangle of the vegetation absorbs, by band; null if it was not estimated.
ordered_json triangle_error_json(const RadiationModel& model, const RadiationResult& result) {
  if (result.triangle_relative_error.empty()) return nullptr;
  ordered_json errors = ordered_json::object();
  for (std::size_t b = 0; b < model.bands.size(); ++b) errors[model.bands[b].name] = result.triangle_relative_error[b];
  return errors;
}

ordered_json settings_json(const RunRecord& record) {
  ordered_json settings = {{"scene_file", record.scene_file}};
  add_work_settings(settings, record.accuracy, record.grid_m, record.passes, record.max_rays);
  settings["max_seconds"] = value_or_null(record.max_seconds);
  settings["memory_bytes"] = value_or_null(record.memory_bytes);
  settings["threads"] = record.threads;
  settings["ranks"] = record.ranks;
  return settings;
}

// Returns the work of a pass with its error and time.
ordered_json pass_json(ordered_json work, const PassError& error, const RadiationModel& model) {
  work["relative_error"] = value_or_null(error.relative_error);
  work["judged"] = error.judged ? ordered_json(figure_name(*error.judged, model)) : ordered_json(nullptr);
  work["bound"] = value_or_null(error.bound);
  work["seconds"] = error.seconds;
  return work;
}

const char* stop_name(StopReason stop) {
  constexpr std::array<const char*, 6> names = {"bound reached",    "work done",  "rays spent",
                                                "replicates spent", "time spent", "interrupted"};  // [StopReason]
  return names[static_cast<std::size_t>(stop)];
}

}  // namespace

const char* error_target_name(ErrorTarget target) {
  constexpr std::array<const char*, 4> names = {"canopy", "organ", "triangle", "sensors"};  // [ErrorTarget]
  return names[static_cast<std::size_t>(target)];
}

std::string summary_json(const RunRecord& record, const RadiationModel& model, const RadiationResult& result) {
  ordered_json summary = {
      {"sunfleck", record.version},
      {"commit", record.commit},
      {"scene", record.title},
      {"scene_digest", record.scene_digest},
      {"complete", record.complete},
      {"stopped", stop_name(record.pictures_interrupted ? StopReason::interrupted : result.stop)},
      {"seed", record.seed},
      {"settings", settings_json(record)},
      {"device", {{"kind", record.device.kind}, {"name", record.device.name}, {"driver", record.device.driver}}},
      {"triangles", model.canopy.size()},
      {"instances", {{"meshes", model.canopy.corners.meshes().size()}, {"copies", model.canopy.corners.copies().size()}}},
      {"organs", model.canopy.organs.size()},
      {"plants", numbered_plants(model.canopy)},
      {"axes", axes_name(model.plot.axes)},
      {"plot_area_m2", model.plot.area_m2()},
      {"area_by_role_m2", area_by_role_json(model)},
      {"leaf_area_index", result.leaf_area_index},
      {"sun", sun_json(model)},
      {"bands", bands_json(model, result)},
      {"sunlit_leaf_fraction", number_or_null(as_share(result.sunlit_leaf_fraction).value)},
      {"sunlit_leaf_fraction_error", number_or_null(result.sunlit_leaf_fraction.half_width)},
      {"leaf_classes", leaf_classes_json(model, result)},
      {"ground_sunfleck_ratio", number_or_null(result.ground_sunfleck_ratio.value)},
      {"ground_sunfleck_ratio_error", number_or_null(result.ground_sunfleck_ratio.half_width)},
      {"triangle_relative_error", triangle_error_json(model, result)},
      {"planes", planes_json(result)},
      {"lost_rays", result.lost_rays},
      {"direct",
       pass_json({{"rays", result.direct.rays}, {"replicates", result.direct.replicates}, {"grid_m", result.direct.grid_m}},
                 result.direct, model)},
      {"indirect", pass_json({{"sky_rays", result.indirect.sky_rays},
                              {"packets", result.indirect.packets},
                              {"rounds", result.indirect.rounds},
                              {"first_round_packets", static_cast<std::uint64_t>(result.work.packets)}},
                             result.indirect, model)},
      {"seconds",
       {{"load", record.seconds.load},
        {"bvh", record.seconds.bvh},
        {"device", record.seconds.device},
        {"direct", record.seconds.direct},
        {"indirect", record.seconds.indirect},
        {"write", record.seconds.write},
        {"total", record.seconds.total}}}};
  if (!result.sensors.empty()) {
    summary["sensors"] =
        pass_json({{"rays", result.of_sensors.rays}, {"replicates", result.of_sensors.replicates}}, result.of_sensors, model);
  }
  if (!record.not_written.empty()) summary["not_written"] = record.not_written;
  return summary.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace sunfleck
