// Tests running stands in CARIBU's files without a scene, and the scenes that `convert` makes of them.

#include "regression/program.h"
#include "support/caribu_files.h"
#include "support/mesh_files.h"
#include "support/table.h"

#include <algorithm>
#include <cmath>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

// Contains two species, a stem, soil, and labels in no particular order.
const std::string stand_can =
    "p 1 200012001007 3 10 20 150 120 20 150 10 130 150\n"
    "p 1 100007003042 3 30 20 50 120 30 60 30 130 60\n"
    "p 1 100007003001 3 130 20 50 220 30 60 130 130 60\n"
    "p 1 100007000000 3 150 250 0 170 250 0 160 250 100\n"
    "p 1 000000000005 3 0 0 0 200 0 0 0 300 0\n";

class CaribuProgram : public ProgramTest {
 protected:
  CaribuProgram() {
    static_cast<void>(folder_.write("filter.can", filter_can()));
    static_cast<void>(folder_.write("filter.8", filter_domain));
    static_cast<void>(folder_.write("black.opt", black_opt));
    static_cast<void>(folder_.write("stand.can", stand_can));
    static_cast<void>(folder_.write("par.opt", grey_opt));
    static_cast<void>(folder_.write("nir.opt", grey_opt));
    static_cast<void>(folder_.write("plot.8", "0 0\n200 300\n"));
    static_cast<void>(folder_.write("sun.light", "350 -0.5178 0.3074 -0.7983\n"));
    static_cast<void>(folder_.write("sky.light", "0.5 0.4 0.3 -0.8\n0.3 0 0 -1\n0.2 -0.7 0.2 -0.3\n"));
  }

  const Arguments quick_{"--device", "cpu", "--images", "none", "--error", "0.02"};
  const Arguments stand_{"--optics", "par.opt,nir.opt", "--light", "sun.light", "--domain", "plot.8", "--scale", "0.01"};
};

std::string without_comments(const std::string& text) {
  std::string rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) rows += line + '\n';
  return rows;
}

// The layers take 1/2, 1/4 and 1/8, and the soil 1/8, whatever the direction: under one sun, the zenith, and several
// directions.
TEST_F(CaribuProgram, TheFiltersCoverHalfEach) {
  // All sixteen values lie within 1.49 half-widths of their 95 % intervals with a probability of 95 %.
  constexpr double half_widths = 1.49;
  static_cast<void>(folder_.write("low.light", "3 -0.9 -0.1 -0.2\n"));
  static_cast<void>(folder_.write("zenith.light", "1 0 0 -1\n"));
  for (const std::string light : {"sun", "low", "zenith", "sky"}) {
    SCOPED_TRACE(light);
    simulate("filter.can",
             Arguments{"--optics", "PAR=black.opt", "--light", light + ".light", "--domain", "filter.8"} + quick_);
    const json band = summary()["bands"][0];
    const double incident = band["incident"];
    EXPECT_NEAR(incident, light == "sun" ? 350.0 : light == "low" ? 3.0 : 1.0, 1e-9 * incident);
    const Table organs(file("organs.csv"));
    ASSERT_EQ(organs.size(), 3U);
    double share = 1.0;
    for (std::size_t layer = 0; layer < 3; ++layer) {
      share /= 2.0;
      EXPECT_EQ(organs.number(layer, "rank"), static_cast<double>(layer + 1));
      EXPECT_NEAR(organs.number(layer, "area_m2"), 200.0, 1e-6);
      const double got = organs.number(layer, "PAR_absorbed") * 200.0 / 400.0 / incident;
      EXPECT_NEAR(got, share, half_widths * organs.number(layer, "PAR_absorbed_error")) << "layer " << layer + 1;
    }
    const double error = band["error"]["absorbed_soil"];
    EXPECT_LT(error, 0.02 * incident);
    EXPECT_NEAR(band["absorbed_soil"], 0.125 * incident, half_widths * error);
  }
}

