#include "programs/viewer/saved_scene.h"

#include "base/error.h"
#include "base/file.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/scene/scene_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

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
  fs::path name = below(folder, fs::absolute(file, ignored).lexically_normal());
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

SunByClock clock_of(const SunRequest& sun) {
  SunRequest without_offset = sun;
  without_offset.offset_minutes = 0;
  return {time_of(without_offset), sun.offset_minutes, sun.latitude_deg, sun.longitude_deg};
}

void edit_light(const SceneToSave& scene, const LightRequest& own, SceneEdits& edits) {
  const RadiationModel& model = scene.granted.model;
  const SunRequest& sun = scene.request.sun;
  const bool other_sun = !same_sun(own.sun, sun);
  const bool other_light = !same_sky(own.sky, scene.request.sky) || scene.request.own_irradiance;
  if (!other_sun && !other_light) return;
  if (!model.sun) {
    edits.sun = Absent();
  } else if (other_sun && sun.by_clock) {
    edits.sun = clock_of(sun);
  } else if (other_sun) {
    edits.sun = SunByAngles{sun.elevation_deg, sun.azimuth_deg};
  }
  // Where only the sun has moved, the scene's own keys say what the light is, unless weather needs the time.
  if (!other_light && sun.shines && (sun.by_clock || !scene.original.light.weather)) return;
  edits.irradiances = model.bands;
  if (!model.sky) {
    edits.sky = Absent();
  } else if (model.sky->kind != SkyKind::lights) {
    edits.sky = *model.sky;
  }
}

void edit_optics(const SceneToSave& scene, const LightRequest& own, SceneEdits& edits) {
  for (std::size_t i = 0; i < own.optics.size(); ++i) {
    if (own.optics[i] != scene.request.optics[i]) edits.optics.push_back(scene.granted.model.optics[i]);
  }
  if (own.soil_reflectance != scene.request.soil_reflectance) edits.soil_reflectance = scene.request.soil_reflectance;
}

}  // namespace

std::string saved_scene_text(const SceneToSave& scene) {
  const LightRequest own = request_of(scene.original);
  SceneEdits edits;
  edits.title = scene.granted.title;
  edits.accuracy = scene.accuracy;
  edits.renamed_file = [&](const std::string& name) { return saved_name(scene.original, name); };
  edit_light(scene, own, edits);
  edit_optics(scene, own, edits);
  std::vector<std::string> band_names;
  for (const Waveband& band : scene.original.model.bands) band_names.push_back(band.name);
  std::string text = "# The scene of this result, as `sunfleck view` showed it.\n";
  if (scene.seed != 1) text += fmt::format("# Run it with --seed {}.\n", scene.seed);
  return text + edited_scene_text(printable(scene.original.file.string()), scene.original.text, band_names, edits);
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
