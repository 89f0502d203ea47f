#pragma once
// Reads where the copies of a mesh stand: `at`, `heading` and `plant`, or `positions`, of a [[geometry]].

#include "files/scene/scene_reader.h"
#include "files/scene/toml_view.h"
#include "physics/canopy/plants.h"

#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace sunfleck {

// Returns the placements in the scene's coordinates, one at the origin of the user's axes by default. `access.files` must be
// set.
[[nodiscard]] std::vector<Placement> read_placements(const TomlTable& geometry, const std::filesystem::path& scene_file,
                                                     const Plot& plot, const SceneAccess& access);

// The plants of the geometry so far.
struct UsedPlants {
  PlantNumbers numbers;
  std::set<std::uint32_t> counted;  // numbers that the scene does not give
};

// Refuses plant numbers that the scene gives a mesh with several plants, and those that plants without given numbers have
// already: parts of one plant must all give its number. The plants of this mesh are added to `plants`.
void check_plant_numbers(const TomlTable& geometry, const Mesh& mesh, const std::vector<Placement>& placements,
                         UsedPlants& plants);

}  // namespace sunfleck