TEST_F(CaribuProgram, ItsTableHasTheFilesLabels) {
  simulate("stand.can", stand_ + quick_);
  const Table table(file("caribu.csv"));
  EXPECT_EQ(table.header(), "band,index,label,area,Eabs,Ei,Ei_sup,Ei_inf");
  ASSERT_EQ(table.size(), 10U);
  const std::vector<std::string> labels{"200012001007", "100007003042", "100007003001", "100007000000", "000000000005"};
  for (std::size_t row = 0; row < 10; ++row) {
    EXPECT_EQ(table.cell(row, "band"), row < 5 ? "PAR" : "NIR");
    EXPECT_EQ(table.cell(row, "label"), labels[row % 5]);
    EXPECT_EQ(table.number(row, "index"), static_cast<double>(row % 5));
  }
  EXPECT_NEAR(table.number(0, "area"), 0.5 * 1.1 * 1.1, 1e-6) << "m2, of a file in centimetres";
  // The highest leaf is level and in the full sun; its lower face receives only scattered light.
  EXPECT_NEAR(table.number(0, "Ei_sup"), 350.0, 0.05 * 350.0);
  EXPECT_LT(table.number(0, "Ei_inf"), 0.5 * 350.0);
  EXPECT_NEAR(table.number(0, "Eabs"), 0.15 * table.number(0, "Ei"), 1e-6 * 350.0) << "species 2 absorbs 0.15 on both faces";
  EXPECT_FALSE(exists("triangles.csv"));
  EXPECT_EQ(summary()["plot_area_m2"], 6.0);
}

// Soil elements of the mesh have a row; the ground added by the scene has none.
TEST_F(CaribuProgram, ItsSoilHasARowAmongTheOrgans) {
  simulate("stand.can", stand_ + quick_);
  const Table organs(file("organs.csv"));
  ASSERT_FALSE(organs.comments().empty());
  EXPECT_TRUE(std::any_of(organs.comments().begin(), organs.comments().end(), [](const std::string& line) {
    return line == "# Organs, those of soil elements included; the ground of [soil] has no row";
  }));
  double vegetation_w = 0.0, soil_w = 0.0;
  int soil_rows = 0;
  for (std::size_t row = 0; row < organs.size(); ++row) {
    const double absorbed_w = organs.number(row, "area_m2") * organs.number(row, "PAR_absorbed");
    const bool soil = organs.cell(row, "organ") == "soil";
    (soil ? soil_w : vegetation_w) += absorbed_w;
    if (!soil) continue;
    ++soil_rows;
    EXPECT_EQ(organs.cell(row, "plant"), "0");
    EXPECT_NEAR(organs.number(row, "area_m2"), 0.5 * 2.0 * 3.0, 1e-6);
  }
  EXPECT_EQ(soil_rows, 1);
  const double plot_m2 = summary()["plot_area_m2"];
  const double all_soil_w = summary()["bands"][0]["absorbed_soil"].get<double>() * plot_m2;
  constexpr double rounding = 1e-6;  // rounding of the quanta in the summary
  EXPECT_NEAR(vegetation_w, summary()["bands"][0]["absorbed_vegetation"].get<double>() * plot_m2, rounding * 350.0 * plot_m2);
  EXPECT_GT(soil_w, 0.3 * all_soil_w) << "half of the plot";
  EXPECT_LT(soil_w, 0.7 * all_soil_w);
}

