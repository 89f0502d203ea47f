// Tests small scene files that ask for a great deal: each limit must act before memory or time is spent.

#include "support/scene_text.h"

#include <fmt/format.h>

#include <ctime>

namespace sunfleck {
namespace {

class SceneLimits : public SceneFolder {
 protected:
  void expect_refused(const std::string& text, std::string_view words) const {
    const std::string message = expect_refusal([&] { static_cast<void>(read(text)); }, words);
    EXPECT_LT(message.size(), 1000U) << "a message is to be read";
  }
  static constexpr const char* leaf_ = "[optics.leaf]\nreflectance = 0.1\n[optics.bark]\nreflectance = 0.1\n";
};

TEST_F(SceneLimits, NestingIsShallow) {
  for (const char* open : {"[", "{a=", "[{a=[", "{a.b.c="}) {
    std::string deep = "x = ";
    for (int i = 0; i < 100'000; ++i) deep += open;
    expect_refused(bare_scene + deep, "not valid TOML");
  }
  std::string dotted = "a";
  for (int i = 0; i < 100'000; ++i) dotted += ".a";
  for (const std::string& key :
       {dotted + " = 1\n", "[" + dotted + "]\n", "[[" + dotted + "]]\n", "x = { " + dotted + " = 1 }\n"})
    expect_refused(bare_scene + key, "dots");
}

TEST_F(SceneLimits, TextsAndKeysAreShort) {
  const std::string longest(4096, 'a');
  EXPECT_EQ(read("title = \"" + longest + "\"\n" + bare_scene).title, longest);
  expect_refused("title = \"" + longest + "a\"\n" + bare_scene, "4096 bytes");
  expect_refused(std::string(1'000'000, 'k') + " = 1\n" + bare_scene, "is not a key");
  expect_refused(bare_scene + "[sky]\nmodel = \"" + std::string(4000, 'u') + "\"\n", "must be one of");
  expect_refused(bare_scene + "[[geometry]]\nfile = \"" + longest + "\"\n", "geometry.file");
}

TEST_F(SceneLimits, MostPlanesSensorsBandsAndLayers) {
  std::string planes, sensors, bands;
  for (int i = 0; i < 65; ++i) planes += fmt::format("[[plane]]\nheight = {}\n", i);
  expect_refused(bare_scene + planes, "but at most 64");
  expect_refused(bare_scene + "[[plane]]\nheight = 1\ncells = [64000000, 2]\n", "cells so far");
  for (int i = 0; i < 2; ++i)
    sensors += fmt::format("[[sensor]]\nname = \"s{}\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\npoints = 60000\n", i);
  expect_refused(bare_scene + sensors, "points so far");
  for (int i = 0; i < 1000; ++i) bands += fmt::format("[[band]]\nname = \"b{}\"\n", i);
  expect_refused(bare_scene + bands, "at most 1000");
  expect_refused(bare_scene + "[output]\nlayers = 10001\n", "1..10000");
  expect_refused(bare_scene + "[soil]\nreflectance = 0.1\npatch = 1e-5\n", "cells on this plot");
}

TEST_F(SceneLimits, CoefficientsOfAllOpticsAndBands) {
  std::string text = bare_scene;
  for (int i = 0; i < 900; ++i) text += fmt::format("[[band]]\nname = \"b{}\"\n", i);
  for (int i = 0; i < 5000; ++i) text += fmt::format("[optics.o{}]\nreflectance = 0\n", i);
  expect_refused(text, "give more than 4000000");
}

// Sensors' names are compared in n log n steps: eight times as many take about nine times as long, not 64 times. The test
// measures processor time, which other programs do not lengthen.
TEST_F(SceneLimits, ManySensorsAreNamedQuickly) {
  const auto spent_on = [this](int count) {
    std::string text = bare_scene;
    for (int i = 0; i < count; ++i) text += fmt::format("[[sensor]]\nname = \"s{}\"\nfrom = [0, 0, 0]\n", i);
    const std::clock_t begin = std::clock();
    EXPECT_EQ(read(text).model.sensors.size(), static_cast<std::size_t>(count));
    return static_cast<double>(std::clock() - begin);
  };
  constexpr int all = 100'000;
  const double few = spent_on(all / 8);
  EXPECT_LT(spent_on(all), 25.0 * few);
}

TEST_F(SceneLimits, PlantsOfAllGenerators) {
  const std::string stand = "[[geometry]]\ngenerator = \"maize\"\nrows = 100\nper_row = 60\n";
  expect_refused(bare_scene + leaf_ + stand + stand, "gives 12000 plants");
}

// Twenty thousand copies of a mesh take a hundred kilobytes of text, and make more triangles than any machine holds.
TEST_F(SceneLimits, CopiesFitIntoMemory) {
  std::string obj = "usemtl leaf\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 40'000; ++i) obj += "f 1 2 3\n";
  write(folder_ / "many.obj", obj);
  std::string at = "at = [[0, 0, 0]";
  for (int i = 1; i < 20'000; ++i) at += ",[0,0,0]";
  std::string text = bare_scene + leaf_;
  for (int i = 0; i < 25; ++i) text += "[[geometry]]\nfile = \"many.obj\"\n" + at + "]\n";
  expect_refused(text, "of memory");
}

TEST_F(SceneLimits, PlantNumbersDoNotWrapRound) {
  write(folder_ / "high.obj", "o plant4294967295_leaf1\nusemtl leaf\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string once = bare_scene + leaf_ + "[[geometry]]\nfile = \"high.obj\"\n";
  EXPECT_EQ(read(once).model.canopy.organs.at(0).plant, 4294967295U);
  expect_refused(once + "at = [[0, 0, 0], [1, 0, 0]]\n", "plant 4294967295");
}

TEST_F(SceneLimits, NegativeZeroIsZero) {
  const Scene scene = read(
      "[plot]\nsize = [1, 1]\nperiodic = false\n[[band]]\nname = \"PAR\"\ndirect = -0.0\n[optics.leaf]\nreflectance = -0.0\n"
      "[optics.bark]\nreflectance = 0\n[[geometry]]\nfile = \"plates.obj\"\noptics = \"bark\"\nat = [[-0.0, -0.0, -0.0]]\n");
  EXPECT_EQ(scene.model.canopy.size(), 2U);
  EXPECT_EQ(scene.model.bands.at(0).direct_w_m2, 0.0);
}

// toml++ 3.3 must not see letters beyond ASCII where it looks for blanks. Texts, quoted keys and comments may contain them.
TEST_F(SceneLimits, LettersBeyondAscii) {
  EXPECT_EQ(read("title = \"Bl\xc3\xa4tter \xf0\x9f\x8c\xbd\" # \xc3\xa4\n" + bare_scene).title,
            "Bl\xc3\xa4tter \xf0\x9f\x8c\xbd");
  EXPECT_EQ(read("title = \"\"\"a \\\n  b\xc3\xa4\"\"\"\n" + bare_scene).title, "a b\xc3\xa4");
  EXPECT_NO_THROW(static_cast<void>(read(bare_scene + "[optics.\"Bl\xc3\xa4tter\"]\nreflectance = 0.1\n")));
  expect_refused(bare_scene + "[optics.Bl\xc3\xa4tter]\nreflectance = 0.1\n", "scene.toml:5: a non-ASCII character");
  expect_refused("title =\xc2\xa0\"a\"\n" + bare_scene, "scene.toml:1: a non-breaking space");
  expect_refused("title = \"\"\"a \\\n  \xc3\xa4\"\"\"\n" + bare_scene, "scene.toml:1: a backslash");
  expect_refused("title = 12\"\xc3\xa4\"\n" + bare_scene, "a quote inside a word");
  expect_refused("title = \"a\"'\xc3\xa4'\n" + bare_scene, "a quote inside a word");
  expect_refused(bare_scene + "\n# \xe4\n", "scene.toml:6: a character that is not UTF-8");
}

}  // namespace
}  // namespace sunfleck
