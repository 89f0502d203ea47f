#pragma once
// Reads [[geometry]]: the sources of triangles and their optics.

#include "base/source_files.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/scene/scene_patterns.h"
#include "files/scene/scene_reader.h"
#include "files/scene/scene_surface.h"
#include "files/scene/toml_view.h"
#include "physics/canopy/maize.h"
#include "physics/canopy/mesh.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// One [[geometry]] table, read but without its triangles.
struct GeometryPart {
  TomlTable table;
  std::optional<MaizeStand> maize;  // exactly one of `maize`, `mesh` and `file` is set
  const Mesh* mesh = nullptr;       // points into the SceneText
  std::filesystem::path file;       // location of the file, symbolic links resolved
  MeshImport import;
  std::vector<OpticsRule> optics = {};  // of the key `optics`
  std::vector<Placement> placements;
  std::optional<Role> role = std::nullopt;
  std::optional<bool> instances = std::nullopt;

  [[nodiscard]] std::string_view source_key() const { return maize ? "generator" : mesh != nullptr ? "mesh" : "file"; }
};

// Reads the [[geometry]] tables, whose positions are in the axes of the plot. The source must outlive the parts.
[[nodiscard]] std::vector<GeometryPart> read_geometry(const TomlTable& root, const SceneText& source, const Plot& plot,
                                                      const SceneAccess& access);

// Loads the meshes. Refuses more triangles than fit into the memory of this machine, before allocating memory for their copies.
// Adds warnings about keys without effect.
[[nodiscard]] std::vector<PlacedMesh> load_geometry(std::span<const GeometryPart> parts, SourceFiles& files,
                                                    std::vector<std::string>& warnings);

// Gives surfaces of a [[geometry]] whose role is soil or structure, without `optics` of its own, the name "soil" or "structure"
// where the scene does not define the optics of their materials. Without [optics.structure] that becomes plain_structure, with
// a warning.
void name_plain_optics(std::span<const GeometryPart> parts, std::span<PlacedMesh> meshes, const OpticsByName& defined,
                       std::vector<std::string>& warnings);

// Refuses the table whose mesh uses undefined optics. Soil names need no definition if the scene has [soil].
void check_optics(std::span<const GeometryPart> parts, std::span<const PlacedMesh> meshes, const OpticsByName& defined,
                  const Scene& scene);

// The optics of structures for which the scene gives none; optics_of_names knows them. Painted or galvanised surfaces are about
// so bright.
inline constexpr const char* plain_structure = "plain structure";
inline constexpr double plain_structure_reflectance = 0.4;

// Returns the optics of these names; undefined soil names take the reflectance and colour of [soil], and plain_structure its
// own. Refuses the whole text if any other name is undefined.
[[nodiscard]] std::vector<SurfaceOptics> optics_of_names(const TomlTable& root, std::span<const std::string> names,
                                                         const OpticsByName& defined, const RadiationModel& model);

}  // namespace sunfleck
