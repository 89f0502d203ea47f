// Tests broken scenes and meshes: each gives one line on standard error that names the place, before any work starts.

#include "regression/program.h"

#include <sys/stat.h>

#include <cstdint>

namespace sunfleck::regression {
namespace {

const std::string plot_table = "[plot]\nsize = [1.0, 1.0]\n";
const std::string sun_table = "[sun]\nelevation = 30.0\nazimuth = 90.0\n";
const std::string band_table = "[[band]]\nname = \"PAR\"\ndirect = 100.0\n";
const std::string leaf_table = "[optics.leaf]\nreflectance = 0.1\n";
const std::string head = plot_table + sun_table + band_table + leaf_table;
const std::string good_obj = "v 0 1 0\nv 0 1 1\nv 1 1 0\nusemtl leaf\nf 1 2 3\n";

std::string mesh(const std::string& name) {
  return "[[geometry]]\nfile = \"" + name + "\"\n";
}

struct Attack {
  std::string scene;
  std::string names;  // text that the message must contain
  std::string file;   // a further file of the scene
  std::string bytes;
};

class Attacks : public ProgramTest {
 protected:
  void expect_refused(const Attack& attack) const {
    SCOPED_TRACE(attack.scene + attack.bytes.substr(0, 100));
    folder_.write("scene.toml", attack.scene);
    folder_.write("good.obj", good_obj);
    if (!attack.file.empty()) folder_.write(attack.file, attack.bytes);
    expect_one_error(run({"run", "scene.toml", "--device", "cpu", "-o", "out"}), 2, attack.names);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
};

TEST_F(Attacks, TheGroundTheyStandOnIsGood) {
  folder_.write("scene.toml", head + mesh("good.obj"));
  folder_.write("good.obj", good_obj);
  simulate("scene.toml", {"--device", "cpu", "--grid", "0.05", "--images", "none"});
  EXPECT_EQ(summary()["triangles"], 1);
}

TEST_F(Attacks, BrokenScenes) {
  const std::vector<Attack> attacks{
      {head + "[plot\n", "scene.toml:11", {}, {}},
      {head + std::string("\xff\xfe"), "UTF-8", {}, {}},
      {"", "plot", {}, {}},
      {head + "[canopy]\nheight = 2.0\n", "canopy", {}, {}},
      {plot_table + "colour = 3\n" + sun_table + band_table, "scene.toml:3", {}, {}},
      {"[plot]\nsize = \"large\"\n" + sun_table + band_table, "scene.toml:2", {}, {}},
      {"[plot]\nsize = [0.0, 1.0]\n" + sun_table + band_table, "scene.toml:2", {}, {}},
      {"[plot]\nsize = [1.0, nan]\n" + sun_table + band_table, "scene.toml:2", {}, {}},
      {plot_table + sun_table + "[[band]]\nname = \"PAR\"\ndirect = -1.0\n", "scene.toml:8", {}, {}},
      {plot_table + sun_table + "[[band]]\nname = \"PAR\"\ndirect = nan\n", "scene.toml:8", {}, {}},
      {plot_table + band_table, "direct", {}, {}},
      {plot_table + sun_table, "band", {}, {}},
      {plot_table + sun_table + band_table + "[optics.leaf]\nreflectance = 0.7\ntransmittance = 0.4\n", "optics.leaf", {}, {}},
      {plot_table + sun_table + band_table + "[optics.leaf]\nreflectance = 12\n", "scene.toml:10", {}, {}},
      {plot_table + sun_table + band_table + "[optics.leaf]\nreflectance = { NIR = 0.4 }\n", "scene.toml:10", {}, {}},
      {plot_table + "[sun]\nelevation = 95.0\nazimuth = 0.0\n" + band_table, "scene.toml:4", {}, {}},
      {plot_table + "[sun]\ntime = 2002-08-08T10:10:00\nlatitude = 40.0\nlongitude = 116.0\n" + band_table,
       "scene.toml:4",
       {},
       {}},
      {head + "[sky]\nmodel = \"blue\"\n", "scene.toml:12: sky.model", {}, {}},
      {head + "[sky]\nmodel = \"lights\"\nfile = \"absent.light\"\n", "scene.toml:13: sky.file", {}, {}},
      {head + "[sky]\nmodel = \"lights\"\nfile = \"../a.light\"\n", "outside the scene's folder", {}, {}},
      {head + "[sky]\nmodel = \"lights\"\nfile = \"a.light\"\n", "a.light:1", "a.light", "1 0 0\n"},
      {head + "[[plane]]\nheight = -0.5\ncells = [10, 10]\n", "scene.toml:12: plane.height", {}, {}},
      {head + "[[plane]]\nheight = 0.5\ncells = [10.5, 10]\n", "scene.toml:13: plane.cells", {}, {}},
      {head + "[[sensor]]\nname = \"a\"\n", "scene.toml:11: sensor.from", {}, {}},
      {head + "[weather]\nghi = 80000.0\n", "scene.toml:12: weather.ghi", {}, {}},
      {head + "[weather]\nfile = \"a.csv\"\n", "time", "a.csv", "time,ghi\n"},
      {plot_table + "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.0\nlongitude = 116.0\n[[band]]\nname = \"PAR\"\n" +
           "[sky]\nmodel = \"uniform\"\n[weather]\nfile = \"a.csv\"\n",
       "a.csv:2: ghi 'NaN'", "a.csv", "time,ghi\n2002-08-08T10:00Z,NaN\n"},
      {head + "emission = -1.0\n", "emission", {}, {}},
      {head + "[accuracy]\ndirect = 0.0\n", "scene.toml:12", {}, {}},
      {head + "[output]\nlayers = 0\n", "scene.toml:12", {}, {}},
  };
  for (const Attack& attack : attacks) expect_refused(attack);
}

TEST_F(Attacks, BrokenGeometry) {
  std::filesystem::create_directories(folder_ / "folder.obj");
  const std::vector<Attack> attacks{
      {head + "[[geometry]]\ngenerator = \"wheat\"\n", "scene.toml:12", {}, {}},
      {head + "[[geometry]]\ngenerator = \"maize\"\nrows = 0\n", "scene.toml:13", {}, {}},
      {head + mesh("absent.obj"), "absent.obj", {}, {}},
      {head + mesh("folder.obj"), "folder.obj", {}, {}},
      {head + mesh("../outside.obj"), "../outside.obj", {}, {}},
      {head + mesh("/etc/passwd"), "/etc/passwd", {}, {}},
      {head + mesh("stand.xyz"), "stand.xyz", "stand.xyz", "1 2 3\n"},
      {plot_table + sun_table + band_table + mesh("good.obj"), "\"leaf\"", {}, {}},
      {head + mesh("good.obj") + "scale = 0.0\n", "scene.toml:13", {}, {}},
      {head + mesh("good.obj") + "at = [[0.0, nan, 0.0]]\n", "scene.toml:13", {}, {}},
  };
  for (const Attack& attack : attacks) expect_refused(attack);
}

TEST_F(Attacks, BrokenMeshes) {
  std::string glb = "glTF";
  for (const std::uint32_t word : {2U, 1000U, 900U, 0x4E4F534AU}) glb.append(reinterpret_cast<const char*>(&word), sizeof word);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  const std::vector<Attack> attacks{
      {head + mesh("a.obj"), "a.obj:5", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl leaf\nf 1 2 9\n"},
      {head + mesh("a.obj"), "a.obj:1", "a.obj", "v 0 nan 0\nv 1 0 0\nv 0 1 0\nusemtl leaf\nf 1 2 3\n"},
      {head + mesh("a.obj"), "a.obj", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
      {head + mesh("a.obj"), "a.obj", "a.obj", ""},
      {head + mesh("a.glb"), "a.glb", "a.glb", glb + "{\"asset\""},
      {head + mesh("a.glb"), "a.glb", "a.glb", "glTF"},
      {head + mesh("a.gltf"), "a.gltf", "a.gltf", "{\"asset\": {\"version\": \"2.0\"}"},
      {head + mesh("a.ply"), "a.ply", "a.ply", ""},
      {head + mesh("a.ply"), "a.ply", "a.ply", ply + "3 0 1 7\n"},
      {head + mesh("a.ply"), "a.ply", "a.ply", ply + "3 0 1"},
      {head + mesh("a.stl"), "a.stl", "a.stl", std::string(200, '\x5a')},
      {head + mesh("a.stl"), "a.stl", "a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"},
      {head + mesh("a.can"), "a.can:1", "a.can", "p 1 100012007001 3 0 0 0 1 0 0\n"},
      {head + mesh("a.can.gz"), "a.can.gz", "a.can.gz", "p 1 100012007001 3 0 0 0 1 0 0 1 1 0\n"},
  };
  for (const Attack& attack : attacks) expect_refused(attack);
}

TEST_F(Attacks, AFileOutsideIsForThoseWhoAskForIt) {
  std::filesystem::create_directories(folder_ / "inner");
  folder_.write("good.obj", good_obj);
  const std::filesystem::path scene = folder_.write("inner/scene.toml", head + mesh("../good.obj"));
  const Arguments quick{"--device", "cpu", "--grid", "0.05", "--images", "none"};
  expect_one_error(run(Arguments{"run", scene.string(), "-o", "out"} + quick), 2, "../good.obj");
  simulate(scene, quick + Arguments{"--allow-outside"});
}

TEST_F(Attacks, EveryFileOfASceneStaysInItsFolder) {
  namespace fs = std::filesystem;
  fs::create_directories(folder_ / "inner");
  folder_.write("sky.light", "1 0 0 -1\n");
  folder_.write("station.csv", "time,ghi\n2002-08-08T10:00+08:00,800\n2002-08-08T10:30+08:00,400\n");
  folder_.write("good.obj", good_obj);
  fs::create_symlink("../sky.light", folder_ / "inner/link.light");
  fs::create_symlink("../station.csv", folder_ / "inner/link.csv");
  fs::create_symlink("../good.obj", folder_ / "inner/link.obj");
  fs::create_directory_symlink("..", folder_ / "inner/up");
  const std::string noon_table = "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.0\nlongitude = 116.0\n";
  const Arguments quick{"--device", "cpu", "--grid", "0.05", "--images", "none"};
  const std::string lights =
      plot_table + sun_table + band_table + "diffuse = 10.0\n" + leaf_table + "[sky]\nmodel = \"lights\"\nfile = ";
  const std::string station =
      plot_table + noon_table + "[[band]]\nname = \"PAR\"\n" + leaf_table + "[sky]\nmodel = \"uniform\"\n[weather]\nfile = ";
  const std::string geometry = head + "[[geometry]]\nfile = ";
  for (const std::string& scene :
       {lights + "\"link.light\"\n", lights + "\"../sky.light\"\n", lights + "\"up/sky.light\"\n", station + "\"link.csv\"\n",
        station + "\"../station.csv\"\n", geometry + "\"link.obj\"\n", geometry + "\"up/good.obj\"\n",
        geometry + "\"" + (folder_ / "good.obj").string() + "\"\n"}) {
    SCOPED_TRACE(scene);
    const std::filesystem::path file = folder_.write("inner/scene.toml", scene);
    expect_one_error(run(Arguments{"run", file.string(), "-o", "out"} + quick), 2, "outside the scene's folder");
    simulate(file, quick + Arguments{"--allow-outside"});
  }
}

// Opening a FIFO that nobody writes to would hang.
TEST_F(Attacks, WhatIsNoFileEndsAtOnce) {
  for (const char* name : {"scene.toml", "field.csv"}) ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
  std::filesystem::create_directories(folder_ / "folder.toml");
  std::filesystem::create_directories(folder_ / "result");
  ASSERT_EQ(::mkfifo((folder_ / "result/pictures.cbor").c_str(), 0600), 0);
  folder_.write("empty.toml", "");
  folder_.write("good.toml", plot_table + sun_table + band_table);
  for (const char* name : {"scene.toml", "folder.toml", "empty.toml", "gone.toml", "/dev/null", "/dev/zero"})
    expect_one_error(run({"run", name, "--device", "cpu", "-o", "out"}), 2, name);
  expect_one_error(run({"render", "result", "--device", "cpu", "-o", "a.png"}), 2, "pictures.cbor");
  expect_one_error(run({"run", "good.toml", "--device", "cpu", "-o", "out", "--measured", "field.csv"}), 2, "field.csv");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

// A name in an older encoding is no reason to reject a scene, but must not make the tables and the summary unreadable.
TEST_F(Attacks, NamesThatAreNotUtf8) {
  folder_.write("st\xe4nd.toml", head + mesh("good.obj"));
  folder_.write("good.obj", good_obj);
  const std::string exports = "csv,nc,vtp,glb,ply,caribu";
  simulate(folder_ / "st\xe4nd.toml", {"--device", "cpu", "--grid", "0.05", "--size", "160x120", "--export", exports});
  EXPECT_FALSE(summary().is_discarded());
  EXPECT_EQ(file("profile.csv").substr(0, 8), "# st?nd\n");
  folder_.write("n\xe4her.toml", head + "[canopy]\n");
  expect_one_error(run({"run", (folder_ / "n\xe4her.toml").string(), "--device", "cpu"}), 2, "n?her.toml:11");
}

}  // namespace
}  // namespace sunfleck::regression
