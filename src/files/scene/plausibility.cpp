#include "files/scene/plausibility.h"

#include "base/file.h"
#include "base/text.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>

namespace sunfleck {
namespace {

constexpr double tallest_m = 150.0;           // taller than any plant
constexpr double densest = 30.0;              // one-sided area of all elements over that of the plot
constexpr double below_ground_m = 0.01;       // the foot of a mesh may lie this deep
constexpr double least_share_of_area = 0.01;  // share of the stand's area below ground

struct Stand {
  double area_m2 = 0.0, buried_m2 = 0.0;
  double top_m = -std::numeric_limits<double>::infinity();
};

// Returns the extent of everything but soil.
Stand stand_of(const Canopy& canopy, const Surfaces& surfaces) {
  Stand stand;
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    if (surfaces.at(e).soil()) continue;
    const Triangle& corners = canopy.corners[e];
    const double area = area_m2(corners);
    const double middle_m = (double{corners[0].y} + corners[1].y + corners[2].y) / 3.0 + canopy.origin_m.y;
    stand.area_m2 += area;
    if (middle_m < -below_ground_m) stand.buried_m2 += area;
    for (const glm::vec3& corner : corners) stand.top_m = std::max(stand.top_m, corner.y + canopy.origin_m.y);
  }
  return stand;
}

bool has_lamp(const RadiationModel& model, std::size_t band) {
  return std::any_of(model.optics.begin(), model.optics.end(),
                     [&](const SurfaceOptics& optics) { return optics.exitance_w_m2(band) > 0.0; });
}

bool is_dark(const BandLight& light) {
  return !light.share && light.direct_w_m2 == 0.0 && light.direct_normal_w_m2 == 0.0 && light.diffuse_w_m2 == 0.0;
}

void warn_of_missing_light(const Scene& scene, const std::string& file, std::vector<std::string>& warnings) {
  if (!scene.model.sun && !scene.light.sky) return;
  bool diffuse = false;
  for (std::size_t b = 0; b < scene.light.bands.size(); ++b) {
    const BandLight& light = scene.light.bands[b];
    diffuse = diffuse || light.share || light.diffuse_w_m2 > 0.0;
    if (!is_dark(light) || has_lamp(scene.model, b)) continue;
    warnings.push_back(fmt::format("{}: band {} has no light; add direct or diffuse, in W m-2, to its [[band]]", file,
                                   scene.model.bands[b].name));
  }
  if (scene.light.sky && !diffuse) {
    warnings.push_back(
        fmt::format("{}: sky sends no light, because no band has diffuse; add diffuse, in W m-2, to a [[band]]", file));
  }
}

std::string element_name(const Canopy& canopy, std::uint32_t element) {
  const Organ& organ = canopy.organs[canopy.organ_of[element]];
  return fmt::format("triangle {} of {} of plant {}", element, printable(organ.name), organ.plant);
}

void warn_of_copies(const Canopy& canopy, const std::string& file, std::vector<std::string>& warnings) {
  if (canopy.copies.empty()) return;
  const Copy& first = canopy.copies.front();
  warnings.push_back(
      fmt::format("{}: {} triangles coincide with earlier ones, e.g. {} with {}; the earlier one takes all light and "
                  "the copy none, so remove the copies (sunfleck info names them)",
                  file, canopy.copies.size(), element_name(canopy, first.element), element_name(canopy, first.original)));
}

// Warns of plants all of whose organs are recognised, none of them as a leaf.
void warn_of_leafless_plants(const Canopy& canopy, const Surfaces& surfaces, const std::string& file,
                             std::vector<std::string>& warnings) {
  struct Plant {
    bool has_leaves = false;
    Surface example;
  };
  std::map<std::uint32_t, Plant> plants;
  for (const Surface& surface : surfaces.of) {
    if (!is_vegetation(surface.role)) continue;
    Plant& plant = plants[canopy.organs[surface.organ].plant];
    plant.has_leaves = plant.has_leaves || surface.role == Role::leaf;
    plant.example = surface;
  }
  const auto leafless = [](const auto& plant) { return !plant.second.has_leaves; };
  const auto count = std::count_if(plants.begin(), plants.end(), leafless);
  if (count == 0) return;
  const auto& [number, plant] = *std::find_if(plants.begin(), plants.end(), leafless);
  warnings.push_back(fmt::format(
      "{}: {} of {} plants {} no leaf that would count in the leaf area index, e.g. plant {}, whose organ \"{}\" is a "
      "{}; if it is a leaf, add role = \"leaf\" to [optics.{}] or to the [[geometry]]; if its leaves are in another "
      "[[geometry]], give both the same plant, such as plant = 1",
      file, count, plants.size(), count == 1 ? "has" : "have", number, printable(canopy.organs[plant.example.organ].name),
      role_name(plant.example.role), printable(canopy.optics_names[plant.example.optics])));
}

// Warns of leaves, stems and fruits without the number of a plant beside plants that have numbers.
void warn_of_plantless_vegetation(const Canopy& canopy, const Surfaces& surfaces, const std::string& file,
                                  std::vector<std::string>& warnings) {
  const auto plant_of = [&](const Surface& surface) { return canopy.organs[surface.organ].plant; };
  const auto is_plantless = [&](const Surface& surface) { return is_vegetation(surface.role) && plant_of(surface) == 0; };
  const auto is_numbered = [&](const Surface& surface) { return is_vegetation(surface.role) && plant_of(surface) > 0; };
  const auto example = std::find_if(surfaces.of.begin(), surfaces.of.end(), is_plantless);
  if (example == surfaces.of.end() || std::none_of(surfaces.of.begin(), surfaces.of.end(), is_numbered)) return;
  const auto count = std::count_if(surfaces.number_of.begin(), surfaces.number_of.end(),
                                   [&](std::uint32_t number) { return is_plantless(surfaces.of[number]); });
  warnings.push_back(fmt::format(
      "{}: {} of leaves, stems and fruits, e.g. of the organ \"{}\", {} to no plant, because the number of the plant is 0, and "
      "{} in no row of plants.csv; number plants from 1",
      file, counted(static_cast<std::size_t>(count), "triangle"), printable(canopy.organs[example->organ].name),
      count == 1 ? "belongs" : "belong", count == 1 ? "is" : "are"));
}

}  // namespace

