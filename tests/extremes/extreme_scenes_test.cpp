// Tests extreme scenes as a user runs them: they give known numbers in the files, or one clear line.
#include "regression/program.h"
#include "support/table.h"

#include <fmt/format.h>

namespace sunfleck::regression {
namespace {

// Returns a scene with a level square of half the plot's width; everything else scales with it.
std::string scene(double size_m, const std::string& sun, const std::string& bands, const std::string& rest) {
  return fmt::format(
      "[plot]\nsize = [{0}, {0}]\n{1}\n{2}\n[soil]\nreflectance = 0.0\npatch = {3}\n[optics.leaf]\nreflectance = 0.0\n"
      "[[geometry]]\nfile = \"square.obj\"\noptics = \"leaf\"\nscale = {0}\n{4}\n",
      size_m, sun, bands, size_m / 20.0, rest);
}

constexpr const char* high_sun = "[sun]\nelevation = 60.0\nazimuth = 30.0";
constexpr const char* one_band = "[[band]]\nname = \"PAR\"\ndirect = 1.0";

class ExtremeScenes : public ProgramTest {
 protected:
  void SetUp() override {
    folder_.write("square.obj", "v 0.25 0.5 0.25\nv 0.25 0.5 0.75\nv 0.75 0.5 0.75\nv 0.75 0.5 0.25\nf 1 2 3 4\n");
  }
  // Runs the scene, and draws a picture of the stored result.
  nlohmann::json run_and_draw(const std::string& text) const {
    folder_.write("scene.toml", text);
    const Outcome ran =
        simulate("scene.toml", {"--device", "cpu", "--images", "none", "--grid", size_dependent_, "--passes", "16"});
    EXPECT_EQ(ran.status, 0) << ran.err;
    const Outcome drawn = run({"render", "out", "-o", "picture.png", "--size", "64x64", "--samples", "1"});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "picture.png"));
    return summary();
  }
  void expect_refused(const std::string& text, const Arguments& more, const std::string& names) const {
    folder_.write("scene.toml", text);
    Outcome outcome = run(Arguments{"run", "scene.toml", "-o", "out", "--device", "cpu", "--images", "none"} + more);
    while (outcome.err.starts_with("warning: ")) outcome.err.erase(0, outcome.err.find('\n') + 1);
    expect_one_error(outcome, 2, names);
  }
  std::string size_dependent_ = "0.004";
};

TEST_F(ExtremeScenes, IrradianceOfAnySize) {
  for (const char* irradiance : {"1e-12", "1e12", "1e15"}) {
    const auto found = run_and_draw(scene(1.0, high_sun, fmt::format("[[band]]\nname = \"PAR\"\ndirect = {}", irradiance), ""));
    const double incident = std::stod(irradiance);
    EXPECT_NEAR(found["bands"][0]["incident"].get<double>() / incident, 1.0, 1e-9);
    EXPECT_NEAR(found["bands"][0]["absorbed_vegetation"].get<double>() / incident, 0.25, 3e-3);
    const Table organs(file("organs.csv"));
    EXPECT_NEAR(organs.number(0, "PAR_absorbed") / incident, 1.0, 0.012);
  }
}

TEST_F(ExtremeScenes, PlotsOfAnySize) {
  for (const double size_m : {1e-6, 0.01, 1000.0, 1e6}) {
    size_dependent_ = fmt::format("{}", 0.004 * size_m);
    const auto found = run_and_draw(scene(size_m, high_sun, one_band, ""));
    EXPECT_NEAR(found["plot_area_m2"].get<double>() / (size_m * size_m), 1.0, 1e-9);
    EXPECT_NEAR(found["bands"][0]["absorbed_vegetation"].get<double>(), 0.25, 3e-3) << size_m;
    EXPECT_NEAR(found["leaf_area_index"].get<double>(), 0.25, 1e-6);
    const Table profile(file("profile.csv"));
    EXPECT_NEAR(profile.number(0, "sunfleck_ratio"), 0.75, 3e-3);
  }
}

TEST_F(ExtremeScenes, SunsOnEveryAxisAndAtEveryHeight) {
  for (const double elevation : {90.0, 89.9999, 1.0, 0.1}) {
    for (const double azimuth : {0.0, 90.0, 180.0, 270.0, 360.0, -90.0}) {
      folder_.write("scene.toml",
                    scene(1.0, fmt::format("[sun]\nelevation = {:.6f}\nazimuth = {:.1f}", elevation, azimuth), one_band, ""));
      simulate("scene.toml", {"--device", "cpu", "--images", "none", "--grid", "0.008", "--passes", "8"});
      EXPECT_NEAR(summary()["bands"][0]["absorbed_vegetation"].get<double>(), 0.25, 0.01) << elevation << ' ' << azimuth;
      EXPECT_EQ(summary()["lost_rays"], 0);
    }
  }
}

TEST_F(ExtremeScenes, BeyondTheEndsIsRefused) {
  expect_refused(scene(1e-7, high_sun, one_band, ""), {}, "plot.size");
  expect_refused(scene(2e6, high_sun, one_band, ""), {}, "plot.size");
  expect_refused(scene(1.0, high_sun, "[[band]]\nname = \"PAR\"\ndirect = 1e16", ""), {}, "direct");
  expect_refused(scene(1.0, "[sun]\nelevation = 90.001\nazimuth = 0.0", one_band, ""), {}, "elevation");
  expect_refused(scene(1.0, high_sun, one_band, "at = [[2e7, 0.0, 0.0]]"), {}, "at");
  std::string wide = scene(1.0, high_sun, one_band, "");
  expect_refused(wide.replace(wide.find("scale = 1"), 9, "scale = 1e6"), {}, "plot.size");  // needs over half a million periods
  std::string fine = scene(1.0, high_sun, one_band, "");
  expect_refused(fine.replace(fine.find("patch = 0.05"), 12, "patch = 1e-6"), {}, "patch");
  expect_refused(scene(1.0, high_sun, one_band, ""), {"--grid", "1e-9"}, "--grid");
  expect_refused(scene(1.0, high_sun, one_band, ""), {"--passes", "65537"}, "--passes");
}

// A plot that is long and narrow has soil patches much finer than its length.
TEST_F(ExtremeScenes, FinePatchesOfALongPlot) {
  std::string text = scene(1.0, high_sun, one_band, "");
  text.replace(text.find("size = [1, 1]"), 13, "size = [100.0, 1.0]");
  text.replace(text.find("patch = 0.05"), 12, "patch = 0.005");
  size_dependent_ = "0.05";
  EXPECT_NEAR(run_and_draw(text)["bands"][0]["absorbed_vegetation"].get<double>(), 0.0025, 0.0025);
}

}  // namespace
}  // namespace sunfleck::regression
