#include "programs/cli/info.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text.h"
#include "base/units.h"
#include "devices/gpu/context.h"
#include "physics/light/sun_events.h"
#include "physics/transport/model/surfaces.h"
#include "programs/cli/info_mesh.h"
#include "programs/cli/terminal.h"
#include "simulate/memory_forecast.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

ordered_json device_json(const DeviceDescription& device) {
  return {{"name", device.name},
          {"kind", device.software ? "software Vulkan" : "GPU"},
          {"driver", device.driver},
          {"usable", device.unusable.empty()},
          {"lacks", device.unusable}};
}

std::string clock_time(const UtcTime& utc, int offset_minutes) {
  const double minutes = utc.hour * 60.0 + utc.minute + utc.second / 60.0 + offset_minutes;
  const int of_day = static_cast<int>(std::floor(minutes * 60.0 + 0.5)) % 86400;
  const int seconds = (of_day + 86400) % 86400;
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

// Returns the date on the place's own clock.
LocalDate local_date(const SunMoment& moment) {
  const UtcTime local = plus_seconds(moment.time, 60.0 * moment.offset_minutes);
  return {local.year, local.month, local.day, moment.offset_minutes};
}

ordered_json sun_json(const Scene& scene) {
  if (!scene.model.sun) return nullptr;
  ordered_json sun = {{"elevation_deg", in_degrees(scene.model.sun->elevation_rad)},
                      {"azimuth_deg", in_degrees(scene.model.sun->azimuth_rad)},
                      {"sunrise", nullptr},
                      {"transit", nullptr},
                      {"sunset", nullptr}};
  if (!scene.moment) return sun;
  const int offset = scene.moment->offset_minutes;
  const SunEvents events = sun_events(local_date(*scene.moment), scene.moment->place);
  if (events.sunrise) sun["sunrise"] = clock_time(*events.sunrise, offset);
  sun["transit"] = clock_time(events.transit, offset);
  if (events.sunset) sun["sunset"] = clock_time(*events.sunset, offset);
  return sun;
}

// Counts coincident triangles by the organ they belong to and the organ they coincide with.
ordered_json copies_json(const Canopy& canopy) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> triangles;
  for (const Copy& copy : canopy.copies) ++triangles[{canopy.organ_of[copy.element], canopy.organ_of[copy.original]}];
  const auto organ_json = [&](std::uint32_t number) {
    const Organ& organ = canopy.organs[number];
    return ordered_json{{"plant", organ.plant}, {"organ", organ.name}, {"rank", organ.rank}};
  };
  ordered_json copies = ordered_json::array();
  for (const auto& [organs, count] : triangles) {
    ordered_json entry = organ_json(organs.first);
    entry["triangles"] = count;
    entry["coincide_with"] = organ_json(organs.second);
    copies.push_back(std::move(entry));
  }
  return copies;
}

// Adds the memory that a run with these options needs, and what it is needed for.
void add_memory(ordered_json& info, Scene scene, const RunOptions& options) {
  check_grid(options, scene);
  const SolveSettings settings = solve_settings(options, scene, options.threads);
  RunOptions undrawn = options;
  undrawn.triangle_light = !options.exports.empty();
  const ElementErrors without_pictures = solve_settings(undrawn, scene, options.threads).element_errors;
  Simulation simulation(std::move(scene), options);
  ProgressLine line("forecasting the memory of a run");
  const auto memory = forecast_memory(simulation, settings, without_pictures, terminal_monitor(line));
  if (!memory) throw_failure("info", "interrupted", "start it again");
  info["memory_bytes"] = memory->bytes;
  info["memory_without_pictures_bytes"] = memory->bytes_without_pictures;
  info["memory_device"] = simulation.device().name;
  info["replicate_rays"] = static_cast<std::uint64_t>(memory->run.work.rays);
  info["replicate_packets"] = static_cast<std::uint64_t>(memory->run.work.packets);
  info["replicates_at_once"] = memory->run.at_once;
  info["replicate_bytes"] = static_cast<std::uint64_t>(memory->run.replicate_bytes);
}

