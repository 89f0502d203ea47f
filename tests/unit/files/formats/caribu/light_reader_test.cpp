// Tests the reader of CARIBU's lists of light directions.

#include "files/formats/caribu/light_reader.h"

#include "physics/light/sky.h"
#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

std::string lights_refusal(const std::filesystem::path& file) {
  const std::string message = refusal_of([&] { static_cast<void>(read_lights(file)); });
  expect_three_parts(message);
  return message.substr(file.parent_path().string().size() + 1);
}

TEST(LightReader, TurnsTheAxesAndTheDirection) {
  const TempFolder folder;
  // The lights come from the zenith, from the east (travelling west, 45 degrees) and from the north, with vectors of any
  // length.
  const auto lights = read_lights(folder.write("x.light", "# a comment\n1 0 0 -1\r\n\n 0.5 -1 0 -1\t# east\n2e-1 0 -30 -40"));
  ASSERT_EQ(lights.size(), 3U);
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(glm::distance(lights[0].to_sky, glm::dvec3(0, 1, 0)), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(lights[1].to_sky, glm::dvec3(0, half, -half)), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(lights[2].to_sky, glm::dvec3(-0.6, 0.8, 0)), 0.0, 1e-15);
  EXPECT_EQ(lights[0].weight, 1.0);
  EXPECT_EQ(lights[1].weight, 0.5);
  EXPECT_EQ(lights[2].weight, 0.2);
}

TEST(LightReader, WeightsAreSharesOfTheHorizontalIrradiance) {
  const TempFolder folder;
  const SkyModel model{SkyKind::lights, 1, 0, 0, read_lights(folder.write("x.light", "3 0 0 -2\n1 0.8 0 -0.6\n"))};
  const Sky sky(model, {});
  EXPECT_NEAR(sky.spherical_irradiance(), 0.75 + 0.25 / 0.6, 1e-12);
}

TEST(LightReader, ExtremeLengthsKeepTheirDirection) {
  const TempFolder folder;
  const auto lights = read_lights(folder.write("x.light", "1 3e300 0 -4e300\n1 3e-300 0 -4e-300\n"));
  EXPECT_NEAR(lights[0].to_sky.y, 0.8, 1e-15);
  EXPECT_NEAR(lights[1].to_sky.y, 0.8, 1e-15);
}

TEST(LightReader, RefusesWithFileAndLine) {
  const TempFolder folder;
  const auto refused = [&](std::string_view text) { return lights_refusal(folder.write("x.light", text)); };
  EXPECT_EQ(refused(""), "x.light: no directions (a sky needs at least one); write: weight dx dy dz");
  EXPECT_TRUE(refused("# only\n\n").starts_with("x.light: no direction"));
  EXPECT_EQ(refused("1 0 0 -1\n1 0 0 1\n"), "x.light:2: direction 0 0 1 (light must travel downwards, dz < 0); reverse it");
  EXPECT_TRUE(refused("1 1 0 0\n").starts_with("x.light:1: direction 1 0 0 ("));
  EXPECT_TRUE(refused("1 1 0 -1e-9\n").starts_with("x.light:1: direction 1 0 -1e-09 ("));
  EXPECT_TRUE(refused("1 0 0 0\n").starts_with("x.light:1: direction 0 0 0 ("));
  EXPECT_TRUE(refused("\n1 nan 0 -1\n").starts_with("x.light:2: dx = 'nan' ("));
  EXPECT_TRUE(refused("inf 0 0 -1\n").starts_with("x.light:1: weight = 'inf' ("));
  EXPECT_TRUE(refused("1 0 0 -1x\n").starts_with("x.light:1: dz = '-1x' ("));
  EXPECT_TRUE(refused("1 0 0\n").starts_with("x.light:1: dz is missing ("));
  EXPECT_TRUE(refused("1 0 0 -1 5\n").starts_with("x.light:1: '5' after dz ("));
  EXPECT_TRUE(refused("-1 0 0 -1\n").starts_with("x.light:1: weight = -1 ("));
  EXPECT_TRUE(refused("0 0 0 -1\n0 1 0 -1\n").starts_with("x.light: all weights are 0 ("));
  EXPECT_TRUE(lights_refusal(folder / "none.light").starts_with("none.light: cannot be read ("));
}

TEST(LightReader, RefusesMoreThanAHundredThousand) {
  const TempFolder folder;
  std::string text;
  for (std::size_t i = 0; i < most_lights; ++i) text += "1 0 0 -1\n";
  EXPECT_EQ(read_lights(folder.write("full.light", text)).size(), most_lights);
  EXPECT_TRUE(
      lights_refusal(folder.write("more.light", text + "1 0 0 -1\n")).starts_with("more.light:100001: too many directions"));
}

}  // namespace
}  // namespace sunfleck
