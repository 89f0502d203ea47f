#pragma once
// The digitised maize stand of tests/data.

#include "files/formats/mesh/mesh_reader.h"
#include "physics/canopy/canopy.h"

#include <filesystem>

namespace sunfleck::test {

// Returns 25 plants on 3 x 3 m of soil. Leaves, stems and soil are one organ each, 0 to 2, with optics of the same numbers.
inline Mesh stand_by_kind() {
  Mesh mesh = read_mesh(std::filesystem::path(SUNFLECK_SOURCE_DIR) / "tests/data/maize60x60_25plants.can.gz", {});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::string& organ = mesh.organs[mesh.organ_of[t]].name;
    mesh.optics_of[t] = mesh.organ_of[t] = role_from_name(organ) == Role::leaf ? 0U : organ == "stem" ? 1U : 2U;
  }
  mesh.organs = {{1, "leaf", 0}, {1, "stem", 0}, {0, "soil", 0}};
  mesh.optics_names = {"leaf", "stem", "soil"};
  return mesh;
}

}  // namespace sunfleck::test