// Returns the area of each role, m2, and the names of the organs that have it.
ordered_json roles_json(const RadiationModel& model) {
  const Surfaces surfaces(model);
  const auto areas_m2 = area_of_roles_m2(model);
  std::array<std::set<std::string>, role_names.size()> names;
  for (const Surface& surface : surfaces.of) {
    names[static_cast<std::size_t>(surface.role)].insert(model.canopy.organs[surface.organ].name);
  }
  ordered_json roles = ordered_json::object();
  for (std::size_t role = 0; role < areas_m2.size(); ++role) {
    if (!names[role].empty()) roles[std::string(role_names[role])] = {{"area_m2", areas_m2[role]}, {"organs", names[role]}};
  }
  return roles;
}

// Returns how many meshes share their triangles among copies, and how many triangles the tree holds for all elements, without
// those that reach into the plot from its neighbours.
ordered_json instances_json(const ElementCorners& corners) {
  std::size_t triangles = corners.own().size();
  for (const SharedMesh& mesh : corners.meshes()) triangles += mesh.corners.size();
  return {{"meshes", corners.meshes().size()}, {"copies", corners.copies().size()}, {"triangles", triangles}};
}

void print_instances(const ordered_json& info) {
  const ordered_json& instances = info["instances"];
  if (instances["copies"] == 0) {
    fmt::print("tree: each triangle has its own place (copies share triangles with instances = true, or where it pays)\n");
  } else {
    const auto meshes = instances["meshes"].get<std::size_t>();
    fmt::print("tree: {} triangles; {} copies share those of {} {}\n", instances["triangles"].get<std::size_t>(),
               instances["copies"].get<std::size_t>(), meshes, meshes == 1 ? "mesh" : "meshes");
  }
}

void add_scene(ordered_json& info, const Scene& scene) {
  double area = 0.0;
  ordered_json by_optics = ordered_json::object();
  std::vector<double> optics_area(scene.model.canopy.optics_names.size());
  for (std::size_t e = 0; e < scene.model.canopy.size(); ++e) {
    const double element_m2 = area_m2(scene.model.canopy.corners[e]);
    area += element_m2;
    optics_area[scene.model.canopy.optics_of[e]] += element_m2;
  }
  for (std::size_t o = 0; o < optics_area.size(); ++o) {
    const std::string& name = scene.model.canopy.optics_names[o];  // which plants and structures may share
    by_optics[name] = by_optics.value(name, 0.0) + optics_area[o];
  }
  info["title"] = scene.title;
  info["triangles"] = scene.model.canopy.size();
  info["organs"] = scene.model.canopy.organs.size();
  info["area_m2"] = area;
  info["area_by_optics_m2"] = by_optics;
  info["roles"] = roles_json(scene.model);
  info["coincident_triangles"] = scene.model.canopy.copies.size();
  info["coincident_organs"] = copies_json(scene.model.canopy);
  info["instances"] = instances_json(scene.model.canopy.corners);
  info["plot_area_m2"] = scene.model.plot.area_m2();
  info["sun"] = sun_json(scene);
}

void print_copies(const ordered_json& info) {
  constexpr std::size_t most_lines = 10;
  const ordered_json& organs = info["coincident_organs"];
  if (organs.empty()) return;
  const auto coincident = info["coincident_triangles"].get<std::size_t>();
  fmt::print("{} {} no light:\n", counted(coincident, "triangle"),
             coincident == 1 ? "coincides with an earlier one and receives" : "coincide with earlier ones and receive");
  const auto name = [](const ordered_json& organ) {
    return fmt::format("{} of plant {}", printable(organ["organ"].get<std::string>()), organ["plant"].get<std::uint32_t>());
  };
  for (std::size_t k = 0; k < std::min(organs.size(), most_lines); ++k) {
    fmt::print("  {} of {} with {}\n", organs[k]["triangles"].get<std::size_t>(), name(organs[k]),
               name(organs[k]["coincide_with"]));
  }
  if (organs.size() > most_lines)
    fmt::print("  and those of {} more organs (--json lists them all)\n", organs.size() - most_lines);
}

