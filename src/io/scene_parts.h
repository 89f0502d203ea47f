#pragma once
// Reads and checks the parts of a scene file, each from its tables. Only the scene reader uses these functions; it sets
// `access.files`.

#include "canopy/maize.h"
#include "io/mesh_reader.h"
#include "io/scene_reader.h"
#include "io/toml_view.h"

#include <map>
#include <span>

namespace sunfleck {

// Returns the location of the file named by `table.file`, with symbolic links resolved: relative to the scene's folder, and
// inside it unless `access` allows more. Refuses anything but a regular file; `wanted` is the advice in the message. Adds the
// unresolved path to access.files, because a link may be redirected and a missing file may appear.
[[nodiscard]] std::filesystem::path find_scene_file(const TomlTable& table, const std::filesystem::path& scene_file,
                                                    const SceneAccess& access, std::string_view wanted);

// Returns whether a name may head columns or fill cells of the result tables.
[[nodiscard]] bool is_plain_name(std::string_view name);
inline constexpr std::string_view plain_name_rule = "names in tables may have up to 64 letters, digits, _ and -";

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

// Names and photon units are in `bands`, whose irradiances are still 0; `lights` defines the sources of light.
struct BandsInput {
  std::vector<Waveband> bands;
  std::vector<BandLight> lights;  // [waveband]
};
[[nodiscard]] BandsInput read_bands(const TomlTable& root, const std::optional<SunInput>& sun,
                                    const std::optional<SkyInput>& sky, const std::optional<WeatherInput>& weather,
                                    std::vector<std::string>& warnings);

// Returns the planes in ascending order of height.
[[nodiscard]] std::vector<PlaneReceiver> read_planes(const TomlTable& root, const Plot& plot);
[[nodiscard]] std::vector<Sensor> read_sensors(const TomlTable& root);

// The default of `patch` is 0.05 m, or more, with a warning, if the plot would have too many such cells.
[[nodiscard]] std::optional<Soil> read_soil(const TomlTable& root, const std::vector<Waveband>& bands, const Plot& plot,
                                            std::vector<std::string>& warnings);

struct OpticsInput {
  SurfaceOptics optics;
  std::string place;  // location of its table, for messages
};
using OpticsByName = std::map<std::string, OpticsInput>;
[[nodiscard]] OpticsByName read_optics(const TomlTable& root, const std::vector<Waveband>& bands);

// One [[geometry]] table, read but without its triangles.
struct GeometryPart {
  TomlTable table;
  std::optional<MaizeStand> maize;  // exactly one of `maize`, `mesh` and `file` is set
  const Mesh* mesh = nullptr;       // points into the SceneText
  std::filesystem::path file;       // location of the file, symbolic links resolved
  MeshImport import;
  std::vector<Placement> placements;

  [[nodiscard]] std::string_view source_key() const { return maize ? "generator" : mesh != nullptr ? "mesh" : "file"; }
};
// Reads the [[geometry]] tables. The source must outlive the parts.
[[nodiscard]] std::vector<GeometryPart> read_geometry(const TomlTable& root, const SceneText& source,
                                                      const SceneAccess& access);

// Loads the meshes. Refuses more triangles than fit into the memory of this machine, before allocating memory for their copies.
[[nodiscard]] std::vector<PlacedMesh> load_geometry(std::span<const GeometryPart> parts, SourceFiles& files);

// Refuses the table whose mesh uses undefined optics. Soil names need no definition if the scene has [soil].
void check_optics(std::span<const GeometryPart> parts, std::span<const PlacedMesh> meshes, const OpticsByName& defined,
                  const Scene& scene);

// Returns the optics of these names; undefined soil names take the reflectance and colour of [soil]. Refuses the whole text if
// any other name is undefined.
[[nodiscard]] std::vector<SurfaceOptics> optics_of_names(const TomlTable& root, std::span<const std::string> names,
                                                         const OpticsByName& defined, const std::optional<Soil>& soil);

// Returns warnings about valid but unlikely input: lengths in another unit, plants below ground, missing light.
[[nodiscard]] std::vector<std::string> scene_doubts(const Scene& scene);

// Returns warnings about the position of the geometry in the plot.
[[nodiscard]] std::vector<std::string> placement_warnings(std::span<const GeometryPart> parts,
                                                          std::span<const PlacedMesh> meshes, const Scene& scene);

}  // namespace sunfleck