TEST_F(CaribuProgram, TheWrittenSceneGivesTheSameTables) {
  for (const std::string light : {"sun.light", "sky.light"}) {
    SCOPED_TRACE(light);
    Arguments files{"--optics", "par.opt", "--optics", "IR=nir.opt", "--light", light, "--domain", "plot.8", "--scale", "0.01"};
    const Outcome made = run(Arguments{"convert", "stand.can", "made.toml"} + files);
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(made.out, "made.toml: 5 triangles, plot 3 x 2 m\n");
    simulate("stand.can", files + quick_, 0, "of_can");
    simulate("made.toml", Arguments{"--export", "caribu"} + quick_, 0, "of_scene");
    for (const char* name : {"organs.csv", "profile.csv", "caribu.csv"}) {
      const std::string of_can = without_comments(file(name, "of_can"));
      EXPECT_GT(of_can.size(), 100U);
      EXPECT_EQ(of_can, without_comments(file(name, "of_scene"))) << name;
    }
    EXPECT_EQ(summary("of_can")["scene_digest"], summary("of_scene")["scene_digest"]) << "one text";
  }
}

// A converted scene includes everything it needs, and runs without the files it was made from.
TEST_F(CaribuProgram, AWrittenSceneStandsByItself) {
  std::filesystem::create_directories(folder_ / "from/below");
  std::filesystem::create_directory(folder_ / "to");
  for (const char* name : {"stand.can", "sky.light", "par.opt"})
    std::filesystem::rename(folder_ / name, folder_ / "from" / name);
  const Arguments files{"--optics", "from/par.opt", "--light", "from/sky.light", "--scale", "0.01"};
  EXPECT_EQ(run(Arguments{"convert", "from/stand.can", "from/here.toml"} + files).status, 0);
  EXPECT_NE(file("here.toml", "from").find("file  = \"stand.can\""), std::string::npos);
  EXPECT_EQ(run(Arguments{"convert", "from/stand.can", "above.toml"} + files).status, 0);
  EXPECT_NE(content(folder_ / "above.toml").find("file  = \"from/stand.can\""), std::string::npos);
  for (int again = 0; again < 2; ++again) {
    const Outcome made = run(Arguments{"convert", "from/stand.can", "to/there.toml"} + files);
    EXPECT_EQ(made.status, 0) << "the same copy is no obstacle: " << made.err;
  }
  EXPECT_EQ(file("stand.can", "to"), stand_can);
  folder_.write("to/stand.can", "# another\n");
  expect_one_error(run(Arguments{"convert", "from/stand.can", "to/there.toml"} + files), 2, "to/stand.can");
  EXPECT_EQ(file("stand.can", "to"), "# another\n");
  folder_.write("to/stand.can", stand_can);
  std::filesystem::remove_all(folder_ / "from");
  const Outcome info = run({"info", "to/there.toml", "--json"});
  EXPECT_EQ(json::parse(info.out)["triangles"], 5) << info.err;
}

TEST_F(CaribuProgram, EveryCommandOfAScene) {
  const json info = json::parse(run(Arguments{"info", "stand.can", "--json"} + stand_).out);
  EXPECT_EQ(info["triangles"], 5);
  EXPECT_NEAR(info["sun"]["elevation_deg"], 52.97, 0.01);
  EXPECT_NEAR(info["sun"]["azimuth_deg"], 120.70, 0.01);
  static_cast<void>(folder_.write("packed.can.gz", gzip(stand_can)));
  const Outcome picture =
      run(Arguments{"render", "packed.can.gz", "--size", "64x64", "--device", "cpu", "--error", "0.1"} + stand_);
  EXPECT_EQ(picture.status, 0) << picture.err;
  EXPECT_EQ(picture.out, "packed_rank_total.png\n");
  static_cast<void>(run(Arguments{"run", "packed.can.gz"} + stand_ + quick_));
  EXPECT_TRUE(exists("summary.json", "results/packed"));
  expect_one_error(run(Arguments{"render", "results/packed"} + stand_), 2, "--optics");
  expect_one_error(run({"day", "stand.can"}), 2, "stand.can (a mesh file has no place");
}

