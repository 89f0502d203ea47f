#pragma once
// A small scene for testing the simulation behind the window: a leaf over soil, two bands, sun and sky.

#include "files/scene/scene_reader.h"
#include "programs/cli/options.h"
#include "simulate/simulation.h"
#include "support/temp_folder.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace sunfleck::test {

inline const std::string live_scene_text = R"(title = "Two leaves"
[plot]
size = [1.0, 1.0]
[sun]
time = 2002-08-08T10:10:00+08:00
latitude = 40.02
longitude = 116.28
[sky]
model = "cie-overcast"
[[band]]
name = "PAR"
direct = 300.0
diffuse = 60.0
[[band]]
name = "NIR"
direct = 250.0
diffuse = 20.0
[soil]
reflectance = { PAR = 0.15, NIR = 0.2 }
patch = 0.1
[optics.leaf]
reflectance = { PAR = 0.12, NIR = 0.45 }
transmittance = { PAR = 0.06, NIR = 0.4 }
[accuracy]
direct = 0.02
indirect = 0.02
[[geometry]]
file = "leaves.obj"
optics = "leaf"
up = "y"
)";

inline const std::string live_mesh_text = R"(o plant1_leaf1
v 0.2 0.4 0.2
v 0.2 0.4 0.7
v 0.7 0.5 0.7
v 0.7 0.5 0.2
f 1 2 3
f 1 3 4
o plant2_leaf3
v 0.5 0.9 0.4
v 0.5 0.9 0.9
v 0.9 0.8 0.9
f 5 6 7
)";

inline std::filesystem::path write_live_scene(const TempFolder& folder) {
  folder.write("leaves.obj", live_mesh_text);
  return folder.write("leaves.toml", live_scene_text);
}

// A simulation on the CPU path, set up as in the window.
struct LiveScene {
  explicit LiveScene(const std::filesystem::path& file)
      : scene(read_scene(file)), simulation(scene, DeviceRequest{"cpu", 0, 0}, EngineUse::shared_with_window) {
    options.scene = file;
    options.device = "cpu";
    options.quiet = true;
  }
  RunOptions options;
  const Scene scene;  // the scene as it was read
  Simulation simulation;
};

// Waits until the condition holds; returns false after a long time.
template <class Condition>
bool wait_for(const Condition& condition) {
  const auto start = std::chrono::steady_clock::now();
  while (!condition()) {
    if (std::chrono::steady_clock::now() - start > std::chrono::minutes(10)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace sunfleck::test
