#include "programs/cli/report.h"

#include "base/text.h"
#include "base/units.h"
#include "files/results/tables/table.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

namespace sunfleck {
namespace {

std::string with_error(const Estimate& estimate) {
  return std::isnan(estimate.half_width) ? fmt::format("{:.4g}", estimate.value)
                                         : fmt::format("{:.4g} ± {:.2g}", estimate.value, estimate.half_width);
}

using RoleAreas = std::array<double, role_names.size()>;

bool has_structures(const RoleAreas& areas_m2) {
  return areas_m2[static_cast<std::size_t>(Role::structure)] + areas_m2[static_cast<std::size_t>(Role::lamp)] > 0.0;
}

// Returns e.g. "leaf 9.11 m2, stem 1.485 m2".
std::string areas_text(const RoleAreas& areas_m2) {
  std::vector<std::string> areas;
  for (std::size_t role = 0; role < areas_m2.size(); ++role) {
    if (areas_m2[role] > 0.0) areas.push_back(fmt::format("{} {:.4g} m2", role_names[role], areas_m2[role]));
  }
  return fmt::format("{}", fmt::join(areas, ", "));
}

}  // namespace

std::string balance_report(const RunRecord& record, const RadiationModel& model, const RadiationResult& result) {
  std::string text = fmt::format("{}\n", record.title);
  text += fmt::format("  {}, {}, leaf area index {:.3f}\n", counted(model.canopy.size(), "triangle"),
                      counted(model.canopy.organs.size(), "organ"), result.leaf_area_index);
  const RoleAreas areas_m2 = area_of_roles_m2(model);
  if (model.canopy.size() > 0) text += fmt::format("  one-sided areas: {}\n", areas_text(areas_m2));
  if (model.sun) {
    text += fmt::format("  sun: elevation {:.4f} deg, azimuth {:.4f} deg\n", model.sun->elevation_rad / degree,
                        model.sun->azimuth_rad / degree);
  }
  text += fmt::format("  device: {}{}\n", record.device.name,
                      record.device.kind == "vulkan" && record.device.software ? " (software Vulkan)" : "");
  for (const BandResult& band : result.bands) {
    const std::string incident =
        band.incident.half_width > 0.0 ? with_error(band.incident) : fmt::format("{:.4g}", band.incident.value);
    const std::string by_structures = has_structures(areas_m2) ? ", by structures " + with_error(band.absorbed_structure) : "";
    text += fmt::format(
        "  {}: incident {} W m-2, absorbed by vegetation {}{}, by soil {}, reflected {}, transmitted {}, "
        "unshot {:.2g}\n",
        band.name, incident, with_error(band.absorbed_vegetation), by_structures, with_error(band.absorbed_soil),
        with_error(band.reflected), with_error(band.transmitted), band.unshot);
  }
  if (model.has_beam()) {
    const Estimate sunlit = as_share(result.sunlit_leaf_fraction);
    text += "  ";
    if (!std::isnan(sunlit.value)) text += fmt::format("sunlit leaf fraction {}, ", with_error(sunlit));
    text += fmt::format("sunflecks on the ground {}\n", with_error(result.ground_sunfleck_ratio));
  }
  const auto errors = [](const PassError& of) {
    std::string line;
    if (of.relative_error) line += fmt::format(", relative error {:.2g}", *of.relative_error);
    if (of.bound) line += fmt::format(" (bound {:.2g})", *of.bound);
    return line + fmt::format(", {:.2f} s\n", of.seconds);
  };
  if (result.direct.rays > 0) {
    text += fmt::format("  direct: {} rays in {} replicates, spacing {:.3g} mm{}", result.direct.rays, result.direct.replicates,
                        result.direct.grid_m * 1e3, errors(result.direct));
  }
  if (result.indirect.packets + result.indirect.sky_rays > 0) {
    const std::string sky =
        result.indirect.sky_rays > 0 ? fmt::format("{} rays from the sky, ", result.indirect.sky_rays) : std::string();
    text += fmt::format("  indirect: {}{} packets in {} rounds{}", sky, result.indirect.packets, result.indirect.rounds,
                        errors(result.indirect));
  }
  if (result.of_sensors.bound) {
    text += fmt::format("  sensors: {} replicates of {} rays{}", result.of_sensors.replicates, result.of_sensors.rays,
                        errors(result.of_sensors));
  }
  for (const PlaneResult& plane : result.planes) {
    text += fmt::format("  plane at {:.3f} m:", plane.height_m);
    if (model.has_beam()) text += fmt::format(" sunflecks {},", with_error(plane.sunfleck_ratio));
    for (std::size_t b = 0; b < plane.total_down.size(); ++b) {
      text += fmt::format("{} {} down {} W m-2", b > 0 ? "," : "", result.bands[b].name, with_error(plane.total_down[b]));
    }
    text += '\n';
  }
  if (result.lost_rays > 0) text += fmt::format("  {} rays were lost: their flux counts as unshot\n", result.lost_rays);
  return text;
}

}  // namespace sunfleck
