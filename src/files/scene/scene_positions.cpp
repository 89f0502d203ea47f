#include "files/scene/scene_positions.h"

#include "files/formats/measured/plant_positions.h"
#include "files/scene/scene_files.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>

namespace sunfleck {

namespace {

constexpr std::int64_t largest_plant = 1'000'000'000;

std::vector<Placement> placements_of_file(const TomlTable& geometry, const std::filesystem::path& scene_file, const Plot& plot,
                                          const SceneAccess& access) {
  for (const char* key : {"at", "heading", "plant"}) {
    if (geometry.has(key)) {
      geometry.refuse(key, "positions is also given", fmt::format("give {} in that file, or remove positions", key));
    }
  }
  if (!geometry.is_text("positions")) {
    geometry.refuse("positions", "it must be the name of a file, in quotes",
                    "write a list of positions as at = [[0.9, 0.0, 1.2]]");
  }
  const std::filesystem::path file = find_scene_file(geometry, scene_file, access, "name a .csv file", "positions");
  const HeightColumn height = plot.axes == Axes::south_up_west ? HeightColumn::y : HeightColumn::z;
  std::vector<Placement> placements;
  for (const PlantPosition& position : read_plant_positions(file, height, access.files)) {
    placements.push_back({.position_m = scene_position_m(plot, {position.x_m, position.y_m, position.z_m}),
                          .heading_rad = glm::radians(position.heading_deg),
                          .scale = position.scale,
                          .plant = position.plant});
  }
  return placements;
}

[[noreturn]] void refuse_counted(const TomlTable& geometry, const char* key, std::uint32_t plant, const UsedPlants& plants) {
  geometry.refuse(key, fmt::format("plant {} is there already, from an earlier [[geometry]]", plant),
                  fmt::format("use numbers above {}, or give that one numbers, too, if both are parts of one plant",
                              *plants.counted.rbegin()));
}

}  // namespace

std::vector<Placement> read_placements(const TomlTable& geometry, const std::filesystem::path& scene_file, const Plot& plot,
                                       const SceneAccess& access) {
  if (geometry.has("positions")) return placements_of_file(geometry, scene_file, plot, access);
  const std::vector<glm::dvec3> positions_m =
      geometry.triples("at", anywhere).value_or(std::vector<glm::dvec3>{{0.0, 0.0, 0.0}});
  const NumberRange turn{.lo = -360.0, .hi = 360.0, .cure = "give degrees clockwise seen from above"};
  const std::vector<double> headings_deg =
      geometry.number_or_list("heading", positions_m.size(), turn).value_or(std::vector<double>(positions_m.size(), 0.0));
  std::vector<Placement> placements;
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    placements.push_back({.position_m = scene_position_m(plot, positions_m[i]), .heading_rad = glm::radians(headings_deg[i])});
  }
  auto plant = geometry.integer("plant", 1, largest_plant);
  for (std::size_t i = 0; plant && i < placements.size(); ++i) placements[i].plant = static_cast<std::uint32_t>((*plant)++);
  return placements;
}

void check_plant_numbers(const TomlTable& geometry, const Mesh& mesh, const std::vector<Placement>& placements,
                         UsedPlants& plants) {
  std::set<std::uint32_t> own;
  for (const Organ& organ : mesh.organs) {
    if (organ.plant > 0) own.insert(organ.plant);
  }
  if (own.empty()) return;
  const char* const key = geometry.has("positions") ? "positions" : "plant";
  for (std::size_t copy = 0; copy < placements.size(); ++copy) {
    const std::optional<std::uint32_t>& given = placements[copy].plant;
    if (given && own.size() > 1) {
      geometry.refuse(key, fmt::format("its plants have numbers, but the mesh consists of {} plants", own.size()),
                      fmt::format("remove {}; the plants are then numbered in their order",
                                  geometry.has("positions") ? "the column plant" : "it"));
    }
    if (given && plants.counted.contains(*given)) refuse_counted(geometry, key, *given, plants);
    plants.numbers.begin_copy(mesh, copy, placements[copy]);
    const bool keeps = mesh.keeps_plants && copy == 0;
    for (const std::uint32_t plant : own) {
      const std::uint32_t number = plants.numbers.of(plant);
      if (keeps && plants.counted.contains(number)) refuse_counted(geometry, "mesh", number, plants);
      if (!given && !keeps) plants.counted.insert(number);
    }
  }
}

}  // namespace sunfleck
