#include "files/scene/scene_reader.h"

#include "base/digest.h"
#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/scene/light_plausibility.h"
#include "files/scene/moment_light.h"
#include "files/scene/plausibility.h"
#include "files/scene/receiver_plausibility.h"
#include "files/scene/scene_bands.h"
#include "files/scene/scene_geometry.h"
#include "files/scene/scene_placement.h"
#include "files/scene/scene_receivers.h"
#include "files/scene/scene_sky.h"
#include "files/scene/scene_sun.h"
#include "files/scene/scene_surface.h"
#include "files/scene/scene_weather.h"
#include "files/scene/toml_view.h"
#include "physics/canopy/axes.h"
#include "physics/transport/model/surface_roles.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <set>
#include <span>
#include <string_view>
#include <utility>

namespace sunfleck {

namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;  // enough for a million positions in `at`
constexpr double default_fov_deg = 40.0;

std::string read_title(const TomlTable& root, const std::filesystem::path& file) {
  return root.text("title").value_or(printable(file.stem().string()));
}

Axes axes_of(const TomlTable& root) {
  return static_cast<Axes>(root.word("axes", axes_names()).value_or(0));
}

Plot read_plot(const TomlTable& root) {
  root.require("plot", "[plot] with size = [1.8, 2.4]");
  const TomlTable table = *root.table("plot");
  table.allow({"size", "periodic"});
  Plot plot;
  plot.axes = axes_of(root);
  table.require("size", plot.axes == Axes::south_up_west ? "size = [1.8, 2.4], metres along X and Z"
                                                         : "size = [2.4, 1.8], metres to the east and to the north");
  const auto size_m = *table.numbers("size", 2, {.lo = 1e-6, .hi = 1e6, .cure = "give metres"});
  const glm::dvec2 along_xz_m = along_level_axes(plot.axes, {size_m[0], size_m[1]});
  plot.size_x_m = along_xz_m.x;
  plot.size_z_m = along_xz_m.y;
  plot.periodic = table.boolean("periodic").value_or(plot.periodic);
  return plot;
}

Accuracy read_accuracy(const TomlTable& root) {
  Accuracy accuracy;
  const auto table = root.table("accuracy");
  if (!table) return accuracy;
  table->allow({"direct", "indirect", "confidence", "of"});
  const NumberRange bound{
      .lo = 0.0, .hi = 1.0, .lo_open = true, .hi_open = true, .cure = "give a relative error such as 0.001 for 0.1 percent"};
  accuracy.direct = table->number("direct", bound).value_or(accuracy.direct);
  accuracy.indirect = table->number("indirect", bound).value_or(accuracy.indirect);
  const NumberRange confidence{.lo = 0.5, .hi = 0.9999, .cure = "give 0.95 for 95 percent"};
  accuracy.confidence = table->number("confidence", confidence).value_or(accuracy.confidence);
  const bool has_sensors = !root.tables("sensor").empty();
  if (const auto of = table->word("of", {"canopy", "organ", "triangle", "sensors"}))
    accuracy.of = static_cast<ErrorTarget>(*of);
  if (accuracy.of == ErrorTarget::sensors && !has_sensors) {
    table->refuse("of", "the scene has no [[sensor]] that the bounds could hold for",
                  "add one, or use canopy, organ or triangle");
  }
  return accuracy;
}

std::optional<CameraPose> read_camera(const TomlTable& root, const Plot& plot) {
  const auto table = root.table("camera");
  if (!table) return std::nullopt;
  table->allow({"position", "look_at", "fov"});
  table->require("position", "position = [3.0, 2.5, 3.0], or remove [camera] for a view that fits");
  table->require("look_at", "look_at = [0.9, 1.0, 1.2]");
  CameraPose pose;
  pose.position_m = scene_position_m(plot, *table->triple("position", anywhere));
  pose.look_at_m = scene_position_m(plot, *table->triple("look_at", anywhere));
  if (pose.position_m == pose.look_at_m) {
    table->refuse("look_at", "it equals the position of the camera, so there is no viewing direction", "give another point");
  }
  const NumberRange fov{.lo = 1.0, .hi = 179.0, .cure = "give degrees from the lower to the upper edge"};
  pose.fov_rad = glm::radians(table->number("fov", fov).value_or(default_fov_deg));
  return pose;
}

int read_layers(const TomlTable& root, int fallback) {
  const auto table = root.table("output");
  if (!table) return fallback;
  table->allow({"layers"});
  return static_cast<int>(table->integer("layers", 1, 10000).value_or(fallback));
}

void warn_of_night(const SunInput& sun, std::vector<std::string>& warnings) {
  if (sun.position.elevation_rad > 0.0) return;
  warnings.push_back(fmt::format("{}: the sun is not above the horizon (elevation {:.4g} degrees), so there is no direct light",
                                 sun.table.place(), glm::degrees(sun.position.elevation_rad)));
}

void warn_of_unused(const OpticsByName& optics, const Scene& scene, std::vector<std::string>& warnings) {
  const std::set<std::string> used(scene.model.canopy.optics_names.begin(), scene.model.canopy.optics_names.end());
  for (const auto& [name, input] : optics) {
    if (!used.contains(name)) warnings.push_back(fmt::format("{} is not used by any geometry", input.place));
  }
}

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void add_mesh(Digest& digest, const Mesh& mesh) {
  digest.add(bytes_of(mesh.vertices));
  digest.add(bytes_of(mesh.triangles));
  digest.add(bytes_of(mesh.optics_of));
  digest.add(bytes_of(mesh.organ_of));
  digest.add(bytes_of(mesh.labels));
  for (const std::string& name : mesh.optics_names) digest.add(name + "\n");
  for (const Organ& organ : mesh.organs) digest.add(fmt::format("{} {} {}\n", organ.plant, organ.name, organ.rank));
}

// Returns whether every mesh is read with up = "z".
bool all_z_up(std::span<const GeometryPart> parts) {
  return !parts.empty() && std::all_of(parts.begin(), parts.end(),
                                       [](const GeometryPart& part) { return part.maize || part.import.up == FileAxis::z; });
}

// Returns the digest of a scene; `files` are those read for the text.
std::string digest_of(std::string_view text, std::span<const SourceFile> files, std::span<const GeometryPart> parts) {
  Digest digest;
  digest.add(text);
  for (const SourceFile& file : files) {
    if (!file.digest.empty()) digest.add(file.digest + "\n");
  }
  for (const GeometryPart& part : parts) {
    if (part.mesh != nullptr) add_mesh(digest, *part.mesh);
  }
  return digest.text();
}

void append(std::vector<std::string>& warnings, const std::vector<std::string>& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

// Reads [sun], [sky], [weather] and [[band]]; returns what numbers in the unit of each band are divided by to give W m-2.
std::vector<double> read_light(const TomlTable& root, const SceneAccess& access, const SpectralLight& spectrum, Scene& scene) {
  const std::optional<SunInput> sun = read_sun(root);
  if (sun) {
    scene.model.sun = sun->position;
    scene.moment = sun->moment;
    if (access.purpose == ScenePurpose::moment) warn_of_night(*sun, scene.warnings);
  }
  std::optional<WeatherInput> weather = read_weather_table(root, scene.file, access, sun, scene.warnings);
  const std::optional<SkyInput> sky = read_sky(root, scene.file, access, sun, weather);
  BandsInput bands = read_bands(root, sun, sky, weather, spectrum.pointer(), scene.warnings);
  scene.model.bands = std::move(bands.bands);
  scene.light.bands = std::move(bands.lights);
  if (weather) {
    scene.light.weather_place = weather->table.place();
    scene.light.weather = std::move(weather->weather);
  }
  if (sky) {
    scene.light.sky = sky->model;
    scene.light.sky_from_weather = sky->from_weather;
    scene.model.sky = sky->model;
  }
  if (access.purpose == ScenePurpose::moment) {
    MomentLight now = light_of(scene);
    scene.model.bands = std::move(now.bands);
    scene.model.sky = std::move(now.sky);
  }
  append(scene.warnings, light_warnings(root, scene));
  return std::move(bands.per_w_m2);
}

// Returns an access that always has a list of files: the caller's, or `own`.
SceneAccess noting_access(SceneAccess access, SourceFiles& own) {
  if (access.files == nullptr) access.files = &own;
  return access;
}

TomlTable parse_scene(const SceneText& source) {
  TomlTable root = TomlTable::parse(source.file.string(), source.text);
  root.allow({"title", "axes", "plot", "sun", "sky", "band", "bands", "light_spectrum", "weather", "soil", "optics", "geometry",
              "accuracy", "camera", "output", "plane", "sensor"});
  return root;
}

// Reads everything but the geometry, and returns the optics, from which the canopy takes its own.
OpticsByName read_all_but_geometry(const TomlTable& root, const SceneText& source, const SceneAccess& access, Scene& scene) {
  scene.file = source.file;
  scene.title = read_title(root, source.file);
  scene.model.plot = read_plot(root);
  const SpectralLight light = read_spectral_light(root, source.file, access);
  const std::vector<double> per_w_m2 = read_light(root, access, light, scene);
  const SpectraAccess spectra{source.file, access, light};
  scene.model.soil = read_soil(root, scene.model.bands, scene.model.plot, spectra, scene.warnings);
  OpticsByName optics = read_optics(root, scene.model.bands, per_w_m2, spectra);
  scene.accuracy = read_accuracy(root);
  scene.camera = read_camera(root, scene.model.plot);
  scene.model.layers = read_layers(root, scene.model.layers);
  scene.model.planes = read_planes(root, scene.model.plot);
  scene.model.sensors = read_sensors(root, scene.model.plot);
  return optics;
}

// Refuses a change of the quantities for which the canopy's tree and counters were built.
void check_same_ground(const TomlTable& root, const RadiationModel& model, const RadiationModel& other) {
  const auto refuse = [&](const char* what) {
    root.refuse_table(fmt::format("{} differs from the scene for which the canopy's tree was built", what),
                      "change only light and optics, or load the whole scene again");
  };
  if (model.plot.axes != other.plot.axes) refuse("axes");
  const bool same_plot = model.plot.size_x_m == other.plot.size_x_m && model.plot.size_z_m == other.plot.size_z_m &&
                         model.plot.periodic == other.plot.periodic;
  if (!same_plot) refuse("[plot]");
  if (model.soil.has_value() != other.soil.has_value()) refuse("the presence of [soil]");
  if (model.soil && model.soil->patch_m != other.soil->patch_m) refuse("soil.patch");
  if (model.layers != other.layers) refuse("output.layers");
}

// Refuses optics that would change a surface's role, because the counters were assigned by the roles.
void check_same_roles(const TomlTable& root, const RadiationModel& model, std::span<const SurfaceOptics> optics) {
  const std::vector<Surface> known = Surfaces(model).of;
  std::vector<Surface> changed = known;
  set_roles(changed, model.canopy, optics);
  for (std::size_t s = 0; s < known.size(); ++s) {
    if (known[s].role == changed[s].role) continue;
    root.refuse_table(
        fmt::format("with these optics, \"{}\" would be a {}, but it was a {} when the scene was loaded",
                    printable(optics[known[s].optics].name), role_name(changed[s].role), role_name(known[s].role)),
        "give its optics the same role as before, or load the whole scene again");
  }
}

// Refuses what its name tells to be a mesh, and plants, point clouds and models in formats for which there is no reader.
void refuse_mesh(const std::filesystem::path& file) {
  constexpr std::string_view foreign[] = {".3ds", ".3mf", ".abc",  ".bgeom", ".blend", ".c4d", ".dxf", ".fbx", ".geom", ".iges",
                                          ".igs", ".las", ".laz",  ".lpy",   ".max",   ".mtg", ".off", ".ops", ".skp",  ".step",
                                          ".stp", ".usd", ".usda", ".usdc",  ".usdz",  ".vtk", ".vtp", ".wrl", ".x3d"};
  const std::string place = printable(file.string()) + ": not a scene";
  if (is_mesh_file(file)) throw_input(place, "this is a mesh", "write a scene for it: sunfleck new FILE -o stand.toml");
  if (std::find(std::begin(foreign), std::end(foreign), lower_case(file.extension().string())) != std::end(foreign))
    throw_input(place, "there is no reader for this format", fmt::format("export a mesh as {}", readable_meshes));
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const SceneAccess& access) {
  refuse_mesh(file);
  SourceFiles own;
  const SceneAccess noting = noting_access(access, own);
  return read_scene(SceneText{file, noting.files->read(file, most_bytes), {}}, noting);
}

Scene read_scene(const SceneText& source, const SceneAccess& access) {
  SourceFiles own;
  const SceneAccess noting = noting_access(access, own);
  const std::size_t before = noting.files->list().size();
  const TomlTable root = parse_scene(source);
  Scene scene;
  const OpticsByName optics = read_all_but_geometry(root, source, noting, scene);

  const std::vector<GeometryPart> parts = read_geometry(root, source, scene.model.plot, noting);
  std::vector<PlacedMesh> meshes = load_geometry(parts, *noting.files, scene.warnings);
  name_plain_optics(parts, meshes, optics, scene.warnings);
  scene.model.canopy = assemble_canopy(meshes, scene.model.plot);
  check_optics(parts, meshes, optics, scene);
  scene.model.optics = optics_of_names(root, scene.model.canopy.optics_names, optics, scene.model);
  separate_structures(scene.model);
  scene.text = source.text;
  scene.files = noting.files->list();
  scene.digest = digest_of(source.text, std::span(scene.files).subspan(before), parts);
  warn_of_unused(optics, scene, scene.warnings);
  append(scene.warnings, emission_warnings(root, scene.model));
  append(scene.warnings, receiver_warnings(root, scene));
  for (std::string& warning : plausibility_warnings(scene, all_z_up(parts))) scene.warnings.push_back(std::move(warning));
  for (std::string& warning : placement_warnings(parts, meshes, scene)) scene.warnings.push_back(std::move(warning));
  return scene;
}

void relight(Scene& scene, const SceneText& source, const SceneAccess& access) {
  const TomlTable root = parse_scene(source);
  SourceFiles own;
  const SceneAccess noting = noting_access(access, own);
  const std::size_t before = noting.files->list().size();
  Scene other;
  const OpticsByName optics = read_all_but_geometry(root, source, noting, other);
  check_same_ground(root, scene.model, other.model);
  other.model.optics = optics_of_names(root, scene.model.canopy.optics_names, optics, other.model);
  check_same_roles(root, scene.model, other.model.optics);
  const std::span<const SourceFile> read = std::span(noting.files->list()).subspan(before);
  Digest digest;
  digest.add(scene.digest);
  digest.add(digest_of(source.text, read, {}));
  other.digest = digest.text();
  other.files = std::move(scene.files);
  const auto is_read_again = [&](const SourceFile& known) {
    return std::any_of(read.begin(), read.end(), [&](const SourceFile& file) { return file.path == known.path; });
  };
  std::erase_if(other.files, is_read_again);  // a scene often gets new light from the same files
  other.files.insert(other.files.end(), read.begin(), read.end());
  other.model.canopy = std::move(scene.model.canopy);
  warn_of_unused(optics, other, other.warnings);
  scene = std::move(other);
}

}  // namespace sunfleck
