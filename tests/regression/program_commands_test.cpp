// Tests the commands other than `run`.

#include "regression/program.h"

#include <algorithm>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

class Commands : public ProgramTest {};

TEST_F(Commands, MaizeGivesAMeshThatAScenesFileCanName) {
  const std::string scene =
      "[plot]\nsize = [1.0, 0.5]\n[sun]\nelevation = 50.0\nazimuth = 90.0\n[[band]]\nname = \"PAR\"\n"
      "direct = 1.0\n[optics.leaf]\nreflectance = 0.1\n[optics.stem]\nreflectance = 0.1\n[[geometry]]\n";
  folder_.write("made.toml", scene + "generator = \"maize\"\nrows = 1\nper_row = 2\nspacing = [0.5, 0.5]\nseed = 7\n");
  const json made = json::parse(run({"info", "made.toml", "--json"}).out);
  for (const std::string name : {"stand.glb", "stand.gltf"}) {
    const Outcome outcome =
        run({"maize", "--rows", "1", "--per-row", "2", "--spacing", "0.5", "0.5", "--seed", "7", "-o", name});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind(name + ": ", 0), 0U) << outcome.out;
    folder_.write("read.toml", scene + "file = \"" + name + "\"\n");
    const json read = json::parse(run({"info", "read.toml", "--json"}).out);
    EXPECT_EQ(read["triangles"], made["triangles"]);
    EXPECT_EQ(read["organs"], made["organs"]);
    // The file contains single precision: 2^-24 of a coordinate, or 1e-5 of the area of triangles a centimetre wide.
    EXPECT_NEAR(read["area_m2"], made["area_m2"], 1e-5 * made["area_m2"].get<double>());
  }
}

TEST_F(Commands, InfoNamesTheDevices) {
  const json info = json::parse(run({"info", "--json"}).out);
  ASSERT_TRUE(info.contains("devices"));
  EXPECT_FALSE(info.contains("triangles"));
  const Outcome text = run({"info"});
  EXPECT_EQ(text.status, 0);
  for (const json& device : info["devices"]) {
    EXPECT_NE(text.out.find(device["name"].get<std::string>()), std::string::npos) << text.out;
  }
  const bool any_gpu = std::any_of(info["devices"].begin(), info["devices"].end(),
                                   [](const json& device) { return device["kind"] == "GPU" && device["usable"]; });
  EXPECT_EQ(text.out.find("CPU path") == std::string::npos, any_gpu) << text.out;
}

TEST_F(Commands, InfoTellsOfAScene) {
  const std::string scene = scene_file("maize_sparse.toml").string();
  const Outcome outcome = run({"info", scene, "--json"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  const json info = json::parse(outcome.out);
  EXPECT_GT(info["triangles"], 10000);
  EXPECT_GT(info["area_m2"], 5.0);
  EXPECT_GT(info["memory_bytes"], 100 * info["triangles"].get<double>());
  EXPECT_NEAR(info["sun"]["elevation_deg"], 53.0176, 0.001);
  EXPECT_NEAR(info["sun"]["azimuth_deg"], 120.569, 0.001);
  EXPECT_EQ(info["sun"]["sunrise"].get<std::string>().substr(0, 3), "05:");
  EXPECT_EQ(info["sun"]["transit"].get<std::string>().substr(0, 3), "12:");
  EXPECT_EQ(info["sun"]["sunset"].get<std::string>().substr(0, 3), "19:");
  const Outcome text = run({"info", scene});
  EXPECT_EQ(text.status, 0);
  for (const char* word : {"triangles", "leaf: ", "stem: ", "memory", "elevation 53.01", "sunrise 05:", "sunset 19:"}) {
    EXPECT_NE(text.out.find(word), std::string::npos) << word << text.out;
  }
}

TEST_F(Commands, InfoAndRunSayWhatCountsAsWhat) {
  const std::string scene = scene_file("chamber.toml").string();
  const json roles = json::parse(run({"info", scene, "--json"}).out)["roles"];
  EXPECT_EQ(roles.size(), 5U);
  EXPECT_EQ(roles["leaf"]["organs"], json({"leaf"}));
  EXPECT_EQ(roles["soil"]["organs"], json({"substrate"}));
  EXPECT_NEAR(roles["lamp"]["area_m2"], 0.32, 1e-6);
  EXPECT_TRUE(roles["leaf"]["area_m2"] > 0.1 && roles["leaf"]["area_m2"] < 1.0);
  const Outcome text = run({"info", scene});
  EXPECT_NE(text.out.find("counted as lamp: 0.32 m2 (lamp"), std::string::npos) << text.out;
  const Outcome report =
      run({"run", scene, "-o", "out", "--device", "cpu", "--passes", "8", "--grid", "0.1", "--images", "none"});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_NE(report.out.find("one-sided areas: leaf "), std::string::npos) << report.out;
  EXPECT_NE(report.out.find(", lamp 0.32 m2"), std::string::npos) << report.out;
  EXPECT_NE(report.out.find(", by structures "), std::string::npos) << report.out;
  const json by_role = json::parse(content(folder_ / "out/summary.json"))["area_by_role_m2"];
  EXPECT_EQ(by_role["lamp"], roles["lamp"]["area_m2"]);
}

// What is unlikely is said on standard error and stops nothing.
TEST_F(Commands, WarningsComeWithTheirPlace) {
  folder_.write("leaf.obj", "v 0 0.5 0\nv 0 0.5 1\nv 1 0.5 0\nf 1 2 3\n");
  folder_.write(
      "stand.toml",
      "[plot]\nsize = [60, 60]\n[sun]\nelevation = 0.7854\nazimuth = -60\n[[band]]\nname = \"PAR\"\n"
      "range_nm = [400, 700]\ndirect_normal = 900\n[optics.leaf]\nreflectance = 0.1\nemission = 5\n[[geometry]]\n"
      "file = \"leaf.obj\"\noptics = \"leaf\"\n[[plane]]\nheight = 2\n[[sensor]]\nname = \"s\"\nfrom = [500, 0, 1]\n");
  for (const Arguments& command :
       {Arguments{"info", "stand.toml"},
        {"run", "stand.toml", "--device", "cpu", "--passes", "8", "--grid", "1", "--images", "none"}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const char* words :
         {"stand.toml:4: sun.elevation: 0.7854 looks like radians", "stand.toml:5: sun.azimuth: -60 is below 0",
          "stand.toml:9: band.direct_normal: 900 W m-2 is more than outside the atmosphere from 400 to 700 nm",
          "optics.leaf.emission: leaves send out light", "plane.height: ", "lies above the stand",
          "sensor.from: ", "stand.toml:2: plot.size: "}) {
      EXPECT_NE(outcome.err.find(words), std::string::npos) << words << "\n" << outcome.err;
    }
  }
}

// A forecast would trace billions of rays first.
TEST_F(Commands, InfoRefusesAGridThatRunRefuses) {
  const Outcome outcome = run({"info", scene_file("two_squares.toml").string(), "--device", "cpu", "--grid", "1e-9"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("--grid 1e-09"), std::string::npos) << outcome.err;
}

TEST_F(Commands, InfoOfASunByAnglesKnowsNoTimes) {
  const json info = json::parse(run({"info", scene_file("two_squares.toml").string(), "--json"}).out);
  EXPECT_EQ(info["triangles"], 4);
  EXPECT_NEAR(info["area_m2"], 2.0, 1e-6);
  for (const char* key : {"sunrise", "transit", "sunset"}) EXPECT_TRUE(info["sun"].at(key).is_null()) << key;
}

}  // namespace
}  // namespace sunfleck::regression
