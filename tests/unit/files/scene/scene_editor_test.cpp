// Tests changes of a scene's text: what is set is read again, and all else stays.
#include "files/scene/scene_editor.h"

#include "support/live_scene.h"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>

namespace sunfleck {
namespace {

class SceneEditing : public testing::Test {
 protected:
  SceneEditing() {
    folder_.write("leaves.obj", test::live_mesh_text);
    scene_ = read_scene(folder_.write("leaves.toml", test::live_scene_text));
  }

  [[nodiscard]] Scene read_again(const SceneEditor& editor) const {
    return read_scene(folder_.write("again.toml", editor.text()));
  }

  TempFolder folder_;
  Scene scene_;
};

TEST_F(SceneEditing, WithoutChangesKeepsTheScene) {
  const Scene again = read_again(SceneEditor(scene_));
  EXPECT_EQ(again.title, scene_.title);
  EXPECT_EQ(again.model.canopy.size(), scene_.model.canopy.size());
  ASSERT_EQ(again.model.bands.size(), scene_.model.bands.size());
  for (std::size_t b = 0; b < again.model.bands.size(); ++b) {
    EXPECT_EQ(again.model.bands[b].direct_w_m2, scene_.model.bands[b].direct_w_m2);
    EXPECT_EQ(again.model.bands[b].diffuse_w_m2, scene_.model.bands[b].diffuse_w_m2);
  }
}

TEST_F(SceneEditing, SetsTheSunByTimeAndByAngles) {
  SceneEditor editor(scene_);
  editor.set_sun_moment({{2024, 3, 9, 1, 2, 3.0}, -210, -33.25, 151.5});
  const Scene by_time = read_again(editor);
  ASSERT_TRUE(by_time.model.sun);
  constexpr double degree = std::numbers::pi / 180.0;
  const SunPosition expected = sun_position({2024, 3, 9, 1, 2, 3.0}, {-33.25 * degree, 151.5 * degree, 0.0});
  EXPECT_NEAR(by_time.model.sun->elevation_rad, expected.elevation_rad, 1e-12);
  EXPECT_NEAR(by_time.model.sun->azimuth_rad, expected.azimuth_rad, 1e-12);
  editor.set_sun_angles_deg(33.5, 120.25);
  const Scene by_angles = read_again(editor);
  EXPECT_NEAR(by_angles.model.sun->elevation_rad, 33.5 * degree, 1e-12);
  EXPECT_NEAR(by_angles.model.sun->azimuth_rad, 120.25 * degree, 1e-12);
}

TEST_F(SceneEditing, SetsLightAndOptics) {
  RadiationModel model = scene_.model;
  model.bands[0].direct_w_m2 = 123.5;
  model.bands[1].diffuse_w_m2 = 45.25;
  model.sky = SkyModel{.kind = SkyKind::uniform};
  model.optics[0].upper[1] = {0.31, 0.22};
  model.soil->reflectance[0] = 0.07;
  SceneEditor editor(scene_);
  editor.set_light(model);
  editor.set_optics(model, 0);
  editor.set_soil(model);
  const RadiationModel again = read_again(editor).model;
  EXPECT_EQ(again.bands[0].direct_w_m2, 123.5);
  EXPECT_EQ(again.bands[1].diffuse_w_m2, 45.25);
  EXPECT_EQ(again.sky->kind, SkyKind::uniform);
  EXPECT_EQ(again.optics[0].upper[1].reflectance, 0.31);
  EXPECT_EQ(again.optics[0].upper[1].transmittance, 0.22);
  EXPECT_EQ(again.optics[0].lower[0].reflectance, model.optics[0].lower[0].reflectance);
  EXPECT_EQ(again.soil->reflectance[0], 0.07);
}

TEST_F(SceneEditing, RenamesFilesButNotTitles) {
  SceneEditor editor(scene_);
  editor.set_title("leaves.obj");
  editor.rename_files([](const std::string& name) {
    return name == "leaves.obj" ? std::optional<std::string>("moved/leaves.obj") : std::nullopt;
  });
  const std::string text = editor.text();
  EXPECT_NE(text.find("moved/leaves.obj"), std::string::npos);
  EXPECT_EQ(text.find("moved/leaves.obj"), text.rfind("moved/leaves.obj"));
}

TEST_F(SceneEditing, SetsTheBounds) {
  SceneEditor editor(scene_);
  editor.set_accuracy({.direct = 0.04, .indirect = 0.05});
  EXPECT_EQ(read_again(editor).accuracy.direct, 0.04);
  EXPECT_EQ(read_again(editor).accuracy.indirect, 0.05);
}

}  // namespace
}  // namespace sunfleck
