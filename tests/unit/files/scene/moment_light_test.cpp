#include "files/scene/moment_light.h"

#include "support/scene_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sunfleck {
namespace {

const std::string perez_table = "[sky]\nmodel = \"perez\"\n";
const std::string clear_table = "[weather]\nclear_sky = \"ineichen\"\n";

using MomentLightTest = SceneFolder;

TEST_F(MomentLightTest, IsTheScenesOwnAtItsMoment) {
  for (const std::string& text :
       {lit_scene, plot_table + moment_table + perez_table + clear_table + par_table,
        plot_table + moment_table + par_table + "direct = 350\n",
        plot_table + moment_table + par_table + "direct_normal = 350\ndiffuse = 3\n[sky]\nmodel = \"uniform\"\n"}) {
    const Scene scene = read(text);
    const MomentLight light = light_of_step(scene, scene.moment->time, 0.0);  // an interval begins there
    EXPECT_EQ(light.sun.elevation_rad, scene.model.sun->elevation_rad);
    ASSERT_EQ(light.bands.size(), scene.model.bands.size());
    for (std::size_t b = 0; b < light.bands.size(); ++b) {
      EXPECT_EQ(light.bands[b].name, scene.model.bands[b].name);
      EXPECT_EQ(light.bands[b].direct_w_m2, scene.model.bands[b].direct_w_m2);
      EXPECT_EQ(light.bands[b].diffuse_w_m2, scene.model.bands[b].diffuse_w_m2);
      EXPECT_EQ(light.bands[b].umol_per_joule, scene.model.bands[b].umol_per_joule);
    }
    ASSERT_EQ(light.sky.has_value(), scene.model.sky.has_value());
    if (light.sky) {
      EXPECT_EQ(light.sky->dni_w_m2, scene.model.sky->dni_w_m2);
      EXPECT_EQ(light.sky->dhi_w_m2, scene.model.sky->dhi_w_m2);
    }
  }
}

TEST_F(MomentLightTest, FollowsSunAndWeather) {
  const Scene scene = read(plot_table + moment_table + perez_table + clear_table + par_table +
                           "[[band]]\nname = \"B\"\ndirect_normal = 100\ndiffuse = 5\n");
  double last_w_m2 = 0.0;
  for (const int hour : {22, 23}) {  // 6 and 7 o'clock local time
    const UtcTime time{2002, 8, 7, hour};
    const MomentLight light = light_of_step(scene, time, 600.0);
    EXPECT_EQ(light.sun.elevation_rad, sun_position(time, scene.moment->place).elevation_rad);
    const Broadband broadband = clear_sky({}, light.sun, 219);
    EXPECT_NEAR(light.bands[0].direct_w_m2, 0.5 * broadband.direct_horizontal_w_m2(light.sun), 1e-10);
    EXPECT_NEAR(light.bands[0].diffuse_w_m2, 0.5 * broadband.diffuse_w_m2, 1e-10);
    EXPECT_NEAR(light.bands[1].direct_w_m2, 100.0 * std::sin(light.sun.elevation_rad), 1e-10);
    EXPECT_EQ(light.bands[1].diffuse_w_m2, 5.0);
    EXPECT_EQ(light.sky->dni_w_m2, broadband.direct_normal_w_m2);
    EXPECT_GT(light.bands[0].direct_w_m2, last_w_m2);
    last_w_m2 = light.bands[0].direct_w_m2;
  }
}

TEST_F(MomentLightTest, NightHasNoBeam) {
  const Scene scene =
      read(plot_table + moment_table + perez_table + clear_table + par_table +
           "[[band]]\nname = \"B\"\ndirect_normal = 100\ndiffuse = 5\n" + "[[band]]\nname = \"C\"\ndirect = 100\n");
  const MomentLight night = light_of_step(scene, {2002, 8, 7, 17}, 600.0);
  EXPECT_LT(night.sun.elevation_rad, 0.0);
  for (const Waveband& band : night.bands) EXPECT_EQ(band.direct_w_m2, 0.0);
  EXPECT_EQ(night.bands[0].diffuse_w_m2, 0.0);
  EXPECT_EQ(night.bands[1].diffuse_w_m2, 5.0);
  EXPECT_GT(night.sky->dhi_w_m2, 0.0);
}

TEST_F(MomentLightTest, MeasuredTwilightIsDiffuse) {
  write(folder_ / "station.csv", "time,ghi\n2002-08-07T17:00Z,4\n2002-08-07T18:00Z,0\n");
  const Scene scene = read(plot_table + moment_table + perez_table + "[weather]\nfile = \"station.csv\"\n" + par_table,
                           {.purpose = ScenePurpose::day});
  EXPECT_EQ(scene.model.bands[0].diffuse_w_m2, 0.0);
  EXPECT_EQ(light_of_step(scene, {2002, 8, 7, 17, 30}, 3600.0).bands[0].diffuse_w_m2, 2.0);
  EXPECT_TRUE(message_of([&] { static_cast<void>(light_of_step(scene, {2002, 8, 7, 19, 0}, 3600.0)); }));
}

TEST_F(MomentLightTest, ALongStepHasTheMeanOfItsRecords) {
  std::string station = "time,ghi\n";
  for (int i = 0; i < 6; ++i) station += "2002-08-07T17:" + std::to_string(i) + "0Z," + std::to_string(i + 1) + "\n";
  write(folder_ / "station.csv", station);
  const Scene scene = read(plot_table + moment_table + perez_table + "[weather]\nfile = \"station.csv\"\n" + par_table,
                           {.purpose = ScenePurpose::day});
  EXPECT_EQ(light_of_step(scene, {2002, 8, 7, 17, 25}, 600.0).bands[0].diffuse_w_m2, 1.5);
  const MomentLight hour = light_of_step(scene, {2002, 8, 7, 17, 30}, 3600.0);
  EXPECT_NEAR(hour.bands[0].diffuse_w_m2, 1.75, 1e-9);
  EXPECT_NEAR(hour.sky->dhi_w_m2, 3.5, 1e-9);
}

class DayRules : public SceneFolder {
 protected:
  [[nodiscard]] std::optional<std::string> refusal(const std::string& text) const {
    const Scene scene = read(text, {.purpose = ScenePurpose::day});
    auto message = message_of([&] { check_day(scene); });
    if (message) expect_three_parts(*message);
    return message;
  }
  void expect_refused(const std::string& text, const std::string& place, const std::string& hint) const {
    const auto message = refusal(text);
    ASSERT_TRUE(message) << text;
    EXPECT_TRUE(message->starts_with(file().string() + place)) << *message;
    EXPECT_NE(message->find(hint), std::string::npos) << *message;
  }
};

TEST_F(DayRules, ADayNeedsLightThatFollowsIt) {
  const std::string uniform = "[sky]\nmodel = \"uniform\"\n";
  EXPECT_EQ(refusal(lit_scene), std::nullopt);
  EXPECT_EQ(refusal(plot_table + moment_table + par_table + "direct_normal = 300\n"), std::nullopt);
  EXPECT_EQ(refusal(plot_table + moment_table + par_table + "direct_normal = 300\n[[band]]\nname = \"B\"\ndirect = 0\n"),
            std::nullopt);
  EXPECT_EQ(refusal(plot_table + moment_table + perez_table + clear_table + par_table), std::nullopt);
  EXPECT_EQ(refusal(plot_table + moment_table + uniform + "[weather]\ndni = 600\ndhi = 90\n" + par_table), std::nullopt);
  EXPECT_EQ(refusal(plot_table + moment_table + uniform + "[weather]\nfile = \"station.csv\"\n" + par_table), std::nullopt);
  expect_refused(plot_table + moment_table + par_table + "direct = 300\n", ":9: band.direct", "give direct_normal");
  expect_refused(plot_table + moment_table + perez_table + clear_table + par_table + "[[band]]\nname = \"B\"\ndirect = 300\n",
                 ":15: band.direct", "or [weather]");
  expect_refused(plot_table + moment_table + uniform + par_table + "diffuse = 300\n", ": band",
                 "add [weather], or direct_normal");
  expect_refused(plot_table + moment_table + uniform + "[weather]\nghi = 600\n" + par_table, ":9: weather", "clear_sky");
  expect_refused(plot_table + "[sun]\nelevation = 30\nazimuth = 9\n" + par_table + "direct_normal = 300\n", ": sun",
                 "latitude");
  expect_refused(plot_table + uniform + par_table + "diffuse = 300\n", ": sun", "latitude");
}

TEST_F(DayRules, TheScenesOwnNightIsNotSaid) {
  const std::string text = replaced(plot_table + moment_table + par_table + "direct_normal = 300\n", "T10:10", "T01:10");
  EXPECT_EQ(read(text).warnings.size(), 1U);
  EXPECT_TRUE(read(text, {.purpose = ScenePurpose::day}).warnings.empty());
}

}  // namespace
}  // namespace sunfleck
