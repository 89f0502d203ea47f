#include "files/scene/scene_reader.h"

#include "base/units.h"
#include "physics/canopy/maize.h"
#include "support/scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

using SceneReader = SceneFolder;

TEST_F(SceneReader, ReadsEveryField) {
  const Scene scene = read(good_scene);
  EXPECT_EQ(scene.title, "A test stand");
  EXPECT_EQ(scene.file, file());
  EXPECT_EQ(scene.model.plot.size_x_m, 2.0);
  EXPECT_EQ(scene.model.plot.size_z_m, 3.0);
  EXPECT_FALSE(scene.model.plot.periodic);
  ASSERT_TRUE(scene.model.sun);
  EXPECT_DOUBLE_EQ(scene.model.sun->elevation_rad, 30.0 * degree);
  EXPECT_DOUBLE_EQ(scene.model.sun->azimuth_rad, 270.0 * degree);
  EXPECT_FALSE(scene.moment);

  ASSERT_EQ(scene.model.bands.size(), 2U);
  EXPECT_EQ(scene.model.bands[0].name, "PAR");
  EXPECT_EQ(scene.model.bands[0].direct_w_m2, 350.0);
  EXPECT_EQ(scene.model.bands[0].diffuse_w_m2, 0.0);
  EXPECT_EQ(scene.model.bands[1].name, "NIR_1");
  EXPECT_NEAR(scene.model.bands[1].direct_w_m2, 200.0, 1e-12);  // 400 sin 30

  ASSERT_TRUE(scene.model.soil);
  EXPECT_EQ(scene.model.soil->reflectance, (std::vector<double>{0.15, 0.25}));
  EXPECT_EQ(scene.model.soil->patch_m, 0.02);
  EXPECT_EQ(scene.model.soil->rgb, glm::dvec3(0.2, 0.15, 0.1));

  EXPECT_EQ(scene.accuracy.direct, 0.002);
  EXPECT_EQ(scene.accuracy.indirect, 0.004);
  EXPECT_EQ(scene.accuracy.confidence, 0.9);
  EXPECT_EQ(scene.accuracy.of, ErrorTarget::organ);
  ASSERT_TRUE(scene.camera);
  EXPECT_EQ(scene.camera->position_m, glm::dvec3(3.0, 2.5, 3.0));
  EXPECT_EQ(scene.camera->look_at_m, glm::dvec3(0.9, 1.0, 1.2));
  EXPECT_DOUBLE_EQ(scene.camera->fov_rad, 50.0 * degree);
  EXPECT_EQ(scene.model.layers, 12);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST_F(SceneReader, GivesEverySurfaceItsOptics) {
  const Scene scene = read(good_scene);
  ASSERT_EQ(scene.model.canopy.optics_names, (std::vector<std::string>{"bark", "leaf"}));
  ASSERT_EQ(scene.model.optics.size(), 2U);
  const SurfaceOptics& bark = scene.model.optics[0];
  EXPECT_EQ(bark.name, "bark");
  EXPECT_EQ(bark.upper[1].reflectance, 0.3);
  EXPECT_EQ(bark.upper[1].transmittance, 0.0);
  EXPECT_EQ(bark.lower[0].reflectance, 0.1);
  EXPECT_EQ(bark.lower[1].transmittance, 0.2);
  EXPECT_EQ(bark.rgb, SurfaceOptics{}.rgb);
  const SurfaceOptics& leaf = scene.model.optics[1];
  EXPECT_EQ(leaf.name, "leaf");
  EXPECT_EQ(leaf.upper[0].reflectance, 0.12);
  EXPECT_EQ(leaf.lower[0].transmittance, 0.06);
  EXPECT_EQ(leaf.lower[1].reflectance, 0.45);
  EXPECT_EQ(leaf.lower[1].absorptance(), 0.0);
  EXPECT_EQ(leaf.rgb, glm::dvec3(0.05, 0.1, 0.04));
}

// A copy is scaled first, then turned clockwise as seen from above, then moved.
TEST_F(SceneReader, PlacesEveryCopy) {
  const Scene scene = read(good_scene);
  ASSERT_EQ(scene.model.canopy.size(), 4U);
  const glm::vec3 first = scene.model.canopy.corners[0][1];
  EXPECT_EQ(first, glm::vec3(0.5F, 0.5F, 1.5F));
  // Turning by 90 degrees takes X (south) to Z (west) and Z to -X.
  const glm::vec3 turned_z = scene.model.canopy.corners[2][1];
  EXPECT_NEAR(turned_z.x, 1.0, 1e-6);
  EXPECT_NEAR(turned_z.y, 0.75, 1e-6);
  EXPECT_NEAR(turned_z.z, 2.0, 1e-6);
  const glm::vec3 turned_x = scene.model.canopy.corners[2][2];
  EXPECT_NEAR(turned_x.x, 1.5, 1e-6);
  EXPECT_NEAR(turned_x.z, 2.5, 1e-6);
}

TEST_F(SceneReader, BareSceneHasDefaults) {
  const Scene scene = read(bare_scene);
  EXPECT_EQ(scene.title, "scene");
  EXPECT_TRUE(scene.model.plot.periodic);
  EXPECT_FALSE(scene.model.sun);
  EXPECT_FALSE(scene.model.soil);
  EXPECT_FALSE(scene.camera);
  EXPECT_EQ(scene.model.canopy.size(), 0U);
  EXPECT_EQ(scene.model.layers, 20);
  EXPECT_EQ(scene.accuracy.direct, 0.001);
  EXPECT_EQ(scene.accuracy.indirect, 0.003);
  EXPECT_EQ(scene.accuracy.confidence, 0.95);
  EXPECT_EQ(scene.accuracy.of, ErrorTarget::canopy);
  EXPECT_EQ(scene.model.bands[0].direct_w_m2, 0.0);
  EXPECT_TRUE(scene.warnings.empty());
  const Scene seen = read(bare_scene + "[camera]\nposition = [1, 2, 3]\nlook_at = [0, 0, 0]\n");
  EXPECT_DOUBLE_EQ(seen.camera->fov_rad, 40.0 * degree);
}

TEST_F(SceneReader, TimeAndPlaceGiveTheSun) {
  const std::string sun = "[sun]\ntime = 2002-08-08T01:10:30.5+08:00\nlatitude = 40.02\nlongitude = 243.72\n";
  const Scene scene = read(bare_scene + sun);
  ASSERT_TRUE(scene.moment);
  EXPECT_EQ(scene.moment->time.year, 2002);
  EXPECT_EQ(scene.moment->time.month, 8);
  EXPECT_EQ(scene.moment->time.day, 7);
  EXPECT_EQ(scene.moment->time.hour, 17);
  EXPECT_EQ(scene.moment->time.minute, 10);
  EXPECT_EQ(scene.moment->time.second, 30.5);
  EXPECT_EQ(scene.moment->offset_minutes, 480);
  EXPECT_DOUBLE_EQ(scene.moment->place.latitude_rad, 40.02 * degree);
  EXPECT_DOUBLE_EQ(scene.moment->place.longitude_rad, 243.72 * degree);
  const SunPosition position = sun_position(scene.moment->time, scene.moment->place);
  EXPECT_EQ(scene.model.sun->elevation_rad, position.elevation_rad);
  EXPECT_EQ(scene.model.sun->azimuth_rad, position.azimuth_rad);

  const Scene utc = read(bare_scene + "[sun]\ntime = 2024-02-29T23:59:00Z\nlatitude = 0\nlongitude = 0\n");
  EXPECT_EQ(utc.moment->offset_minutes, 0);
  EXPECT_EQ(utc.moment->time.day, 29);
  const Scene west = read(bare_scene + "[sun]\ntime = 2024-02-29T23:59:00-00:30\nlatitude = 0\nlongitude = 0\n");
  EXPECT_EQ(west.moment->time.month, 3);
  EXPECT_EQ(west.moment->time.day, 1);
  EXPECT_EQ(west.moment->time.hour, 0);
  EXPECT_EQ(west.moment->time.minute, 29);
}

TEST_F(SceneReader, NightIsNoErrorAndSaidOnce) {
  for (const char* elevation : {"-5.0", "0.0"}) {
    const Scene scene = read(replaced(good_scene, "elevation = 30.0", std::string("elevation = ") + elevation));
    ASSERT_TRUE(scene.model.sun);
    EXPECT_EQ(scene.model.bands[0].direct_w_m2, 0.0);
    EXPECT_EQ(scene.model.bands[1].direct_w_m2, 0.0);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("horizon"), std::string::npos) << scene.warnings[0];
    EXPECT_NE(scene.warnings[0].find("scene.toml:7: sun"), std::string::npos) << scene.warnings[0];
  }
}

