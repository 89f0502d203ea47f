#include "files/scene/scene_editor.h"

#include "base/error.h"
#include "base/units.h"
#include "support/scene_text.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

const std::string scene_head = R"(title = "Before"
[plot]
size = [1.0, 1.0]
[sun]
elevation = 60.0
azimuth = 90.0
[sky]
model = "uniform"
)";
const std::string two_bands = R"([[band]]
name = "PAR"
direct = 1000.0
unit = "umol_m2_s"
[[band]]
name = "NIR"
direct_normal = 400.0
diffuse = 30.0
)";
const std::string scene_rest = R"([soil]
reflectance = 0.2
patch = 0.1
[optics.leaf]
reflectance = 0.1
rgb = [0.1, 0.2, 0.3]
[[geometry]]
mesh = "leaf"
)";
const std::vector<std::string> band_names = {"PAR", "NIR"};

std::string edited(const SceneEdits& edits) {
  return edited_scene_text("before.toml", scene_head + two_bands + scene_rest, band_names, edits);
}

Scene read(const std::string& text) {
  return read_scene(SceneText{"after.toml", text, {{"leaf", one_leaf()}}});
}

TEST(SceneEditor, WithoutEditsKeepsTheScene) {
  const Scene before = read(scene_head + two_bands + scene_rest);
  const Scene after = read(edited({}));
  EXPECT_EQ(after.title, "Before");
  EXPECT_EQ(after.model.sun->azimuth_rad, before.model.sun->azimuth_rad);
  EXPECT_EQ(after.model.sky->kind, SkyKind::uniform);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(after.model.bands[b].name, before.model.bands[b].name);
    EXPECT_EQ(after.model.bands[b].direct_w_m2, before.model.bands[b].direct_w_m2);
    EXPECT_EQ(after.model.bands[b].diffuse_w_m2, before.model.bands[b].diffuse_w_m2);
    EXPECT_EQ(after.model.optics[0].upper[b].reflectance, 0.1);
  }
  EXPECT_EQ(after.model.soil->reflectance, before.model.soil->reflectance);
  EXPECT_EQ(after.accuracy.direct, before.accuracy.direct);
}

TEST(SceneEditor, WritesTitleAndBounds) {
  SceneEdits edits;
  edits.title = "\"After\" \\ µ";
  edits.accuracy = Accuracy{0.04, 0.05};
  const Scene after = read(edited(edits));
  EXPECT_EQ(after.title, *edits.title);
  EXPECT_EQ(after.accuracy.direct, 0.04);
  EXPECT_EQ(after.accuracy.indirect, 0.05);
}

TEST(SceneEditor, WritesTheSunByAnglesAndByTheClock) {
  SceneEdits edits;
  edits.sun = SunByAngles{33.3, 211.1};
  Scene after = read(edited(edits));
  EXPECT_EQ(after.model.sun->elevation_rad, 33.3 * degree);
  EXPECT_EQ(after.model.sun->azimuth_rad, 211.1 * degree);
  edits.sun = SunByClock{{2024, 2, 29, 1, 2, 59.0}, -210, -33.3, 151.2};
  after = read(edited(edits));
  ASSERT_TRUE(after.moment);
  EXPECT_EQ(after.moment->offset_minutes, -210);
  EXPECT_EQ(after.moment->time.day, 29);
  EXPECT_EQ(after.moment->time.hour, 4);
  EXPECT_EQ(after.moment->time.minute, 32);
  EXPECT_EQ(after.moment->time.second, 59.0);
  EXPECT_EQ(after.moment->place.latitude_rad, -33.3 * degree);
}

TEST(SceneEditor, WritesEverySkyOfAModel) {
  SkyModel perez;
  perez.kind = SkyKind::all_weather;
  perez.dni_w_m2 = 512.5;
  perez.dhi_w_m2 = 99.9;
  SkyModel cie;
  cie.kind = SkyKind::general;
  cie.cie_type = 7;
  SkyModel overcast;
  overcast.kind = SkyKind::overcast;
  for (const SkyModel& sky : {SkyModel(), overcast, cie, perez}) {
    SceneEdits edits;
    edits.sky = sky;
    const Scene after = read(edited(edits));
    EXPECT_EQ(after.model.sky->kind, sky.kind);
    EXPECT_EQ(after.model.sky->cie_type, sky.cie_type);
    EXPECT_EQ(after.model.sky->dni_w_m2, sky.dni_w_m2);
    EXPECT_EQ(after.model.sky->dhi_w_m2, sky.dhi_w_m2);
  }
}

