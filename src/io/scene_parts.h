#pragma once
// The parts of a scene file, each read and checked from its tables. Only the scene reader uses them; it gives `access` a list
// of files.

#include "canopy/maize.h"
#include "io/mesh_reader.h"
#include "io/scene_reader.h"
#include "io/toml_view.h"

#include <map>
#include <span>

namespace sunfleck {

// Where the file that `table.file` names lies, symbolic links resolved: relative to the scene's folder, and inside it unless
// access allows more. Refused if it is not a regular file; `wanted` is the cure where it is something else. The unresolved path
// goes to access.files: a link may come to lead elsewhere, and a missing file may appear.
[[nodiscard]] std::filesystem::path find_scene_file(const TomlTable& table, const std::filesystem::path& scene_file,
                                                    const SceneAccess& access, std::string_view wanted);

// Names that head columns or stand in cells of the result tables.
[[nodiscard]] bool is_plain_name(std::string_view name);
inline constexpr std::string_view plain_name_rule = "it stands in tables: letters, digits, _ and -, at most 64";

struct SunInput {
  SunPosition position;
  std::optional<SunMoment> moment;
  TomlTable table;
};
[[nodiscard]] std::optional<SunInput> read_sun(const TomlTable& root);

struct WeatherInput {
  Weather weather;
  TomlTable table;

  [[nodiscard]] bool may_be_diffuse() const;
};
[[nodiscard]] std::optional<WeatherInput> read_weather_table(const TomlTable& root, const std::filesystem::path& scene_file,
                                                             const SceneAccess& access, const std::optional<SunInput>& sun,
                                                             std::vector<std::string>& warnings);

struct SkyInput {
  SkyModel model;
  bool from_weather = false;  // perez without dni and dhi
};
[[nodiscard]] std::optional<SkyInput> read_sky(const TomlTable& root, const std::filesystem::path& scene_file,
                                               const SceneAccess& access, const std::optional<SunInput>& sun,
                                               const std::optional<WeatherInput>& weather);

// Names and photon units go to `bands`, whose irradiances stay 0; where light comes from is said by `lights`.
struct BandsInput {
  std::vector<Waveband> bands;
  std::vector<BandLight> lights;  // [waveband]
};
[[nodiscard]] BandsInput read_bands(const TomlTable& root, const std::optional<SunInput>& sun,
                                    const std::optional<SkyInput>& sky, const std::optional<WeatherInput>& weather,
                                    std::vector<std::string>& warnings);

// In ascending order of height.
[[nodiscard]] std::vector<PlaneReceiver> read_planes(const TomlTable& root, const Plot& plot);
[[nodiscard]] std::vector<Sensor> read_sensors(const TomlTable& root);

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
  std::optional<MaizeStand> maize;  // one of these three
  const Mesh* mesh = nullptr;       // of the SceneText
  std::filesystem::path file;       // where it lies, symbolic links resolved
  MeshImport import;
  std::vector<Placement> placements;

  [[nodiscard]] std::string_view source_key() const { return maize ? "generator" : mesh != nullptr ? "mesh" : "file"; }
};
// The source must outlive the parts.
[[nodiscard]] std::vector<GeometryPart> read_geometry(const TomlTable& root, const SceneText& source,
                                                      const SceneAccess& access);

// Refuses more triangles than this machine's memory holds, before it takes the memory for their copies.
[[nodiscard]] std::vector<PlacedMesh> load_geometry(std::span<const GeometryPart> parts, SourceFiles& files);

// Refuses the table whose mesh uses undefined optics. Names of soil need none of their own where there is [soil].
void check_optics(std::span<const GeometryPart> parts, std::span<const PlacedMesh> meshes, const OpticsByName& defined,
                  const Scene& scene);

// The optics of those names; names of soil that are not defined take the reflectance and colour of [soil]. Refuses the whole
// text where one is missing.
[[nodiscard]] std::vector<SurfaceOptics> optics_of_names(const TomlTable& root, std::span<const std::string> names,
                                                         const OpticsByName& defined, const std::optional<Soil>& soil);

// Warnings about what can be read but is seldom meant: lengths in another unit, plants below ground, light forgotten.
[[nodiscard]] std::vector<std::string> scene_doubts(const Scene& scene);

// Warnings about where the geometry stands in the plot.
[[nodiscard]] std::vector<std::string> placement_warnings(std::span<const GeometryPart> parts,
                                                          std::span<const PlacedMesh> meshes, const Scene& scene);

}  // namespace sunfleck
