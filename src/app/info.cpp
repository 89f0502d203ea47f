#include "app/commands.h"

#include "app/scene_source.h"
#include "base/log.h"
#include "bvh/bvh.h"
#include "gpu/context.h"
#include "light/sun_events.h"
#include "transport/counters.h"
#include "transport/solve.h"
#include "transport/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

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

// What a run without exports needs at its height. Measured on a million and ten million triangles, direct alone and scattering
// in two bands: the CPU path takes 0.58 to 0.77 of it; software Vulkan, whose copy of the tree is in the same memory, 0.97
// to 1.04.
std::uint64_t memory_bytes(const RadiationModel& model, const CounterLayout& layout, const Bvh& bvh) {
  constexpr std::uint64_t program = std::uint64_t{128} << 20U;  // with a Vulkan driver
  constexpr std::uint64_t canopy = sizeof(Triangle) + sizeof(std::uint32_t) + sizeof(std::uint16_t);
  constexpr std::uint64_t building = 64 + sizeof(Reference);  // a reference, beside its place in the finished tree
  constexpr std::uint64_t tallies = 3;                        // the run's, its pilot's, and the result
  constexpr std::uint64_t numbering = 3 * sizeof(std::uint32_t);
  constexpr std::uint64_t stored = 100;  // an element packed for the folder's store, and again as the file's text
  const std::uint64_t elements = model.canopy.size();
  const std::uint64_t tree = bvh.nodes.size() * sizeof(BvhNode) + bvh.triangles.size() * sizeof(BvhTriangle);
  const std::uint64_t counters = std::uint64_t{layout.words()} * sizeof(std::uint32_t);
  std::uint64_t sums = tallies * (elements * sizeof(ElementResult) + layout.cells() * sizeof(std::uint64_t));
  if (scatters(model) || model.has_sky()) {
    const std::uint64_t places = (2 * elements + layout.cells()) * model.bands.size() * (model.has_sky() ? 2 : 1);
    sums += (tallies + 1) * places * sizeof(std::int64_t);
  }
  const std::uint64_t solving = elements * numbering + counters + sums;
  const std::uint64_t host = std::max({bvh.triangles.size() * building, solving, elements * stored});
  return program + elements * canopy + tree + host + tree + counters;  // the last two: the device's copy
}

std::string clock_time(const std::optional<UtcTime>& utc, int offset_minutes) {
  if (!utc) return "none";
  const double minutes = utc->hour * 60.0 + utc->minute + utc->second / 60.0 + offset_minutes;
  const int of_day = static_cast<int>(std::floor(minutes * 60.0 + 0.5)) % 86400;
  const int seconds = (of_day + 86400) % 86400;
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

// The date at the place's own clock.
LocalDate local_date(const SunMoment& moment) {
  using namespace std::chrono;
  const UtcTime& utc = moment.time;
  const sys_days utc_day =
      year_month_day(year(utc.year), month(static_cast<unsigned>(utc.month)), day(static_cast<unsigned>(utc.day)));
  const auto local = utc_day + hours(utc.hour) + minutes(utc.minute + moment.offset_minutes);
  const year_month_day date(floor<days>(local));
  return {static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day())), moment.offset_minutes};
}

ordered_json sun_json(const Scene& scene) {
  if (!scene.model.sun) return nullptr;
  constexpr double degree = std::numbers::pi / 180.0;
  ordered_json sun = {{"elevation_deg", scene.model.sun->elevation_rad / degree},
                      {"azimuth_deg", scene.model.sun->azimuth_rad / degree},
                      {"sunrise", nullptr},
                      {"transit", nullptr},
                      {"sunset", nullptr}};
  if (!scene.moment) return sun;
  const int offset = scene.moment->offset_minutes;
  const SunEvents events = sun_events(local_date(*scene.moment), scene.moment->place);
  if (events.sunrise) sun["sunrise"] = clock_time(events.sunrise, offset);
  sun["transit"] = clock_time(events.transit, offset);
  if (events.sunset) sun["sunset"] = clock_time(events.sunset, offset);
  return sun;
}

void add_scene(ordered_json& info, const InfoOptions& options) {
  const Scene scene = load_scene(options.scene, options.stand, {options.allow_outside});
  for (const std::string& warning : scene.warnings) warn(warning);
  const CounterLayout layout = make_counter_layout(scene.model);
  const Bvh bvh = build_bvh(scene.model.canopy, box_padding_m(scene.model));
  double area = 0.0;
  ordered_json by_optics = ordered_json::object();
  std::vector<double> optics_area(scene.model.canopy.optics_names.size());
  for (std::size_t e = 0; e < scene.model.canopy.size(); ++e) {
    const double element_m2 = area_m2(scene.model.canopy.corners[e]);
    area += element_m2;
    optics_area[scene.model.canopy.optics_of[e]] += element_m2;
  }
  for (std::size_t o = 0; o < optics_area.size(); ++o) by_optics[scene.model.canopy.optics_names[o]] = optics_area[o];
  info["title"] = scene.title;
  info["triangles"] = scene.model.canopy.size();
  info["organs"] = scene.model.canopy.organs.size();
  info["area_m2"] = area;
  info["area_by_optics_m2"] = by_optics;
  info["plot_area_m2"] = scene.model.plot.area_m2();
  info["memory_bytes"] = memory_bytes(scene.model, layout, bvh);
  info["sun"] = sun_json(scene);
}

void print_lines(const ordered_json& info) {
  if (info["devices"].empty()) fmt::print("no Vulkan device: the CPU path is used\n");
  int index = 0;
  for (const ordered_json& device : info["devices"]) {
    fmt::print("device {}: {} ({}; {}){}\n", index++, device["name"].get<std::string>(), device["kind"].get<std::string>(),
               device["driver"].get<std::string>(),
               device["usable"].get<bool>() ? "" : ", cannot be used: " + device["lacks"].get<std::string>());
  }
  if (!info.contains("triangles")) return;
  fmt::print("{}\n{} triangles in {} organs, {:.5g} m2 on a plot of {:.5g} m2\n", info["title"].get<std::string>(),
             info["triangles"].get<std::size_t>(), info["organs"].get<std::size_t>(), info["area_m2"].get<double>(),
             info["plot_area_m2"].get<double>());
  for (const auto& [name, area] : info["area_by_optics_m2"].items()) fmt::print("  {}: {:.5g} m2\n", name, area.get<double>());
  fmt::print("memory needed: {:.1f} MiB\n", static_cast<double>(info["memory_bytes"].get<std::uint64_t>()) / 1048576.0);
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
  start_log(options.json ? Verbosity::quiet : Verbosity::normal);
  ordered_json info;
  info["devices"] = ordered_json::array();
  for (const DeviceDescription& device : list_devices()) info["devices"].push_back(device_json(device));
  if (!options.scene.empty()) add_scene(info, options);
  if (options.json) {
    fmt::print("{}\n", info.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  } else {
    print_lines(info);
  }
  return 0;
}

}  // namespace sunfleck
