#pragma once
// One scene in a window, with all that works on it.

#include "app/options.h"
#include "app/pictures.h"
#include "viewer/live_light.h"
#include "viewer/live_picture.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sunfleck {

class Session {
 public:
  // Reads the scene and begins to simulate it. Throws Error (input) for a broken scene, Error (device) without the device.
  // `files` gets all that reading tries, also if it fails; `notify` is called from other threads.
  Session(const ViewOptions& options, const std::filesystem::path& scene_file, SourceFiles& files,
          const std::function<void()>& notify);

  std::filesystem::path file;

 private:
  Scene scene_;  // until `light` takes it over

 public:
  const std::string title;
  const LightWish light_of_scene;                // to begin with
  const std::vector<std::string> bands, optics;  // their names
  const std::vector<std::string> warnings;       // of the scene, one line each
  SceneTree tree;
  const ShownBox box;
  Engine engine;
  LiveLight light;
  LivePicture picture;
};

}  // namespace sunfleck
