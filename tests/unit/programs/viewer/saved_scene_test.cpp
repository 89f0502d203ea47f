#include "programs/viewer/saved_scene.h"

#include "base/error.h"
#include "support/live_scene.h"

#include <gtest/gtest.h>

#include <functional>

namespace sunfleck {
namespace {

struct Saved {
  Scene granted, read_again;
};

Saved save_and_read(const TempFolder& folder, const std::string& text, const std::function<void(LightRequest&)>& change) {
  folder.write("leaves.obj", test::live_mesh_text);
  const Scene original = read_scene(folder.write("leaves.toml", text));
  LightRequest request = request_of(original);
  change(request);
  Saved saved{original, {}};
  static_cast<void>(grant(request, original, saved.granted.model));
  saved.granted.title = "Changed";
  std::filesystem::create_directories(folder / "out");
  save_scene({original, request, saved.granted, {0.04, 0.05}, 1}, folder / "out");
  saved.read_again = read_scene(folder / "out" / "scene.toml");
  return saved;
}

void expect_same_light(const Saved& saved) {
  const RadiationModel& expected = saved.granted.model;
  const RadiationModel& read = saved.read_again.model;
  ASSERT_EQ(read.sun.has_value(), expected.sun.has_value());
  if (expected.sun) {
    EXPECT_EQ(read.sun->elevation_rad, expected.sun->elevation_rad);
    EXPECT_EQ(read.sun->azimuth_rad, expected.sun->azimuth_rad);
  }
  ASSERT_EQ(read.sky.has_value(), expected.sky.has_value());
  if (expected.sky) {
    EXPECT_EQ(read.sky->kind, expected.sky->kind);
    EXPECT_EQ(read.sky->dni_w_m2, expected.sky->dni_w_m2);
    EXPECT_EQ(read.sky->dhi_w_m2, expected.sky->dhi_w_m2);
  }
  ASSERT_EQ(read.bands.size(), expected.bands.size());
  for (std::size_t b = 0; b < expected.bands.size(); ++b) {
    EXPECT_EQ(read.bands[b].name, expected.bands[b].name);
    EXPECT_EQ(read.bands[b].direct_w_m2, expected.bands[b].direct_w_m2);
    EXPECT_EQ(read.bands[b].diffuse_w_m2, expected.bands[b].diffuse_w_m2);
    EXPECT_EQ(read.bands[b].umol_per_joule, expected.bands[b].umol_per_joule);
  }
  EXPECT_EQ(read.soil->reflectance, expected.soil->reflectance);
  ASSERT_EQ(read.optics.size(), expected.optics.size());
  for (std::size_t i = 0; i < expected.optics.size(); ++i) {
    for (std::size_t b = 0; b < expected.bands.size(); ++b) {
      EXPECT_EQ(read.optics[i].upper[b].reflectance, expected.optics[i].upper[b].reflectance);
      EXPECT_EQ(read.optics[i].lower[b].transmittance, expected.optics[i].lower[b].transmittance);
    }
  }
  EXPECT_EQ(read.canopy.size(), 3U);
  EXPECT_EQ(saved.read_again.title, "Changed");
  EXPECT_EQ(saved.read_again.accuracy.direct, 0.04);
  EXPECT_EQ(saved.read_again.accuracy.indirect, 0.05);
}

// Returns the live scene with parts of its text replaced.
std::string text_with(std::initializer_list<std::pair<std::string, std::string>> replacements) {
  std::string text = test::live_scene_text;
  for (const auto& [from, to] : replacements) text.replace(text.find(from), from.size(), to);
  return text;
}

const std::string photons = "direct = 300.0\ndiffuse = 60.0";

TEST(SavedScene, GivesTheLightOfTheWindowAgain) {
  const std::vector<std::function<void(LightRequest&)>> changes{
      [](LightRequest&) {},
      [](LightRequest& light) { light.sun.hour = 13.4567; },
      [](LightRequest& light) { light.sun.hour = 24.0; },
      [](LightRequest& light) { light.sun.latitude_deg = -33.3, light.sun.offset_minutes = -210; },
      [](LightRequest& light) { light.sun.by_clock = false, light.sun.elevation_deg = 33.3, light.sun.azimuth_deg = 360.0; },
      [](LightRequest& light) { light.sun.shines = false; },
      [](LightRequest& light) { light.sky.kind = SkyRequestKind::none; },
      [](LightRequest& light) { light.sky.kind = SkyRequestKind::clear; },
      [](LightRequest& light) { light.sky.kind = SkyRequestKind::all_weather, light.sky.dni_w_m2 = 321.0; },
      [](LightRequest& light) {
        light.own_irradiance = true, light.bands[1] = {123.4, 0.3};
      },
      [](LightRequest& light) {
        light.optics[0].upper[1] = {0.31, 0.22};
        light.soil_reflectance[0] = 0.07;
      }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(i);
    const TempFolder folder;
    expect_same_light(save_and_read(folder, test::live_scene_text, changes[i]));
  }
}

TEST(SavedScene, KeepsWeatherPhotonsAndLightWithoutASky) {
  const std::string weather = text_with({{photons, "share = 0.5"},
                                         {"direct = 250.0\ndiffuse = 20.0", "share = 0.4"},
                                         {"[soil]", "[weather]\ndni = 700.0\ndhi = 120.0\n[soil]"},
                                         {"model = \"cie-overcast\"", "model = \"perez\""}});
  const std::string photon = text_with({{photons, "direct = 1300.0\nunit = \"umol_m2_s\""}});
  const std::string no_diffuse = text_with({{"\ndiffuse = 60.0", ""}, {"\ndiffuse = 20.0", ""}});
  const auto later = [](LightRequest& light) { light.sun.hour = 14.2; };
  const auto angles = [](LightRequest& light) { light.sun.by_clock = false, light.sun.elevation_deg = 41.0; };
  const auto uniform = [](LightRequest& light) { light.sky.kind = SkyRequestKind::uniform; };
  for (const std::string& text : {weather, photon, no_diffuse}) {
    for (const std::function<void(LightRequest&)>& change : {std::function<void(LightRequest&)>(later), {angles}, {uniform}}) {
      SCOPED_TRACE(text);
      const TempFolder folder;
      expect_same_light(save_and_read(folder, text, change));
    }
  }
}

TEST(SavedScene, DoesNotReplaceTheSceneThatIsShown) {
  const TempFolder folder;
  folder.write("leaves.obj", test::live_mesh_text);
  const Scene scene = read_scene(folder.write("scene.toml", test::live_scene_text));
  EXPECT_THROW(save_scene({scene, request_of(scene), scene, {}, 1}, folder.path()), Error);
}

}  // namespace
}  // namespace sunfleck