TEST_F(SceneReader, AzimuthIsNormalised) {
  const std::vector<std::pair<std::string, double>> cases = {
      {"360", 0.0}, {"-360", 0.0}, {"-0.0", 0.0}, {"-1", 359.0}, {"90", 90.0}};
  for (const auto& [written, expected] : cases) {
    const Scene scene = read(replaced(good_scene, "azimuth   = 270", "azimuth = " + written));
    EXPECT_NEAR(scene.model.sun->azimuth_rad, expected * degree, 1e-15) << written;
  }
}

TEST_F(SceneReader, GeneratorMakesMaize) {
  const std::string optics = "[optics.leaf]\nreflectance = 0.1\n[optics.stem]\nreflectance = 0.1\n";
  const std::string geometry = "[[geometry]]\ngenerator = \"maize\"\nrows = 1\nper_row = 2\nspacing = [0.5, 1]\nseed = 7\n";
  const Scene scene = read(bare_scene + optics + geometry);
  const Mesh mesh = make_maize({.rows = 1, .per_row = 2, .spacing_in_row_m = 0.5, .spacing_between_rows_m = 1.0, .seed = 7});
  EXPECT_EQ(scene.model.canopy.size(), mesh.triangles.size());
  EXPECT_EQ(scene.model.canopy.organs, mesh.organs);
  EXPECT_EQ(scene.model.canopy.optics_names, mesh.optics_names);
  EXPECT_TRUE(scene.warnings.empty());
  const Scene crowded = read(bare_scene + optics + replaced(geometry, "rows = 1", "rows = 2"));
  ASSERT_EQ(crowded.warnings.size(), 1U);
  EXPECT_NE(crowded.warnings[0].find("size = [1, 2]"), std::string::npos) << crowded.warnings[0];
}

