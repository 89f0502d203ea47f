#include "programs/viewer/saved_scene.h"

#include "base/error.h"
#include "base/file.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/scene/scene_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

// Returns the file's name relative to the scene's folder; empty if it does not lie in that folder or below.
fs::path name_in_scene_folder(const Scene& scene, const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(scene.file, ignored).lexically_normal().parent_path();
  const auto below = [](const fs::path& base, const fs::path& whole) {
    const fs::path name = whole.lexically_relative(base);
    return name.empty() || *name.begin() == ".." ? fs::path() : name;
  };
  const fs::path name = below(folder, fs::absolute(file, ignored).lexically_normal());
  if (!name.empty()) return name;
  return below(fs::weakly_canonical(folder, ignored), fs::weakly_canonical(file, ignored));
}

// Returns the name under which the saved scene finds a file that the original calls `name`; nothing if that is no file's name.
std::optional<std::string> saved_name(const Scene& scene, const std::string& name) {
  std::error_code ignored;
  const fs::path meant = fs::absolute(scene.file.parent_path() / name, ignored).lexically_normal();
  const bool known = std::any_of(scene.files.begin(), scene.files.end(), [&](const SourceFile& file) {
    return fs::absolute(file.path, ignored).lexically_normal() == meant;
  });
  if (name.empty() || !known) return std::nullopt;
  const fs::path inside = name_in_scene_folder(scene, meant);
  return inside.empty() ? meant.generic_string() : (fs::path(saved_scene_files) / inside).generic_string();
}

void put_light(SceneEditor& editor, const SceneToSave& scene) {
  const LightRequest own = request_of(scene.original);
  const SunRequest& sun = scene.request.sun;
  const bool other_sun = !same_sun(own.sun, sun);
  const bool other_sky = !same_sky(own.sky, scene.request.sky);
  if (!other_sun && !other_sky && !scene.request.own_irradiance) return;
  if (!scene.granted.model.sun) {
    editor.remove_sun();
  } else if (other_sun && sun.by_clock) {
    editor.set_sun_moment({time_of(sun), sun.offset_minutes, sun.latitude_deg, sun.longitude_deg});
  } else if (other_sun) {
    editor.set_sun_angles_deg(sun.elevation_deg, sun.azimuth_deg);
  }
  // Where only the sun has moved, the scene's own keys say what the light is, unless weather needs the time.
  const bool by_keys =
      !other_sky && !scene.request.own_irradiance && sun.shines && (sun.by_clock || !scene.original.light.weather);
  if (!by_keys) editor.set_light(scene.granted.model);
}

void put_optics(SceneEditor& editor, const SceneToSave& scene) {
  const LightRequest own = request_of(scene.original);
  for (std::size_t i = 0; i < own.optics.size(); ++i) {
    if (own.optics[i] != scene.request.optics[i]) editor.set_optics(scene.granted.model, i);
  }
  if (own.soil_reflectance != scene.request.soil_reflectance) editor.set_soil(scene.granted.model);
}

}  // namespace

std::string saved_scene_text(const SceneToSave& scene) {
  SceneEditor editor(scene.original);
  editor.rename_files([&](const std::string& name) { return saved_name(scene.original, name); });
  editor.set_title(scene.granted.title);
  put_light(editor, scene);
  put_optics(editor, scene);
  editor.set_accuracy(scene.accuracy);
  std::string text = "# The scene of this result, as `sunfleck view` showed it.\n";
  if (scene.seed != 1) text += fmt::format("# Run it with --seed {}.\n", scene.seed);
  return text + editor.text() + '\n';
}

void save_scene(const SceneToSave& scene, const fs::path& folder) {
  const fs::path file = folder / saved_scene_file;
  std::error_code ignored;
  if (fs::equivalent(file, scene.original.file, ignored)) {
    throw_input(file.string(), "the window shows this scene, and would replace it", "give another folder with -o");
  }
  const std::string text = saved_scene_text(scene);
  for (const SourceFile& source : scene.original.files) {
    const fs::path name = name_in_scene_folder(scene.original, source.path);
    if (name.empty() || !fs::is_regular_file(source.path, ignored)) continue;
    const bool is_text = !is_mesh_file(scene.original.file) && fs::equivalent(source.path, scene.original.file, ignored);
    if (is_text) continue;
    const fs::path copy = folder / saved_scene_files / name;
    make_folder(copy.parent_path());
    std::error_code error;
    fs::copy_file(source.path, copy, fs::copy_options::overwrite_existing, error);
    if (error) throw_failure(copy.string(), error.message(), "check space and permissions, or give another folder with -o");
  }
  write_file(file, text);
}

}  // namespace sunfleck