std::vector<std::string> plausibility_warnings(const Scene& scene, bool all_z_up) {
  const std::string file = printable(scene.file.string());
  std::vector<std::string> warnings;
  warn_of_missing_light(scene, file, warnings);
  warn_of_copies(scene.model.canopy, file, warnings);
  const Surfaces surfaces(scene.model);
  warn_of_leafless_plants(scene.model.canopy, surfaces, file, warnings);
  warn_of_plantless_vegetation(scene.model.canopy, surfaces, file, warnings);
  const Stand stand = stand_of(scene.model.canopy, surfaces);
  if (stand.top_m > tallest_m) {
    warnings.push_back(fmt::format(
        "{}: the highest element is {:.4g} m above the ground; for a mesh in centimetres add scale = 0.01, for one in "
        "millimetres scale = 0.001",
        file, stand.top_m));
  } else if (stand.area_m2 > densest * scene.model.plot.area_m2()) {
    warnings.push_back(fmt::format("{}: {:.4g} m2 of plants stand on {:.4g} m2; check plot.size, in metres, and scale", file,
                                   stand.area_m2, scene.model.plot.area_m2()));
  }
  if (scene.model.soil && stand.buried_m2 > least_share_of_area * stand.area_m2) {
    warnings.push_back(fmt::format(
        "{}: {:.0f} % of the plants' area lies below the ground, {} = 0, where soil hides it; raise them with at{}", file,
        100.0 * stand.buried_m2 / stand.area_m2, scene.model.plot.axes == Axes::south_up_west ? 'y' : 'z',
        all_z_up ? ", or set up = \"y\" for a mesh whose y points up" : ", or set up = \"z\" for a mesh whose z points up"));
  }
  return warnings;
}

}  // namespace sunfleck
