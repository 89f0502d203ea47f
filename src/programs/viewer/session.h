#pragma once
// One scene in a window, with everything that works on it.

#include "pictures/charts/pictures.h"
#include "programs/cli/options.h"
#include "programs/viewer/live_light.h"
#include "programs/viewer/live_picture.h"
#include "simulate/simulation.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sunfleck {

// Returns whether a session can show files of this name: scenes (.toml) and meshes, with the scene that mesh_scene.h writes.
[[nodiscard]] bool can_show(const std::filesystem::path& file);

class Session {
 public:
  // Reads the scene and starts simulating it. Throws Error (input) for a broken scene and Error (device) without the device.
  // `files` receives all files that reading tries, even if it fails; `notify` is called from other threads.
  Session(const ViewOptions& options, const std::filesystem::path& scene_file, SourceFiles& files,
          const std::function<void()>& notify);

  std::filesystem::path file;
  Simulation simulation;                         // only `light` changes its light
  const std::string title, plot_text;            // plot_text: number of triangles, size of the plot
  const LightRequest light_of_scene;             // initial light
  const std::vector<std::string> bands, optics;  // names
  const std::vector<std::string> warnings;       // of the scene, one line each
  const ShownBox box;
  LiveLight light;
  LivePicture picture;
};

}  // namespace sunfleck
