#include "programs/viewer/light_request.h"

#include "support/live_scene.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

Scene scene_with(const std::string& from, const std::string& to) {
  const TempFolder folder;
  folder.write("leaves.obj", test::live_mesh_text);
  std::string text = test::live_scene_text;
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from)) text.replace(at, from.size(), to);
  return read_scene(folder.write("leaves.toml", text));
}

TEST(LightRequest, AChosenSkyShedsLightAtOnce) {
  const Scene scene = scene_with("\ndiffuse = ", "\n# ");
  LightRequest request = request_of(scene);
  RadiationModel model = scene.model;
  EXPECT_EQ(grant(request, scene, model), std::nullopt) << "the scene's own sky stays dark, as in `run`";
  EXPECT_EQ(model.bands[0].diffuse_w_m2, 0.0);
  request.sky.kind = SkyRequestKind::uniform;
  ASSERT_EQ(grant(request, scene, model), 0.2);
  EXPECT_DOUBLE_EQ(model.bands[0].diffuse_w_m2, 60.0);
  EXPECT_DOUBLE_EQ(model.bands[0].direct_w_m2, 240.0);
  EXPECT_DOUBLE_EQ(model.bands[1].diffuse_w_m2, 50.0);
  request.sky.kind = SkyRequestKind::overcast;
  ASSERT_EQ(grant(request, scene, model), 1.0);
  EXPECT_EQ(model.bands[0].diffuse_w_m2, 300.0);
  EXPECT_EQ(model.bands[0].direct_w_m2, 0.0);
  request.own_irradiance = true;
  EXPECT_EQ(grant(request, scene, model), std::nullopt);
}

TEST(LightRequest, ASceneWithDiffuseLightKeepsIt) {
  const Scene scene = scene_with("unused", "");
  LightRequest request = request_of(scene);
  request.sky.kind = SkyRequestKind::uniform;
  RadiationModel model = scene.model;
  EXPECT_EQ(grant(request, scene, model), std::nullopt);
  EXPECT_EQ(model.bands[0].diffuse_w_m2, 60.0);
  EXPECT_EQ(model.bands[0].direct_w_m2, 300.0);
}

TEST(LightRequest, KnowsABeamThatDoesNotFollowTheSun) {
  EXPECT_TRUE(has_fixed_beam(scene_with("unused", "")));
  EXPECT_FALSE(has_fixed_beam(scene_with("\"\ndirect = ", "\"\ndirect_normal = ")));
}

TEST(LightRequest, ADayIsPlayedFromSunriseToSunset) {
  SunRequest sun;
  sun.by_clock = true;
  sun.latitude_deg = 40.0;
  sun.longitude_deg = 116.0;
  sun.offset_minutes = 480;
  sun.year = 2002;
  sun.month = 8;
  sun.day = 8;
  sun.hour = 12.0;
  EXPECT_EQ(next_played_hour(sun, 10.0), 12.0 + 10.0 / 60.0);
  sun.hour = 19.4;  // the sun sets at 19:20
  const double morning = next_played_hour(sun, 10.0);
  EXPECT_NEAR(morning, 5.3 + 10.0 / 60.0, 0.1);
  LightRequest evening;
  evening.sun = sun;
  evening.sun.hour = 19.1;
  const std::vector<LightRequest> moments = moments_after(evening, 10.0, 3);
  ASSERT_EQ(moments.size(), 3U);
  EXPECT_NEAR(moments[0].sun.hour, 19.1 + 10.0 / 60.0, 1e-9);
  EXPECT_EQ(moments[1].sun.hour, morning);
  EXPECT_EQ(moments[2].sun.hour, morning + 10.0 / 60.0);
  evening.sun.day = 31;
  evening.sun.month = 2;
  EXPECT_TRUE(moments_after(evening, 10.0, 3).empty());
  evening.sun.by_clock = false;
  EXPECT_TRUE(moments_after(evening, 10.0, 3).empty());
}

}  // namespace
}  // namespace sunfleck
