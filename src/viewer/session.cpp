#include "viewer/session.h"

#include "app/pictures.h"
#include "app/scene_source.h"

#include <utility>

namespace sunfleck {
namespace {

Scene checked_scene(const ViewOptions& options, const std::filesystem::path& file, SourceFiles& files) {
  // A file dropped on the window is a scene file.
  const StandFiles stand = file == options.run.scene ? options.run.stand : StandFiles{};
  Scene scene = load_scene(file, stand, {.allow_outside = options.run.allow_outside, .files = &files});
  check_view(scene.model, options.run.pictures);
  check_grid(options.run, scene);
  return scene;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& things) {
  std::vector<std::string> names;
  for (const Named& thing : things) names.push_back(thing.name);
  return names;
}

// Returns the run options for the scene that is shown, which decides the folder and the name of saved files.
RunOptions run_options(const ViewOptions& options, const std::filesystem::path& file) {
  RunOptions run = options.run;
  run.scene = file;
  return run;
}

}  // namespace

Session::Session(const ViewOptions& options, const std::filesystem::path& scene_file, SourceFiles& files,
                 const std::function<void()>& notify)
    : file(scene_file),
      scene_(checked_scene(options, file, files)),
      title(scene_.title),
      light_of_scene(wish_of(scene_)),
      bands(names_of(scene_.model.bands)),
      optics(names_of(scene_.model.optics)),
      warnings(scene_.warnings),
      tree(scene_.model),
      box(shown_box(scene_.model, tree.layout)),
      engine(options.run.device, tree.bvh, {scene_.model.plot.periodic, scene_.model.soil.has_value()}, tree.layout.words(),
             EngineUse::drawn_meanwhile),
      light(std::move(scene_), tree, engine, run_options(options, file), notify),
      picture(light, tree, engine, notify) {}

}  // namespace sunfleck