TEST_F(CaribuProgram, MistakesAreOneLine) {
  const auto refused = [&](const Arguments& more, const std::string& names, const std::string& scene = "stand.can") {
    SCOPED_TRACE(::testing::PrintToString(more));
    expect_one_error(run(Arguments{"run", scene, "-o", "out"} + more), 2, names);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  };
  const std::string scene = scene_file("two_squares.toml").string();
  refused({}, "stand.can (a mesh alone has neither");
  refused({}, "absent.can: cannot be read (there is no such file)", "absent.can");
  refused({"--optics", "par.opt"}, "--light FILE.light");
  refused({"--light", "sun.light"}, "--optics FILE.opt");
  refused({"--optics", "par.opt"}, "--optics (", scene);
  refused({"--light", "sun.light"}, "--light (", scene);
  refused({"--domain", "plot.8"}, "--domain (", scene);
  refused({"--scale", "0.01"}, "--scale (", scene);
  refused({"--optics", "black.opt", "--light", "sun.light"}, "black.opt has only 1");
  refused({"--optics", "par.opt,par.opt", "--light", "sun.light"}, "there is already a band named PAR");
  refused({"--optics", "none.opt", "--light", "sun.light"}, "none.opt");
  refused({"--optics", "par.opt", "--light", "none.light"}, "none.light");
  refused({"--optics", "par.opt", "--light", "sun.light", "--domain", "none.8"}, "none.8");
  refused({"--optics", "par.opt", "--light", "sun.light", "--scale", "0"}, "--scale 0");
  refused({"--optics", "par.opt", "--light", "sun.light", "--scale", "1e300"}, "stand.can");
  refused({"--optics", "par.opt", "--light", "sun.light"}, "none.can", "none.can");
  folder_.write("up.light", "1 0 0 1\n");
  refused({"--optics", "par.opt", "--light", "up.light"}, "up.light:1: direction 0 0 1");
}

class Convert : public CaribuProgram {};

TEST_F(Convert, MeshesAmongEachOther) {
  const Arguments scaled{"--scale", "0.01"};
  for (const std::string name : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.can"}) {
    SCOPED_TRACE(name);
    const Outcome made = run(Arguments{"convert", "stand.can", name} + scaled);
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(made.err, "");
    EXPECT_EQ(made.out, name + ": 5 triangles, 4 organs, optics leaf2, leaf, stem, soil\n");
    const bool named = name != "a.ply";
    folder_.write("scene.toml",
                  "[plot]\nsize = [3, 2]\n[[band]]\nname = \"PAR\"\n[optics.leaf]\nreflectance = 0.1\n"
                  "[optics.leaf2]\nreflectance = 0.1\n[optics.stem]\nreflectance = 0.1\n[soil]\nreflectance = 0.1\n"
                  "[[geometry]]\nfile = \"" +
                      name + "\"\n" + (named ? "" : "optics = \"leaf\"\n"));
    const json info = json::parse(run({"info", "scene.toml", "--json"}).out);
    EXPECT_EQ(info["triangles"], 5);
    // Leaves of half of 1.1 x 1.1 and twice half of |(0.9, 0.1, 0.1) x (0, 1.1, 0.1)| m2, a stem of 0.1 m2 and soil of 3 m2.
    EXPECT_NEAR(info["area_m2"], 0.605 + std::sqrt(0.9982) + 0.1 + 3.0, 1e-5);
    if (!named) continue;
    EXPECT_EQ(info["organs"], 4);
    EXPECT_NEAR(info["area_by_optics_m2"]["leaf2"], 0.605, 1e-6);
    EXPECT_NEAR(info["area_by_optics_m2"]["soil"], 3.0, 1e-5);
  }
  const std::string can = content(folder_ / "a.can");
  EXPECT_NE(can.find("p 1 100007003042 3 0.3 0.2 0.5 "), std::string::npos) << can;
}

TEST_F(Convert, AnUprightMesh) {
  folder_.write("up.obj", "v 1 2 3\nv 4 2 3\nv 1 5 3\nf 1 2 3\n");
  EXPECT_EQ(run({"convert", "up.obj", "turned.obj", "--z-up"}).out, "turned.obj: 1 triangle, 1 organ, optics leaf\n");
  EXPECT_NE(content(folder_ / "turned.obj").find("v -2 3 -1\n"), std::string::npos);
}