TEST_F(SceneReader, SoilElementsTakeTheSoilsReflectance) {
  write(folder_ / "ground.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nusemtl soil\nf 1 2 3\n");
  const std::string geometry = "[[geometry]]\nfile = \"ground.obj\"\n";
  const Scene scene = read(bare_scene + "[soil]\nreflectance = 0.15\nrgb = [0.3, 0.2, 0.1]\n" + geometry);
  ASSERT_EQ(scene.model.optics.size(), 1U);
  EXPECT_EQ(scene.model.optics[0].name, "soil");
  EXPECT_EQ(scene.model.optics[0].upper[0].reflectance, 0.15);
  EXPECT_EQ(scene.model.optics[0].lower[0].reflectance, 0.15);
  EXPECT_EQ(scene.model.optics[0].upper[0].transmittance, 0.0);
  EXPECT_EQ(scene.model.optics[0].rgb, glm::dvec3(0.3, 0.2, 0.1));
  const Scene own = read(bare_scene + "[soil]\nreflectance = 0.15\n[optics.soil]\nreflectance = 0.4\n" + geometry);
  EXPECT_EQ(own.model.optics[0].upper[0].reflectance, 0.4);
  expect_refusal([&] { static_cast<void>(read(bare_scene + geometry)); }, "add [optics.soil] or [soil]");
}

TEST_F(SceneReader, ReadsRolesOfOpticsAndGeometry) {
  for (const std::string_view name : role_names) {
    const std::string key = fmt::format("role = \"{}\"\n", name);
    const Scene by_optics = read(replaced(good_scene, "[optics.bark.upper]", "[optics.bark]\n" + key + "[optics.bark.upper]"));
    EXPECT_EQ(role_name(by_optics.model.optics[0].role.value()), name);
    EXPECT_FALSE(by_optics.model.optics[1].role);
    const Scene by_geometry = read(replaced(good_scene, "up      = \"y\"\n", key));
    for (const Organ& organ : by_geometry.model.canopy.organs) EXPECT_EQ(role_name(organ.role.value()), name);
  }
}