void print_roles(const ordered_json& info) {
  constexpr std::size_t most_names = 6;
  for (const auto& [role, entry] : info["roles"].items()) {
    const auto names = entry["organs"].get<std::vector<std::string>>();
    std::vector<std::string> first;
    for (std::size_t k = 0; k < std::min(names.size(), most_names); ++k) first.push_back(printable(names[k]));
    const std::string more = names.size() > most_names ? fmt::format(" and {} more", names.size() - most_names) : "";
    fmt::print("counted as {}: {:.5g} m2 ({}{})\n", role, entry["area_m2"].get<double>(), fmt::join(first, ", "), more);
  }
}

void print_lines(const ordered_json& info) {
  const bool any_gpu = std::any_of(info["devices"].begin(), info["devices"].end(),
                                   [](const ordered_json& device) { return device["kind"] == "GPU" && device["usable"]; });
  if (!any_gpu) fmt::print("no GPU: the CPU path is used\n");
  int index = 0;
  for (const ordered_json& device : info["devices"]) {
    fmt::print("device {}: {} ({}; {}){}\n", index++, device["name"].get<std::string>(), device["kind"].get<std::string>(),
               device["driver"].get<std::string>(),
               device["usable"].get<bool>() ? "" : ", cannot be used: " + device["lacks"].get<std::string>());
  }
  if (!info.contains("triangles")) return;
  fmt::print("{}\n{} in {}, {:.5g} m2 on a plot of {:.5g} m2\n", info["title"].get<std::string>(),
             counted(info["triangles"].get<std::size_t>(), "triangle"), counted(info["organs"].get<std::size_t>(), "organ"),
             info["area_m2"].get<double>(), info["plot_area_m2"].get<double>());
  for (const auto& [name, area] : info["area_by_optics_m2"].items()) fmt::print("  {}: {:.5g} m2\n", name, area.get<double>());
  print_roles(info);
  print_copies(info);
  print_instances(info);
  constexpr double mib = 1048576.0;
  fmt::print(
      "memory needed: {:.1f} MiB on {} ({:.1f} MiB without pictures), of which {:.1f} MiB for {} replicates in progress\n",
      info["memory_bytes"].get<double>() / mib, info["memory_device"].get<std::string>(),
      info["memory_without_pictures_bytes"].get<double>() / mib,
      info["replicates_at_once"].get<double>() * info["replicate_bytes"].get<double>() / mib,
      info["replicates_at_once"].get<std::size_t>());
  fmt::print("work of a replicate: {} of the beam, {} in the first round\n",
             counted(info["replicate_rays"].get<std::size_t>(), "ray"),
             counted(info["replicate_packets"].get<std::size_t>(), "packet"));
  if (info["sun"].is_null()) return;
  fmt::print("sun: elevation {:.4f} deg, azimuth {:.4f} deg\n", info["sun"]["elevation_deg"].get<double>(),
             info["sun"]["azimuth_deg"].get<double>());
  if (info["sun"]["transit"].is_null()) return;
  const auto time = [&](const char* key) {
    return info["sun"][key].is_null() ? std::string("none") : info["sun"][key].get<std::string>();
  };
  fmt::print("sunrise {}, transit {}, sunset {}\n", time("sunrise"), time("transit"), time("sunset"));
}

}  // namespace

int show_info(const InfoOptions& options) {
  if (!options.meshes.empty()) return show_meshes(options);
  start_at_terminal(options.run);
  ordered_json info;
  info["devices"] = ordered_json::array();
  for (const DeviceDescription& device : list_devices()) info["devices"].push_back(device_json(device));
  if (!options.run.scene.empty()) {
    Scene scene = load_scene_with_warnings(options.run);
    add_scene(info, scene);
    add_memory(info, std::move(scene), options.run);
  }
  if (options.run.json) {
    fmt::print("{}\n", info.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  } else {
    print_lines(info);
  }
  return 0;
}

}  // namespace sunfleck
