#pragma once
// Warns about geometry outside the plot.

#include "files/scene/scene_geometry.h"
#include "files/scene/scene_reader.h"
#include "physics/canopy/mesh.h"

#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// Returns warnings about the position of the geometry in the plot.
[[nodiscard]] std::vector<std::string> placement_warnings(std::span<const GeometryPart> parts,
                                                          std::span<const PlacedMesh> meshes, const Scene& scene);

}  // namespace sunfleck