TEST_F(Convert, TheWholeCanopyOfAScene) {
  const std::string scene = scene_file("two_squares.toml").string();
  const Outcome made = run({"convert", scene, "squares.obj"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out.rfind("squares.obj: 4 triangles, ", 0), 0U) << made.out;
  // A scene that places a .can twice keeps the labels and continues the numbering of plants.
  folder_.write("twice.toml",
                "[plot]\nsize = [300, 400]\n[[band]]\nname = \"PAR\"\n[optics.leaf]\nreflectance = 0.1\n"
                "[optics.leaf2]\nreflectance = 0.1\n[optics.stem]\nreflectance = 0.1\n[soil]\nreflectance = 0.1\n"
                "[[geometry]]\nfile = \"stand.can\"\nat = [[300, 0, 200], [300, 0, 400]]\n");
  EXPECT_EQ(run({"convert", "twice.toml", "twice.can"}).status, 0);
  const std::string can = content(folder_ / "twice.can");
  for (const char* label : {"200012001007", "100007003042", "200024001007", "100019003042"})
    EXPECT_NE(can.find(std::string("p 1 ") + label + " 3 "), std::string::npos) << label;
  EXPECT_EQ(run({"convert", scene, "squares.can"}).status, 0);
  EXPECT_NE(run({"convert", scene, "squares.can"}).err.find("become leaves or stems"), std::string::npos);
  // Two organs of one plant that have the same number.
  folder_.write("twins.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl leaf\no plant1_leaf2\nf 1 2 3\no plant1_petiole2\nf 1 3 2\n");
  const Outcome merged = run({"convert", "twins.obj", "twins.can"});
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_NE(merged.err.find("2 of 2 organs are merged"), std::string::npos) << merged.err;
}

TEST_F(Convert, MistakesAreOneLine) {
  const std::string scene = scene_file("two_squares.toml").string();
  const auto refused = [&](const Arguments& more, const std::string& names, int status = 2) {
    SCOPED_TRACE(::testing::PrintToString(more));
    expect_one_error(run(Arguments{"convert"} + more), status, names);
  };
  const std::string before = content(folder_ / "stand.can");
  std::filesystem::create_symlink("stand.can", folder_ / "link.can");
  refused({"stand.can"}, "out");
  refused({"stand.can", "stand.can"}, "stand.can (it is the same file as the input");
  refused({"stand.can", "link.can"}, "link.can (it is the same file as the input");
  refused({"stand.can", "a.xyz"}, "use .glb, .gltf, .obj, .ply or .can, or .toml");
  refused({"stand.can", "a.can.gz"}, "a.can.gz (");
  refused({"a.fbx", "a.glb"}, "a.fbx (");
  refused({"none.can", "a.glb"}, "none.can");
  refused({scene, "a.toml"}, "a.toml (the input and the output are both scene files");
  refused({"stand.can", "a.toml"}, "stand.can (a mesh alone");
  refused({"stand.can", "a.glb", "--light", "sun.light"}, "--light (a mesh file cannot hold this");
  refused({scene, "a.glb", "--scale", "2"}, "--scale (");
  refused({"stand.can", "a.toml", "--z-up", "--optics", "par.opt", "--light", "sun.light"}, "--z-up (");
  refused({"stand.can", "gone/a.glb"}, "gone/a.glb", 1);
  refused({"stand.can", "gone/a.toml", "--optics", "par.opt", "--light", "sun.light"}, "gone/", 1);
  EXPECT_EQ(content(folder_ / "stand.can"), before);
  folder_.write("bare.toml", "[plot]\nsize = [1, 1]\n[[band]]\nname = \"PAR\"\n");
  refused({"bare.toml", "a.glb"}, "bare.toml (the scene has no triangles");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.glb"));
}

}  // namespace
}  // namespace sunfleck::regression