TEST(SceneEditor, WritesIrradiancesInsteadOfOtherLight) {
  SceneEdits edits;
  edits.irradiances = read(scene_head + two_bands + scene_rest).model.bands;
  edits.irradiances[0].direct_w_m2 = 0.0;
  edits.irradiances[0].diffuse_w_m2 = 12.3;
  edits.irradiances[1].direct_w_m2 = 0.0;
  edits.sun = Absent();
  const Scene after = read(edited(edits));
  EXPECT_FALSE(after.model.sun);
  EXPECT_EQ(after.model.bands[0].direct_w_m2, 0.0);
  EXPECT_EQ(after.model.bands[0].diffuse_w_m2, 12.3);
  EXPECT_EQ(after.model.bands[0].umol_per_joule, edits.irradiances[0].umol_per_joule);
  EXPECT_EQ(after.model.bands[1].diffuse_w_m2, 30.0);
}

// The bands lose their unit, which `emission` had.
TEST(SceneEditor, KeepsWhatLampsEmitInPhotons) {
  for (const std::string emission : {"100", "{ PAR = 50.5, NIR = 3 }"}) {
    const std::string text = scene_head + two_bands + replaced(scene_rest, "rgb", "emission = " + emission + "\nrgb");
    const auto lamp = [](const Scene& scene) { return scene.model.optics.front().emission_w_m2; };
    SceneEdits edits;
    edits.irradiances = read(text).model.bands;
    const std::string after = edited_scene_text("before.toml", text, band_names, edits);
    EXPECT_EQ(after.find("umol_m2_s"), std::string::npos);
    EXPECT_EQ(lamp(read(after)), lamp(read(text))) << after;
  }
}

TEST(SceneEditor, ListsBandsOfEqualWidth) {
  const std::string text = "bands = { from = 400, to = 600, step = 100, direct = 200.0 }\n" + scene_head + scene_rest;
  SceneEdits edits;
  edits.irradiances = read(text).model.bands;
  edits.irradiances[1].direct_w_m2 = 77.0;
  edits.optics = {{.name = "leaf", .upper = {{0.1, 0.2}, {0.3, 0.4}}, .lower = {{0.5, 0.1}, {0.6, 0.2}}}};
  const Scene after = read(edited_scene_text("before.toml", text, {"400_500", "500_600"}, edits));
  ASSERT_EQ(after.model.bands.size(), 2U);
  EXPECT_EQ(after.model.bands[1].name, "500_600");
  EXPECT_EQ(after.model.bands[1].from_nm, 500.0);
  EXPECT_EQ(after.model.bands[0].direct_w_m2, edits.irradiances[0].direct_w_m2);
  EXPECT_EQ(after.model.bands[1].direct_w_m2, 77.0);
  EXPECT_EQ(after.model.optics[0].upper[1].transmittance, 0.4);
}

TEST(SceneEditor, WritesOpticsButKeepsColours) {
  SceneEdits edits;
  edits.optics = {{.name = "leaf", .upper = {{0.11, 0.22}, {0.33, 0.44}}, .lower = {{0.5, 0.1}, {0.6, 0.2}}}};
  edits.soil_reflectance = {0.07, 0.3};
  const Scene after = read(edited(edits));
  EXPECT_EQ(after.model.optics[0].upper[0].transmittance, 0.22);
  EXPECT_EQ(after.model.optics[0].upper[1].reflectance, 0.33);
  EXPECT_EQ(after.model.optics[0].lower[1].reflectance, 0.6);
  EXPECT_EQ(after.model.optics[0].rgb, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(after.model.soil->reflectance, edits.soil_reflectance);
  EXPECT_EQ(after.model.soil->patch_m, 0.1);
}

TEST(SceneEditor, RenamesOnlyFiles) {
  const std::string text =
      "title = \"a\"\nlight_spectrum = \"a\"\n[weather]\nfile = \"a\"\n[optics.a]\nspectrum = \"a\"\nrole = \"b\"\n"
      "[optics.b.upper]\nspectrum = \"b\"\n[[geometry]]\nfile = \"a\"\noptics = \"a\"\npositions = \"a\"\n";
  SceneEdits edits;
  edits.renamed_file = [](const std::string& name) { return name == "a" ? std::optional("files/a") : std::nullopt; };
  const std::string after = edited_scene_text("before.toml", text, {}, edits);
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (std::size_t at = after.find(part); at != after.npos; at = after.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("'files/a'"), 5) << after;
  EXPECT_EQ(count("title = 'a'"), 1) << after;
  EXPECT_EQ(count("optics = 'a'"), 1) << after;
  EXPECT_EQ(count("spectrum = 'b'"), 1) << after;
}

TEST(SceneEditor, RefusesATextThatIsNoToml) {
  EXPECT_THROW(static_cast<void>(edited_scene_text("before.toml", "title = ", {}, {})), Error);
}

}  // namespace
}  // namespace sunfleck