// Their materials need no optics: soil reflects as [soil] does, and a structure is grey.
TEST_F(SceneReader, SoilAndStructuresNeedNoOptics) {
  write(folder_ / "plates.obj", replaced(plates_obj, "usemtl", "usemtl box\nf 1 2 3\nusemtl"));
  const std::string without =
      replaced(good_scene, "optics  = { leaf = \"leaf\", \"*\" = \"bark\" }\nup      = \"y\"\n", "role = \"{}\"\n");
  const Scene soil = read(replaced(without, "{}", "soil"));
  ASSERT_EQ(soil.model.canopy.optics_names, (std::vector<std::string>{"soil", "leaf"}));
  EXPECT_EQ(soil.model.optics[0].upper[0].reflectance, 0.15);
  const Scene grey = read(replaced(without, "{}", "structure"));
  ASSERT_EQ(grey.model.canopy.optics_names.front(), "plain structure");
  EXPECT_EQ(grey.model.optics[0].lower[1].reflectance, 0.4);
  EXPECT_EQ(grey.model.optics[0].lower[1].transmittance, 0.0);
  ASSERT_FALSE(grey.warnings.empty());
  const auto said = std::find_if(grey.warnings.begin(), grey.warnings.end(), [](const std::string& warning) {
    return warning.find("the optics of box, structure are not given") != warning.npos;
  });
  EXPECT_NE(said, grey.warnings.end()) << grey.warnings.front();
  Scene again = grey;
  relight(again, SceneText{file(), replaced(without, "{}", "structure"), {}});
  EXPECT_EQ(again.model.optics[0].upper[0].reflectance, 0.4);
  const Scene given = read(replaced(without, "{}", "structure") + "[optics.structure]\nreflectance = 0.7\n");
  EXPECT_EQ(given.model.optics[0].upper[0].reflectance, 0.7);
  // Plants still need theirs.
  expect_refusal([&] { static_cast<void>(read(replaced(without, "{}", "stem"))); });
}

TEST_F(SceneReader, GivesStructuresThatSharePlantsOpticsTheirOwn) {
  write(folder_ / "plates.obj", "o plant1_wall\n" + replaced(plates_obj, "usemtl", "o plant1_leaf\nusemtl"));
  const Scene scene = read(replaced(good_scene, "\"bark\"", "\"leaf\""));
  ASSERT_EQ(scene.model.canopy.optics_names, (std::vector<std::string>{"leaf", "leaf"}));
  ASSERT_EQ(scene.model.optics.size(), 2U);
  EXPECT_EQ(scene.model.canopy.optics_of, (std::vector<std::uint16_t>{1, 0, 1, 0}));
  EXPECT_EQ(scene.model.optics[1].upper[0].reflectance, 0.12);
}

TEST_F(SceneReader, WarnsOnceOfPlantsWithoutALeaf) {
  const std::string corners = plates_obj.substr(0, plates_obj.find("f 1"));
  write(folder_ / "plates.obj",
        corners + "o plant1_stem\nf 1 2 3\no plant2_leaf\nf 4 5 6\no plant3_ear\nusemtl leaf\nf 1 2 6\n");
  const Scene scene = read(good_scene);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("scene.toml: 4 of 6 plants have no leaf"), std::string::npos) << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find("plant 1, whose organ \"stem\" is a stem"), std::string::npos) << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find("role = \"leaf\" to [optics."), std::string::npos) << scene.warnings[0];
  // Neither structures nor soil need leaves.
  for (const char* role : {"structure", "soil", "lamp", "leaf"}) {
    const Scene other = read(replaced(good_scene, "up      = \"y\"\n", fmt::format("role = \"{}\"\n", role)));
    EXPECT_TRUE(other.warnings.empty()) << other.warnings.front();
  }
}

