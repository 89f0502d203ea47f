// Tests [sky], [weather] and the light that bands take from them.

#include "files/scene/moment_light.h"
#include "files/scene/scene_reader.h"
#include "support/scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sunfleck {
namespace {

const std::string angles = "[sun]\nelevation = 30\nazimuth = 120\n";
const std::string uniform = "[sky]\nmodel = \"uniform\"\n";

std::string epw_of_one_value() {
  std::string text = "LOCATION,Beijing,-,CHN,-,-,39.80,116.47,8.0,31.3\n-\n-\n-\n-\n-\n-\nDATA PERIODS,1,1\n";
  constexpr int days_in[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  for (int month = 1; month <= 12; ++month)
    for (int day = 1; day <= days_in[month - 1]; ++day)
      for (int hour = 1; hour <= 24; ++hour)
        text += fmt::format("1999,{},{},{},60,-,0,0,0,0,0,0,0,{}\n", month, day, hour,
                            hour >= 10 && hour <= 15 ? "500,400,100" : "0,0,0");
  return text;
}

using SceneSky = SceneFolder;

TEST_F(SceneSky, NamesItsModel) {
  const auto sky = [&](const std::string& lines) {
    return *read(plot_table + angles + par_table + "[sky]\n" + lines).model.sky;
  };
  EXPECT_EQ(sky("model = \"uniform\"").kind, SkyKind::uniform);
  EXPECT_EQ(sky("model = \"cie-overcast\"").kind, SkyKind::overcast);
  EXPECT_EQ(sky("model = \"cie-clear\"").kind, SkyKind::general);
  EXPECT_EQ(sky("model = \"cie-clear\"").cie_type, 12);
  EXPECT_EQ(sky("model = \"cie\"\ntype = 7").kind, SkyKind::general);
  EXPECT_EQ(sky("model = \"cie\"\ntype = 7").cie_type, 7);
  const SkyModel perez = sky("model = \"perez\"\ndni = 0.0\ndhi = 300");
  EXPECT_EQ(perez.kind, SkyKind::all_weather);
  EXPECT_EQ(perez.dni_w_m2, 0.0);
  EXPECT_EQ(perez.dhi_w_m2, 300.0);
  write(folder_ / "two.light", "0.75 0 0 -1\n0.25 -1 0 -1\n");
  const SkyModel lights = sky("model = \"lights\"\nfile = \"two.light\"");
  EXPECT_EQ(lights.kind, SkyKind::lights);
  ASSERT_EQ(lights.lights.size(), 2U);
  EXPECT_EQ(lights.lights[0].weight, 0.75);
  EXPECT_FALSE(read(plot_table + par_table).model.sky);
}

TEST_F(SceneSky, RefusesWhatIsNoSky) {
  const std::string head = plot_table + angles + par_table + "[sky]\n";
  expect_refused(head, "[sky]", "sky.model", "add model");
  expect_refused(head + "model = \"overcast\"\n", "model", "sky.model = \"overcast\"", "must be one of uniform, cie-overcast");
  expect_refused(head + "model = \"cie-clera\"\n", "model", "sky.model", "did you mean cie-clear?");
  expect_refused(head + "model = \"cie\"\n", "[sky]", "sky.type", "add type");
  expect_refused(head + "model = \"cie\"\ntype = 0\n", "type", "sky.type = 0", "1..15");
  expect_refused(head + "model = \"cie\"\ntype = 16\n", "type", "sky.type = 16", "1..15");
  expect_refused(head + "model = \"cie-clear\"\ntype = 12\n", "type", "sky.type", "model = \"cie\"");
  expect_refused(head + "model = \"uniform\"\ndhi = 3\n", "dhi", "sky.dhi", "model = \"perez\"");
  expect_refused(head + "model = \"uniform\"\nfile = \"a.light\"\n", "file", "sky.file", "model = \"lights\"");
  expect_refused(head + "model = \"perez\"\n", "model", "sky.model", "add dni and dhi in W m-2, or [weather]");
  expect_refused(head + "model = \"perez\"\ndni = 500\n", "[sky]", "sky.dhi", "add dhi");
  expect_refused(head + "model = \"perez\"\ndhi = 500\n", "[sky]", "sky.dni", "add dni");
  expect_refused(head + "model = \"perez\"\ndni = 500\ndhi = 0\n", "dhi", "sky.dhi = 0", "above 0");
  expect_refused(head + "model = \"perez\"\ndni = -1\ndhi = 9\n", "dni", "sky.dni = -1", "0..3000");
  expect_refused(head + "model = \"lights\"\n", "[sky]", "sky.file", "add file");
  expect_refused(head + "model = \"lights\"\nfile = \"no.light\"\n", "file", "sky.file", "no such file");
  expect_refused(head + "modle = \"uniform\"\n", "modle", "sky.modle", "did you mean model?");
  write(folder_.path().parent_path() / "sunfleck_outside.light", "1 0 0 -1\n");
  const std::string outside = head + "model = \"lights\"\nfile = \"../sunfleck_outside.light\"\n";
  expect_refused(outside, "file", "sky.file", "--allow-outside");
  EXPECT_EQ(read(outside, {.allow_outside = true}).model.sky->lights.size(), 1U);
  std::filesystem::remove(folder_.path().parent_path() / "sunfleck_outside.light");
  write(folder_ / "bad.light", "1 0 0 -1\n1 0 0 1\n");
  expect_refusal([&] { static_cast<void>(read(head + "model = \"lights\"\nfile = \"bad.light\"\n")); }, "bad.light:2: ");
}

TEST_F(SceneSky, SomeSkiesNeedASun) {
  const std::string head = plot_table + par_table + "[sky]\n";
  for (int type = 1; type <= 15; ++type) {
    const std::string text = head + fmt::format("model = \"cie\"\ntype = {}\n", type);
    if (type == 1 || type == 3 || type == 5) {
      EXPECT_EQ(read(text).model.sky->cie_type, type);
    } else {
      expect_refused(text, "type", "sky.type", "there is no [sun]");
    }
  }
  expect_refused(head + "model = \"cie-clear\"\n", "model", "sky.model", "add [sun]");
  expect_refused(head + "model = \"perez\"\ndni = 1\ndhi = 9\n", "model", "sky.model", "add [sun]");
  EXPECT_TRUE(read(head + "model = \"cie-overcast\"\n").model.sky);
  // A sun below the horizon still counts as a sun.
  EXPECT_TRUE(
      read(plot_table + "[sun]\nelevation = -3\nazimuth = 0\n" + par_table + "[sky]\nmodel = \"cie-clear\"\n").model.sky);
}

TEST_F(SceneSky, BandsTakeTheirDiffuseLightFromIt) {
  const Scene scene =
      read(plot_table + uniform + par_table + "diffuse = 60\numol_per_joule = 4.57\n[[band]]\nname = \"NIR\"\n");
  EXPECT_EQ(scene.model.bands[0].diffuse_w_m2, 60.0);
  EXPECT_EQ(scene.model.bands[0].direct_w_m2, 0.0);
  EXPECT_EQ(scene.model.bands[0].umol_per_joule, 4.57);
  EXPECT_EQ(scene.model.bands[1].diffuse_w_m2, 0.0);
  EXPECT_EQ(scene.model.bands[1].umol_per_joule, 0.0);
  EXPECT_FALSE(scene.model.sun);
  expect_refused(plot_table + par_table + "diffuse = 60\n", "diffuse", "band.diffuse = 60", "add [sky]");
  EXPECT_EQ(read(plot_table + par_table + "diffuse = 0\ndirect = 0\n").model.bands[0].diffuse_w_m2, 0.0);
}

TEST_F(SceneSky, WeatherIsSplitAndShared) {
  const std::string ghi = plot_table + moment_table + uniform + "[weather]\nghi = 800\n";
  // In the E5 example: 310.19 and 89.82 W m-2, half of the split global irradiance.
  const Scene scene = read(ghi + par_table);
  EXPECT_NEAR(scene.model.bands[0].direct_w_m2, 310.19, 0.01);
  EXPECT_NEAR(scene.model.bands[0].diffuse_w_m2, 89.82, 0.01);
  EXPECT_TRUE(scene.warnings.empty());
  const Scene shares =
      read(ghi + par_table + "share = 0.4\n[[band]]\nname = \"NIR\"\nshare = 0\n[[band]]\nname = \"LAMP\"\ndiffuse = 7\n");
  EXPECT_NEAR(shares.model.bands[0].direct_w_m2 + shares.model.bands[0].diffuse_w_m2, 320.0, 1e-10);
  EXPECT_EQ(shares.model.bands[1].direct_w_m2 + shares.model.bands[1].diffuse_w_m2, 0.0);
  EXPECT_EQ(shares.model.bands[2].direct_w_m2, 0.0);
  EXPECT_EQ(shares.model.bands[2].diffuse_w_m2, 7.0);
  ASSERT_EQ(shares.warnings.size(), 1U);
  EXPECT_NE(shares.warnings[0].find("it has its own irradiance"), std::string::npos) << shares.warnings[0];
  const SunPosition sun = *scene.model.sun;
  const Scene erbs = read(plot_table + moment_table + uniform + "[weather]\nghi = 800\nsplit = \"erbs\"\n" + par_table);
  EXPECT_NEAR(erbs.model.bands[0].diffuse_w_m2, 400.0 * erbs_diffuse_share(800.0, sun, 220), 1e-10);
  const Scene parts = read(plot_table + angles + uniform + "[weather]\ndni = 600\ndhi = 90\n" + par_table);
  const Scene rest = read(plot_table + angles + uniform + "[weather]\nghi = 500\ndhi = 90\n" + par_table);
  EXPECT_TRUE(rest.warnings.empty());
  EXPECT_NEAR(rest.model.bands[0].direct_w_m2, 0.5 * 410.0, 1e-9);
  EXPECT_NEAR(rest.model.bands[0].diffuse_w_m2, 0.5 * 90.0, 1e-9);
  EXPECT_NEAR(parts.model.bands[0].direct_w_m2, 150.0, 1e-10);
  EXPECT_EQ(parts.model.bands[0].diffuse_w_m2, 45.0);
  EXPECT_TRUE(parts.warnings.empty());
  const Scene clear = read(plot_table + moment_table + uniform +
                           "[weather]\nclear_sky = \"ineichen\"\nlinke_turbidity = 4.5\naltitude = 1200\n" + par_table);
  const Broadband sky = clear_sky({4.5, 1200.0}, sun, 220);
  EXPECT_NEAR(clear.model.bands[0].direct_w_m2, 0.5 * sky.direct_horizontal_w_m2(sun), 1e-10);
  EXPECT_NEAR(clear.model.bands[0].diffuse_w_m2, 0.5 * sky.diffuse_w_m2, 1e-10);
}

TEST_F(SceneSky, WithoutADateTheMeanDistanceCountsAndIsSaid) {
  for (const char* weather : {"ghi = 800\n", "clear_sky = \"ineichen\"\n"}) {
    const Scene scene = read(plot_table + angles + uniform + "[weather]\n" + weather + par_table);
    ASSERT_EQ(scene.warnings.size(), 1U) << weather;
    EXPECT_NE(scene.warnings[0].find("scene.toml:8: weather"), std::string::npos) << scene.warnings[0];
    EXPECT_NE(scene.warnings[0].find("mean distance"), std::string::npos) << scene.warnings[0];
  }
  EXPECT_NEAR(read(plot_table + angles + uniform + "[weather]\nghi = 400\n" + par_table).model.bands[0].diffuse_w_m2,
              200.0 * spitters_diffuse_share(400.0, {0.5235987755982988, 0.0}, {}), 1e-9);
}

TEST_F(SceneSky, WeatherComesFromItsFile) {
  const std::string head = plot_table + moment_table + uniform + "[weather]\nfile = \"station.csv\"\n" + par_table;
  const Scene scene = read(head);
  EXPECT_NEAR(scene.model.bands[0].direct_w_m2 + scene.model.bands[0].diffuse_w_m2, 200.0, 1e-10);
  EXPECT_NEAR(scene.model.bands[0].diffuse_w_m2, 200.0 * 0.84684, 2e-3);
  const std::string digest = scene.digest;
  write(folder_ / "station.csv", replaced(station_csv, "400", "410"));
  EXPECT_NE(read(head).digest, digest);
  write(folder_ / "year.epw", epw_of_one_value());
  const Scene year = read(replaced(head, "station.csv", "year.epw"));
  EXPECT_NEAR(year.model.bands[0].direct_w_m2, 0.5 * 400.0 * std::sin(year.model.sun->elevation_rad), 1e-10);
  EXPECT_EQ(year.model.bands[0].diffuse_w_m2, 50.0);
  ASSERT_EQ(year.warnings.size(), 1U);
  EXPECT_NE(year.warnings[0].find("holds month 8 of 1999, not of 2002"), std::string::npos) << year.warnings[0];
  const Scene far = read(replaced(replaced(head, "station.csv", "year.epw"), "116.28", "10"));
  // It is also night there, with light in the weather and too much of it at dawn, and not where the clock is.
  ASSERT_EQ(far.warnings.size(), 6U);
  EXPECT_NE(far.warnings[1].find("km from the place in [sun]"), std::string::npos) << far.warnings[1];
}

TEST_F(SceneSky, RefusesWhatIsNoWeather) {
  const std::string head = plot_table + moment_table + uniform + par_table + "[weather]\n";
  expect_refused(head, "[weather]", "weather", "add ghi");
  expect_refused(head + "ghi = -1\n", "ghi", "weather.ghi = -1", "0..3000");
  expect_refused(head + "ghi = 80000\n", "ghi", "weather.ghi", "0..3000");
  expect_refused(head + "ghi = nan\n", "ghi", "weather.ghi", "0..3000");
  expect_refused(head + "dni = 600\n", "[weather]", "weather.dhi", "add dhi");
  expect_refused(head + "dhi = 600\n", "[weather]", "weather.dni", "add dni");
  expect_refused(head + "ghi = 600\ndni = 60\n", "dni", "weather.dni", "ghi is also given");
  expect_refused(head + "ghi = 600\ndhi = 60\nsplit = \"erbs\"\n", "split", "weather.split", "nothing to split");
  expect_refused(head + "ghi = 600\nutc_offset = \"+08:00\"\n", "utc_offset", "weather.utc_offset",
                 "only for the times of a file");
  expect_refused(head + "file = \"station.csv\"\nutc_offset = \"8\"\n", "utc_offset", "weather.utc_offset", "write it as");
  expect_refused(head + "dni = 600\ndhi = 60\nsplit = \"erbs\"\n", "split", "weather.split", "nothing to split");
  expect_refused(head + "clear_sky = \"ineichen\"\nsplit = \"erbs\"\n", "split", "weather.split", "nothing to split");
  expect_refused(head + "ghi = 600\nsplit = \"reindl\"\n", "split", "weather.split", "one of spitters, erbs");
  expect_refused(head + "clear_sky = \"bird\"\n", "clear_sky", "weather.clear_sky", "one of ineichen");
  expect_refused(head + "clear_sky = \"ineichen\"\nghi = 3\n", "ghi", "weather.ghi", "clear_sky is also given");
  expect_refused(head + "clear_sky = \"ineichen\"\nlinke_turbidity = 0.5\n", "linke", "weather.linke_turbidity", "1..20");
  expect_refused(head + "clear_sky = \"ineichen\"\naltitude = 1e5\n", "altitude", "weather.altitude", "metres above sea");
  expect_refused(head + "ghi = 600\nlinke_turbidity = 3\n", "linke", "weather.linke_turbidity", "it is only for clear_sky");
  expect_refused(head + "ghi = 600\naltitude = 3\n", "altitude", "weather.altitude", "it is only for clear_sky");
  expect_refused(head + "file = \"station.csv\"\nghi = 600\n", "ghi", "weather.ghi", "a file is also given");
  expect_refused(head + "file = \"no.csv\"\n", "file", "weather.file", "no such file");
  expect_refused(head + "file = \"scene.toml\"\n", "file", "weather.file", ".csv or .epw");
  expect_refused(head + "file = \".\"\n", "file", "weather.file", "name a .csv or .epw file");
  expect_refused(head + "file = \"/etc/passwd\"\n", "file", "weather.file", "--allow-outside");
  expect_refused(head + "turbidity = 3\n", "turbidity", "weather.turbidity", "remove it, or use one of");
  expect_refused(plot_table + uniform + par_table + "[weather]\nghi = 3\n", "[weather]", "weather", "add [sun]");
  expect_refused(plot_table + angles + uniform + par_table + "[weather]\nfile = \"station.csv\"\n", "file", "weather.file",
                 "[sun] has no time");
}

TEST_F(SceneSky, RefusesWeatherThatDoesNotHoldTheMoment) {
  const std::string text = plot_table + moment_table + uniform + par_table + "[weather]\nfile = \"station.csv\"\n";
  const std::string late = replaced(text, "T10:10", "T10:30");
  const std::string message = expect_refusal([&] { static_cast<void>(read(late)); });
  EXPECT_TRUE(message.starts_with("weather at 2002-08-08T10:30:00+08:00 (station.csv covers 2002-08-08T10:00:00+08:00 to "))
      << message;
  // For a day the scene's own moment does not matter.
  EXPECT_FALSE(message_of([&] { static_cast<void>(read(late, {.purpose = ScenePurpose::day})); }));
}

TEST_F(SceneSky, RefusesBandsAtOddsWithTheWeather) {
  const std::string head = plot_table + moment_table + uniform + "[weather]\nghi = 800\n" + par_table + "share = 0.5\n";
  expect_refused(head + "direct = 3\n", "direct", "band.direct", "share is also given");
  expect_refused(head + "direct = 0\n", "direct", "band.direct", "share is also given");
  expect_refused(head + "direct_normal = 3\n", "direct_normal", "band.direct_normal", "share is also given");
  expect_refused(head + "diffuse = 3\n", "diffuse", "band.diffuse", "share is also given");
  expect_refused(replaced(head, "0.5", "1.5"), "share", "band.share = 1.5", "percent");
  expect_refused(plot_table + moment_table + "[weather]\nghi = 800\n" + par_table, "[weather]", "weather", "add [sky]");
  expect_refused(plot_table + moment_table + "[weather]\ndni = 800\ndhi = 1\n" + par_table, "[weather]", "weather",
                 "add [sky]");
  EXPECT_EQ(read(plot_table + angles + "[weather]\ndni = 800\ndhi = 0\n" + par_table).model.bands[0].diffuse_w_m2, 0.0);
}

TEST_F(SceneSky, PerezTakesTheWeathersParts) {
  const std::string perez = "[sky]\nmodel = \"perez\"\n";
  const Scene scene = read(plot_table + moment_table + perez + "[weather]\nghi = 800\n" + par_table);
  const Broadband parts = split_global(800.0, SplitRule::spitters, *scene.model.sun, 220);
  EXPECT_DOUBLE_EQ(scene.model.sky->dni_w_m2, parts.direct_normal_w_m2);
  EXPECT_DOUBLE_EQ(scene.model.sky->dhi_w_m2, parts.diffuse_w_m2);
  const Scene own = read(plot_table + moment_table + perez + "dni = 1\ndhi = 2\n[weather]\nghi = 800\n" + par_table);
  EXPECT_EQ(own.model.sky->dni_w_m2, 1.0);
  EXPECT_EQ(own.model.sky->dhi_w_m2, 2.0);
  const Scene dark = read(plot_table + moment_table + perez + "[weather]\nghi = 0\n" + par_table);
  EXPECT_GT(dark.model.sky->dhi_w_m2, 0.0);
  EXPECT_EQ(dark.model.bands[0].diffuse_w_m2, 0.0);
}

}  // namespace
}  // namespace sunfleck
