#pragma once
// A scene file that contains everything, and a folder for it.

#include "files/scene/scene_reader.h"
#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace sunfleck {

// Contains every table and nearly every key of a scene file.
inline const std::string good_scene = R"(title = "A test stand"

[plot]
size     = [2.0, 3]
periodic = false

[sun]
elevation = 30.0
azimuth   = 270

[[band]]
name    = "PAR"
direct  = 350.0
diffuse = 0.0

[[band]]
name          = "NIR_1"
direct_normal = 400

[soil]
reflectance = { PAR = 0.15, NIR_1 = 0.25 }
patch       = 0.02
rgb         = [0.2, 0.15, 0.1]

[optics.leaf]
reflectance   = { PAR = 0.12, NIR_1 = 0.45 }
transmittance = { PAR = 0.06, NIR_1 = 0.55 }
rgb           = [0.05, 0.1, 0.04]

[optics.bark.upper]
reflectance = 0.3

[optics.bark.lower]
reflectance   = 0.1
transmittance = { PAR = 0, NIR_1 = 0.2 }

[[geometry]]
file    = "plates.obj"
optics  = { leaf = "leaf", "*" = "bark" }
up      = "y"
scale   = 0.5
heading = [0, 90.0]
at      = [[0.5, 0.0, 1.0], [1.5, 0.25, 2.0]]

[accuracy]
direct     = 0.002
indirect   = 0.004
confidence = 0.9
of         = "organ"

[camera]
position = [3.0, 2.5, 3.0]
look_at  = [0.9, 1.0, 1.2]
fov      = 50

[output]
layers = 12
)";

inline const std::string plates_obj = R"(v 0 1 0
v 0 1 1
v 1 1 0
v 0 2 0
v 0 2 1
v 1 2 0
f 1 2 3
usemtl leaf
f 4 5 6
)";

// Contains sky, weather and receivers, with all of their keys that can be combined.
inline const std::string lit_scene = R"([plot]
size = [2.0, 3]

[sun]
time      = 2002-08-08T10:10:00+08:00
latitude  = 40.02
longitude = 116.28

[sky]
model = "perez"
dni   = 700.0
dhi   = 110.0

[weather]
file  = "station.csv"
split = "spitters"

[[band]]
name           = "PAR"
share          = 0.45
umol_per_joule = 4.57

[[band]]
name          = "NIR"
direct_normal = 400.0
diffuse       = 60.0

[[plane]]
height = 0.5
cells  = [20, 30]

[[plane]]
height = 0.25

[[sensor]]
name   = "ceptometer"
from   = [0.2, 1.2, 0.1]
to     = [0.2, 1.2, 2.1]
points = 5
normal = [0, -2, 0]

[[sensor]]
name     = "ball"
from     = [1, 1, 1]
response = "spherical"
)";

inline const std::string station_csv =
    "time,ghi\n2002-08-08T10:00+08:00,800\n2002-08-08T10:10+08:00,400\n2002-08-08T10:20+08:00,100\n";

// The smallest scene.
inline const std::string bare_scene = "[plot]\nsize = [1.0, 1.0]\n[[band]]\nname = \"PAR\"\n";

// Parts of small scenes.
inline const std::string plot_table = "[plot]\nsize = [1, 1]\n";
inline const std::string moment_table = "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.02\nlongitude = 116.28\n";
inline const std::string par_table = "[[band]]\nname = \"PAR\"\n";

inline void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::size_t line_of(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  EXPECT_NE(at, std::string::npos) << mark;
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// Returns a level triangle 0.5 m above a plot of 1 m2, leaf 7 of plant 3.
inline Mesh one_leaf() {
  Mesh mesh;
  mesh.vertices = {{0.2, 0.5, 0.2}, {0.2, 0.5, 0.8}, {0.8, 0.5, 0.2}};
  mesh.triangles = {{0, 1, 2}};
  mesh.optics_of = {0};
  mesh.organ_of = {0};
  mesh.optics_names = {"leaf"};
  mesh.organs = {{3, "leaf", 7}};
  return mesh;
}

// Gives each test a folder with plates.obj and station.csv in it.
class SceneFolder : public ::testing::Test {
 protected:
  SceneFolder() {
    folder_.write("plates.obj", plates_obj);
    folder_.write("station.csv", station_csv);
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "scene.toml"; }
  [[nodiscard]] Scene read(const std::string& text, const SceneAccess& access = {}) const {
    return read_scene(folder_.write("scene.toml", text), access);
  }
  // Expects the text to be refused for that key in the line of `mark`, in words that include the hint.
  void expect_refused(const std::string& text, const std::string& mark, const std::string& key, const std::string& hint) const {
    SCOPED_TRACE(text);
    const std::string message = expect_refusal([&] { static_cast<void>(read(text)); }, hint);
    const std::string place = file().string() + ":" + std::to_string(line_of(text, mark)) + ": " + key;
    EXPECT_EQ(message.substr(0, place.size()), place) << message;
  }

  TempFolder folder_;
};

}  // namespace sunfleck