TEST_F(SceneReader, WarnsOfVegetationThatBelongsToNoPlant) {
  const std::string corners = plates_obj.substr(0, plates_obj.find("f 1"));
  const auto warnings_of = [&](const std::string& objects) {
    write(folder_ / "plates.obj", corners + objects);
    return read(good_scene).warnings;
  };
  const std::vector<std::string> two = warnings_of("o plant0_blade1\nf 1 2 3\nf 4 5 6\no plant1_leaf1\nusemtl leaf\nf 1 2 6\n");
  ASSERT_EQ(two.size(), 1U);
  EXPECT_NE(two[0].find("scene.toml: 4 triangles of leaves, stems and fruits, e.g. of the organ \"blade\", belong to no plant"),
            std::string::npos)
      << two[0];
  EXPECT_NE(two[0].find("; number plants from 1"), std::string::npos) << two[0];
  for (const char* fine : {"o plant0_wall\nf 1 2 3\no plant0_soil\nf 4 5 6\no plant1_leaf1\nusemtl leaf\nf 1 2 6\n",
                           "o plant0_blade1\nf 1 2 3\no plant0_leaf2\nusemtl leaf\nf 4 5 6\n",
                           "o soil\nf 1 2 3\no leaf\nusemtl leaf\nf 4 5 6\n"}) {
    const std::vector<std::string> none = warnings_of(fine);
    EXPECT_TRUE(none.empty()) << none.front();
  }
}

TEST_F(SceneReader, NewLightChangesNoRoles) {
  const Scene scene = read(good_scene);
  const auto relit = [&](const std::string& text) {
    return message_of([&] {
      Scene copy = scene;
      relight(copy, SceneText{file(), text, {}});
    });
  };
  EXPECT_FALSE(relit(replaced(good_scene, "[optics.bark.upper]", "[optics.bark]\nrole = \"stem\"\n[optics.bark.upper]")));
  const auto message =
      relit(replaced(good_scene, "[optics.bark.upper]", "[optics.bark]\nrole = \"lamp\"\n[optics.bark.upper]"));
  ASSERT_TRUE(message);
  expect_three_parts(*message);
  EXPECT_NE(message->find("\"bark\" would be a lamp, but it was a stem"), std::string::npos) << *message;
}

