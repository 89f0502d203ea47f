#pragma once
// The parts of a scene file, each read and checked from its tables. Only the scene reader uses them.

#include "canopy/maize.h"
#include "io/mesh_reader.h"
#include "io/scene_reader.h"
#include "io/toml_view.h"

#include <map>
#include <span>

namespace sunfleck {

// Refuses a key whose feature this version lacks; nothing if it is absent.
void refuse_unsupported(const TomlTable& table, std::string_view key, std::string_view feature);

struct SunInput {
  SunPosition position;
  std::optional<SunMoment> moment;
  TomlTable table;
};
[[nodiscard]] std::optional<SunInput> read_sun(const TomlTable& root);

// Beam irradiances are those on a horizontal plane, 0 with the sun at or below the horizon.
[[nodiscard]] std::vector<Waveband> read_bands(const TomlTable& root, const std::optional<SunInput>& sun);

// Where `patch` is absent it is 0.05 m, or coarser (a warning says so) if the plot has too many such cells.
[[nodiscard]] std::optional<Soil> read_soil(const TomlTable& root, const std::vector<Waveband>& bands, const Plot& plot,
                                            std::vector<std::string>& warnings);

struct OpticsInput {
  SurfaceOptics optics;
  std::string place;  // of its table, for messages
};
using OpticsByName = std::map<std::string, OpticsInput>;
[[nodiscard]] OpticsByName read_optics(const TomlTable& root, const std::vector<Waveband>& bands);

// One [[geometry]] table, read but not yet loaded.
struct GeometryPart {
  TomlTable table;
  std::optional<MaizeStand> maize;  // else `file`
  std::filesystem::path file;       // where it lies, symbolic links resolved
  MeshImport import;
  std::vector<Placement> placements;

  [[nodiscard]] std::string_view source_key() const { return maize ? "generator" : "file"; }
};
[[nodiscard]] std::vector<GeometryPart> read_geometry(const TomlTable& root, const std::filesystem::path& scene_file,
                                                      const SceneAccess& access);

[[nodiscard]] PlacedMesh load_geometry(const GeometryPart& part);

// The optics of each name, or Error (input) naming the table whose mesh uses an undefined one. Names of soil that are not
// defined take the reflectance and colour of [soil].
[[nodiscard]] std::vector<SurfaceOptics> choose_optics(std::span<const GeometryPart> parts, std::span<const PlacedMesh> meshes,
                                                       const OpticsByName& defined, const Scene& scene);

// Warnings about where the geometry stands in the plot.
[[nodiscard]] std::vector<std::string> placement_warnings(std::span<const GeometryPart> parts,
                                                          std::span<const PlacedMesh> meshes, const Scene& scene);

}  // namespace sunfleck
