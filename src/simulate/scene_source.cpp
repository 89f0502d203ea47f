#include "simulate/scene_source.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/scene/mesh_scene.h"

#include <fmt/format.h>

#include <system_error>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

void refuse_stand(const fs::path& scene, const StandFiles& stand) {
  const std::string option = stand.first_given();
  if (option.empty()) return;
  throw_input(option, fmt::format("{} is a scene file, which already defines this", printable(scene.string())),
              "leave it out, or give a .can instead of the scene");
}

}  // namespace

CaribuSet caribu_set(const fs::path& mesh, const StandFiles& stand, bool allow_outside) {
  if (stand.optics.empty() || stand.light.empty()) {
    expect_file(mesh);
    throw_input(
        printable(mesh.string()), "a mesh alone has neither optics nor light",
        fmt::format("write a scene for it: sunfleck new {} -o stand.toml; or give --optics FILE.opt and --light FILE.light",
                    in_shell(printable(mesh.string()))));
  }
  CaribuSet set{mesh, {}, stand.light, std::nullopt, stand.scale.value_or(1.0), allow_outside};
  for (const std::string& word : stand.optics) set.bands.push_back(caribu_band(word));
  if (!stand.domain.empty()) set.domain = stand.domain;
  return set;
}

fs::path name_from(const fs::path& folder, const fs::path& file) {
  std::error_code folder_error, file_error;
  const fs::path base = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, folder_error);
  const fs::path whole = fs::weakly_canonical(file, file_error);
  if (folder_error || file_error) return fs::absolute(file, file_error);
  const fs::path relative = whole.lexically_relative(base);
  return relative.empty() || *relative.begin() == ".." ? whole : relative;
}

Scene load_scene(const SceneRequest& request, ScenePurpose purpose, SourceFiles* files) {
  const fs::path& scene = request.scene;
  const StandFiles& stand = request.stand;
  if (!is_mesh_file(scene)) {
    refuse_stand(scene, stand);
    return read_scene(scene, {request.allow_outside, purpose, files});
  }
  if (purpose == ScenePurpose::day) {
    throw_input(printable(scene.string()), "a mesh file has no place, date or weather, which a day needs",
                "convert it to a scene with sunfleck convert and add them");
  }
  const fs::path folder = scene.parent_path();
  SourceFiles own;
  if (files == nullptr) files = &own;
  if (request.mesh_alone && stand.first_given().empty()) {
    const MeshToShow mesh{scene, name_from(folder, scene).generic_string()};
    return read_scene(SceneText{scene, mesh_scene_text({&mesh, 1}, request.allow_outside, files), {}},
                      {.allow_outside = request.allow_outside, .files = files});
  }
  const CaribuSet set = caribu_set(scene, stand, request.allow_outside);
  const CaribuScene made =
      caribu_scene(set, {name_from(folder, scene).generic_string(), name_from(folder, stand.light).generic_string()}, files);
  return read_scene(SceneText{scene, made.text, {}},
                    {.allow_outside = request.allow_outside, .files = files, .named = {scene, stand.light}});
}

Scene load_scene_with_warnings(const SceneRequest& request, ScenePurpose purpose) {
  Scene scene = load_scene(request, purpose);
  for (const std::string& warning : scene.warnings) warn(warning);
  return scene;
}

bool remove_receivers(Scene& scene) {
  const bool any = !scene.model.planes.empty() || !scene.model.sensors.empty();
  scene.model.planes.clear();
  scene.model.sensors.clear();
  return any;
}

std::string scene_stem(const fs::path& scene) {
  const fs::path stem = scene.stem();
  // The stem of a .can.gz still ends in .can.
  return is_can_file(scene) && is_can_file(stem) ? stem.stem().string() : stem.string();
}

}  // namespace sunfleck