TEST_F(SceneReader, DigestFollowsTextAndMeshes) {
  const std::string first = read(good_scene).digest;
  EXPECT_EQ(first.size(), 16U);
  EXPECT_EQ(first.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(read(good_scene).digest, first);
  EXPECT_NE(read(good_scene + "# more\n").digest, first);
  write(folder_ / "plates.obj", plates_obj + "# more\n");
  EXPECT_NE(read(good_scene).digest, first);
  // FNV-1a of the text alone: a reference value computed with the published recurrence.
  std::uint64_t state = 14695981039346656037ULL;
  for (const char c : bare_scene) state = (state ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  EXPECT_EQ(std::stoull(read(bare_scene).digest, nullptr, 16), state);
}

TEST_F(SceneReader, FilesOutsideTheFolderNeedPermission) {
  fs::create_directories(folder_ / "inner");
  write(folder_ / "inner" / "plates.obj", plates_obj);
  fs::create_symlink(folder_ / "plates.obj", folder_ / "inner" / "link.obj");
  const fs::path inner = folder_ / "inner" / "scene.toml";
  const auto attempt = [&](const std::string& name, bool allow) {
    write(inner, replaced(good_scene, "plates.obj", name));
    return message_of([&] { static_cast<void>(read_scene(inner, {.allow_outside = allow})); });
  };
  const std::vector<std::string> outside = {"../plates.obj", "link.obj", "./../inner/../plates.obj",
                                            (folder_ / "plates.obj").string()};
  for (const std::string& name : outside) {
    const auto message = attempt(name, false);
    ASSERT_TRUE(message) << name;
    expect_three_parts(*message);
    EXPECT_NE(message->find("geometry.file"), std::string::npos) << *message;
    EXPECT_NE(message->find("--allow-outside"), std::string::npos) << *message;
    EXPECT_FALSE(attempt(name, true)) << name;
  }
  const std::vector<std::string> inside = {"plates.obj", "./plates.obj", "../inner/plates.obj",
                                           (folder_ / "inner/plates.obj").string()};
  for (const std::string& name : inside) {
    const auto message = attempt(name, false);
    EXPECT_FALSE(message) << *message;
  }
}

TEST_F(SceneReader, WarnsOfGeometryOutsideAnIsolatedPlot) {
  const std::string moved = replaced(good_scene, "[[0.5, 0.0, 1.0], [1.5, 0.25, 2.0]]", "[[-3.0, 0.5, 8.0]]");
  const Scene scene = read(replaced(moved, "[0, 90.0]", "0"));
  ASSERT_EQ(scene.warnings.size(), 1U);
  // The plates cover 0..0.5 along X and Z; the plot's middle is (1, 1.5).
  EXPECT_NE(scene.warnings[0].find("at = [[0.75, 0.5, 1.25]]"), std::string::npos) << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find("X -3..-2.5"), std::string::npos) << scene.warnings[0];
  EXPECT_TRUE(read(replaced(replaced(moved, "[0, 90.0]", "0"), "periodic = false", "periodic = true")).warnings.empty());
  // The mesh is larger than the plot and about centred on it: its place gives no reason for a warning.
  const std::string large = replaced(replaced(good_scene, "scale   = 0.5", "scale = 100"), "[0, 90.0]", "0");
  const Scene wide = read(replaced(large, "[[0.5, 0.0, 1.0], [1.5, 0.25, 2.0]]", "[[-49.0, 0.0, -48.5]]"));
  ASSERT_EQ(wide.warnings.size(), 1U);
  EXPECT_NE(wide.warnings[0].find("200 m above the ground; for a mesh in centimetres"), std::string::npos) << wide.warnings[0];
}

TEST_F(SceneReader, DoubtsWhatIsSeldomMeant) {
  const std::string sun = "[sun]\nelevation = 50\nazimuth = 90\n";
  const std::string soil = "[soil]\nreflectance = 0.1\n";
  const auto plates = [](const std::string& more) {
    return "[optics.leaf]\nreflectance = 0.1\n[[geometry]]\nfile = \"plates.obj\"\noptics = \"leaf\"\n" + more;
  };
  const std::string lit = replaced(bare_scene, "name = \"PAR\"", "name = \"PAR\"\ndirect = 1") + sun;
  const std::vector<std::pair<std::string, std::string>> doubtful = {
      {bare_scene + sun, "band PAR has no light"},
      {lit + "[sky]\nmodel = \"uniform\"\n", "sky sends no light"},
      {lit + soil + plates("at = [[0, -5, 0]]\n"), "100 % of the plants' area lies below the ground"},
      {lit + plates("at = [[0, 200, 0]]\n"), "m above the ground; for a mesh in centimetres add scale = 0.01"},
  };
  for (const auto& [text, doubt] : doubtful) {
    const Scene scene = read(text);
    const auto& warnings = scene.warnings;
    const bool found = std::any_of(warnings.begin(), warnings.end(), [&doubt = doubt](const std::string& warning) {
      return warning.find(doubt) != std::string::npos;
    });
    EXPECT_TRUE(found) << doubt;
  }
  EXPECT_TRUE(read(lit).warnings.empty());
  EXPECT_TRUE(read(bare_scene).warnings.empty());
  // The advice is the axis that is not yet given.
  for (const auto& [given, advised] : {std::pair("", "set up = \"z\""), std::pair("up = \"z\"\n", "set up = \"y\"")}) {
    const Scene scene = read(lit + soil + plates(std::string("at = [[0, -5, 0]]\n") + given));
    EXPECT_TRUE(std::any_of(scene.warnings.begin(), scene.warnings.end(), [&advice = advised](const std::string& warning) {
      return warning.find(advice) != warning.npos;
    })) << advised;
  }
}

TEST_F(SceneReader, SplitsTheOrgansOfAMesh) {
  write(folder_ / "pieces.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 2 0\nv 1 2 0\nv 1 3 0\no rosette\nf 1 2 3\nf 4 5 6\n");
  const auto organs = [&](const std::string& more) {
    return read(bare_scene + "[optics.leaf]\nreflectance = 0.1\n[[geometry]]\nfile = \"pieces.obj\"\noptics = \"leaf\"\n" +
                more)
        .model.canopy.organs;
  };
  EXPECT_EQ(organs(""), (std::vector<Organ>{{1, "rosette", 0}}));
  EXPECT_EQ(organs("split = \"names\"\n"), organs(""));
  EXPECT_EQ(organs("split = \"parts\"\n"), (std::vector<Organ>{{1, "rosette", 1}, {1, "rosette", 2}}));
  EXPECT_EQ(organs("split = \"materials\"\n"), organs(""));
  expect_refusal([&] { static_cast<void>(organs("split = \"pieces\"\n")); }, "geometry.split");
}

TEST_F(SceneReader, EmissionIsInTheUnitOfItsBand) {
  const auto emission_w_m2 = [&](const std::string& text) {
    const std::vector<SurfaceOptics> optics = read(text).model.optics;
    return std::find_if(optics.begin(), optics.end(), [](const SurfaceOptics& each) { return each.name == "leaf"; })
        ->emission_w_m2;
  };
  const std::string of_leaf = "transmittance = { PAR = 0.06, NIR_1 = 0.55 }\n";
  const std::string band = "[[band]]\nname    = \"PAR\"\ndirect  = 350.0\ndiffuse = 0.0\n";
  for (const auto& [given, par, nir] : {std::tuple{"100", 100.0, 100.0}, {"{ NIR_1 = 5, PAR = 91.4 }", 91.4, 5.0}}) {
    const std::string lamp = replaced(good_scene, of_leaf, of_leaf + "role = \"lamp\"\nemission = " + given + "\n");
    EXPECT_EQ(emission_w_m2(lamp), (std::vector<double>{par, nir}));
    const std::string photons = band + "unit = \"umol_m2_s\"\n";
    const std::vector<double> expected = {par / 4.57, nir};
    EXPECT_EQ(emission_w_m2(replaced(lamp, band, photons)), expected);
    EXPECT_EQ(emission_w_m2(replaced(lamp, band, photons + "umol_per_joule = 5\n")), (std::vector<double>{par / 5.0, nir}));
    const std::string second = "[[band]]\nname          = \"NIR_1\"\ndirect_normal = 400\n";
    const std::string without = replaced(replaced(lamp, band, ""), second, "");
    EXPECT_EQ(emission_w_m2(without + photons + second), expected) << "bands after optics";
  }
}

TEST_F(SceneReader, WarnsOfUnusedOptics) {
  const Scene scene = read(good_scene + "[optics.ear]\nreflectance = 0.2\n");
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("optics.ear"), std::string::npos) << scene.warnings[0];
}

TEST_F(SceneReader, PlotsAboveAHectareGetCoarserDefaultPatches) {
  const auto with = [&](const char* size, const char* patch) {
    return read(fmt::format("[plot]\nsize = {}\n[[band]]\nname = \"PAR\"\n[soil]\nreflectance = 0.1\n{}", size, patch));
  };
  const Scene scene = with("[1000, 1000]", "");
  EXPECT_DOUBLE_EQ(scene.model.soil->patch_m, 0.5);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("soil.patch"), std::string::npos) << scene.warnings[0];
  EXPECT_DOUBLE_EQ(with("[160, 100]", "").model.soil->patch_m, std::sqrt(16000 / 4e6));
  for (const char* size : {"[100, 99]", "[99.99, 100.01]", "[1000, 9.9]", "[1e6, 1e-6]"}) {
    EXPECT_EQ(with(size, "").model.soil->patch_m, 0.05) << size;
    EXPECT_TRUE(with(size, "").warnings.empty()) << size;
  }
  EXPECT_EQ(with("[160, 100]", "patch = 0.05\n").model.soil->patch_m, 0.05) << "as the user says";
}

// Rounding may make the sum of decimal fractions exceed 1.
TEST_F(SceneReader, ReflectanceAndTransmittanceMayAddUpToOne) {
  const Scene scene = read(bare_scene +
                           "[optics.leaf]\nreflectance = 0.1\ntransmittance = 0.9\n[optics.b]\nreflectance = 0.7000000000001\n"
                           "transmittance = 0.3\n");
  EXPECT_EQ(scene.warnings.size(), 2U);
}

TEST_F(SceneReader, ShippedScenesAreRead) {
  std::size_t scenes = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(SUNFLECK_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const auto message = message_of([&] {
      const Scene scene = read_scene(entry.path());
      EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
      EXPECT_GT(scene.model.canopy.size(), 0U) << entry.path();
      EXPECT_EQ(scene.model.optics.size(), scene.model.canopy.optics_names.size());
    });
    EXPECT_FALSE(message) << *message;
    ++scenes;
  }
  EXPECT_GE(scenes, 6U);
}

}  // namespace
}  // namespace sunfleck
