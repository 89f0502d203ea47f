// Tests the conversion of a set of CARIBU files to a scene.

#include "files/scene/caribu_scene.h"

#include "files/scene/scene_reader.h"
#include "support/caribu_files.h"
#include "support/scene_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace sunfleck {
namespace {

// Contains a leaf of species 1, a leaf of species 2, a stem, and a soil polygon.
const std::string stand_can =
    "p 1 100007003001 3 1 2 0.5 2 2 0.5 1 3 0.5\n"
    "p 1 200012001000 3 1 2 1.5 2 2 1.5 1 3 1.5\n"
    "p 1 100007000000 3 1 2 0 2 2 0 1 2 1\n"
    "p 1 000000000000 3 0 0 0 4 0 0 0 6 0\n";

class CaribuScenes : public ::testing::Test {
 protected:
  CaribuScenes() {
    static_cast<void>(folder_.write("stand.can", stand_can));
    static_cast<void>(folder_.write("par.opt", grey_opt));
    static_cast<void>(folder_.write("nir.opt", replaced(grey_opt, "s d 0.15", "s d 0.35")));
    static_cast<void>(folder_.write("one.opt", black_opt));
    static_cast<void>(folder_.write("sun.light", "0 0.1 0 -1\n350 -1 0 -1\n"));
    static_cast<void>(folder_.write("sky.light", "0.75 0 0 -1\n0.5 0.5 0.5 -0.7\n"));
    static_cast<void>(folder_.write("plot.8", "0 1\n4 7\n"));
  }

  [[nodiscard]] CaribuSet set() const {
    return {folder_ / "stand.can",
            {{"PAR", folder_ / "par.opt"}, {"NIR", folder_ / "nir.opt"}},
            folder_ / "sun.light",
            folder_ / "plot.8",
            1.0,
            false};
  }
  [[nodiscard]] std::string text(const CaribuSet& of) const { return caribu_scene(of, names_).text; }
  [[nodiscard]] Scene scene(const CaribuSet& of) const {
    return read_scene(SceneText{folder_ / "made.toml", text(of), {}}, {.allow_outside = false});
  }
  [[nodiscard]] std::string refusal(const CaribuSet& of) const {
    const auto message = message_of([&] { static_cast<void>(text(of)); });
    if (!message) return "accepted";
    expect_three_parts(*message);
    return *message;
  }

  TempFolder folder_;
  CaribuNames names_{"stand.can", "sky.light"};
};

TEST_F(CaribuScenes, HoldWhatTheFilesSay) {
  const Scene made = scene(set());
  EXPECT_EQ(made.title, "stand");
  EXPECT_TRUE(made.warnings.empty()) << made.warnings.front();
  const RadiationModel& model = made.model;
  EXPECT_TRUE(model.plot.periodic);
  EXPECT_DOUBLE_EQ(model.plot.size_x_m, 6.0) << "north to south";
  EXPECT_DOUBLE_EQ(model.plot.size_z_m, 4.0) << "east to west";
  ASSERT_EQ(model.bands.size(), 2U);
  EXPECT_EQ(model.bands[0].name, "PAR");
  EXPECT_EQ(model.bands[1].name, "NIR");
  EXPECT_EQ(model.bands[1].direct_w_m2, 350.0);
  EXPECT_EQ(model.bands[1].diffuse_w_m2, 0.0);
  ASSERT_TRUE(model.sun);
  EXPECT_NEAR(glm::degrees(model.sun->elevation_rad), 45.0, 1e-12);
  EXPECT_NEAR(glm::degrees(model.sun->azimuth_rad), 90.0, 1e-12) << "light that travels west comes from the east";
  EXPECT_FALSE(made.light.sky);
  EXPECT_EQ(model.soil->reflectance, (std::vector<double>{0.15, 0.35}));
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    const std::string& name = model.canopy.optics_names[model.canopy.optics_of[e]];
    EXPECT_EQ(name, (std::vector<std::string>{"leaf", "leaf2", "stem", "soil"})[e]);
    const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
    EXPECT_EQ(optics.upper[0].reflectance, (std::vector{0.12, 0.4, 0.1, 0.15})[e]);
    EXPECT_EQ(optics.upper[1].transmittance, (std::vector{0.06, 0.45, 0.0, 0.0})[e]);
    EXPECT_EQ(optics.lower[0].reflectance, (std::vector{0.2, 0.4, 0.1, 0.15})[e]);
    EXPECT_EQ(optics.lower[0].transmittance, (std::vector{0.05, 0.45, 0.0, 0.0})[e]);
  }
  EXPECT_EQ(model.canopy.labels, (std::vector<std::uint64_t>{100007003001, 200012001000, 100007000000, 0}));
  // The point (1, 2) lies 3 m west of the domain's east border x = 4, and 5 m south of its north border y = 7. Corners are
  // accurate to 2^-23 of the period, rounded up to a power of two.
  const Triangle& leaf = model.canopy.corners[0];
  EXPECT_NEAR(leaf[0].x, 5.0, 1e-6);
  EXPECT_NEAR(leaf[0].y, 0.5, 1e-6);
  EXPECT_NEAR(leaf[0].z, 3.0, 1e-6);
  EXPECT_GT(unit_normal(leaf).y, 0.99) << "counter-clockwise seen from above";
}

TEST_F(CaribuScenes, AnyDirectionBecomesItsSun) {
  for (const std::string line : {"1 0 0 -1", "2 -0.5178 0.3074 -0.7983", "1 0.3 0.9 -0.01", "1 -1e-9 0 -1", "5 0 -2 -2"}) {
    SCOPED_TRACE(line);
    CaribuSet of = set();
    of.light = folder_.write("a.light", line + "\n");
    const Scene made = scene(of);
    std::istringstream words(line);
    double weight = 0.0;
    glm::dvec3 travel;  // east, north, up
    words >> weight >> travel.x >> travel.y >> travel.z;
    EXPECT_EQ(made.model.bands[0].direct_w_m2, weight);
    const glm::dvec3 to_sun = -glm::normalize(glm::dvec3(-travel.y, travel.z, -travel.x));
    EXPECT_LT(glm::distance(direction_to_sun(*made.model.sun), to_sun), 1e-14);
  }
}

TEST_F(CaribuScenes, SeveralDirectionsAreASky) {
  CaribuSet of = set();
  of.light = folder_ / "sky.light";
  EXPECT_TRUE(caribu_scene(of, names_).names_light);
  const Scene made = scene(of);
  EXPECT_FALSE(made.model.sun);
  ASSERT_TRUE(made.light.sky);
  EXPECT_EQ(made.light.sky->kind, SkyKind::lights);
  EXPECT_EQ(made.light.sky->lights.size(), 2U);
  EXPECT_EQ(made.model.bands[0].diffuse_w_m2, 1.25);
  EXPECT_EQ(made.model.bands[1].direct_w_m2, 0.0);
}

TEST_F(CaribuScenes, WithoutADomainTheStandIsAlone) {
  CaribuSet of = set();
  of.domain.reset();
  of.scale = 0.01;
  const Scene made = scene(of);
  EXPECT_FALSE(made.model.plot.periodic);
  EXPECT_DOUBLE_EQ(made.model.plot.size_x_m, 0.06);
  EXPECT_DOUBLE_EQ(made.model.plot.size_z_m, 0.04);
  const Box box = bounds(made.model.canopy);
  EXPECT_NEAR(box.lo.x, 0.0, 1e-8);
  EXPECT_NEAR(box.hi.x, 0.06, 1e-8);
  EXPECT_NEAR(box.lo.z, 0.0, 1e-8);
  EXPECT_NEAR(box.hi.z, 0.04, 1e-8);
  EXPECT_NEAR(box.hi.y, 0.015, 1e-8);
  // A single leaf seen edge-on has no width.
  of.scale = 1.0;
  of.canopy = folder_.write("edge.can", "p 1 100001001000 3 0 0 0 0 1 0 0 0 1\n");
  names_.canopy = "edge.can";
  const Scene edge = scene(of);
  EXPECT_DOUBLE_EQ(edge.model.plot.size_x_m, 1.0);
  EXPECT_DOUBLE_EQ(edge.model.plot.size_z_m, 0.01);
  EXPECT_NEAR(bounds(edge.model.canopy).lo.z, 0.005, 1e-8);
}

TEST_F(CaribuScenes, OtherMeshesWithNamesOfSpecies) {
  CaribuSet of = set();
  of.canopy = folder_.write("stand.obj", "v 1 0 1\nv 2 0 1\nv 1 1 1\nusemtl leaf2\nf 1 2 3\nusemtl soil\nf 3 2 1\n");
  names_.canopy = "stand.obj";
  const Scene made = scene(of);
  EXPECT_EQ(made.model.optics[0].upper[0].reflectance, 0.4);
  EXPECT_NEAR(made.model.canopy.corners[0][0].y, 0.0, 1e-6) << "y is up in such a file";
  of.canopy = folder_.write("bark.obj", "v 1 0 1\nv 2 0 1\nv 1 1 1\nusemtl bark\nf 1 2 3\n");
  EXPECT_NE(refusal(of).find("bark.obj: optics \"bark\" (an .opt file describes only"), std::string::npos) << refusal(of);
}

TEST_F(CaribuScenes, RefuseWhatDoesNotFit) {
  CaribuSet of = set();
  of.bands[1].file = folder_ / "one.opt";
  EXPECT_NE(refusal(of).find("stand.can: leaf2 (it belongs to species 2, but "), std::string::npos) << refusal(of);
  EXPECT_NE(refusal(of).find("one.opt has only 1)"), std::string::npos) << refusal(of);
  of = set();
  of.bands[1].name = "PAR";
  EXPECT_NE(refusal(of).find("nir.opt (there is already a band named PAR); "), std::string::npos) << refusal(of);
  of = set();
  of.scale = 1e7;
  EXPECT_NE(refusal(of).find("stand.can (it extends to 6e+07 m, "), std::string::npos) << refusal(of);
  of.scale = 1e-8;
  EXPECT_NE(refusal(of).find("plot.8: a plot of 6e-08 x 4e-08 m (each side must lie in"), std::string::npos) << refusal(of);
  of.domain.reset();
  EXPECT_NE(refusal(of).find("stand.can: a plot of"), std::string::npos) << refusal(of);
  of = set();
  of.domain = folder_.write("far.8", "1e9 0\n1000000001 1\n");
  EXPECT_NE(refusal(of).find("far.8 (its corner lies farther"), std::string::npos) << refusal(of);
  of = set();
  of.light = folder_.write("bright.light", "1e15 0 0 -1\n1e15 1 0 -1\n");
  EXPECT_NE(refusal(of).find("bright.light (its weights sum to 2e+15"), std::string::npos) << refusal(of);
  of = set();
  names_.canopy = "st\xe4nd.can";
  EXPECT_NE(refusal(of).find("cannot name it"), std::string::npos) << refusal(of);
}

TEST_F(CaribuScenes, FileNamesMayHoldQuotes) {
  CaribuSet of = set();
  names_.canopy = "a \"stand\" \\ of \xc3\xa9t\xc3\xa9.can";
  of.canopy = folder_.write(names_.canopy, stand_can);
  const Scene made = scene(of);
  EXPECT_EQ(made.model.canopy.size(), 4U);
  EXPECT_EQ(made.title, "a \"stand\" \\ of \xc3\xa9t\xc3\xa9");
}

TEST(CaribuBands, AreCalledAsTheirFiles) {
  EXPECT_EQ(caribu_band("optics/par.opt").name, "PAR");
  EXPECT_EQ(caribu_band("optics/par.opt").file, "optics/par.opt");
  EXPECT_EQ(caribu_band("maize_NIR.opt").name, "MAIZE_NIR");
  EXPECT_EQ(caribu_band("PAR=maize.opt").name, "PAR");
  EXPECT_EQ(caribu_band("PAR=maize.opt").file, "maize.opt");
  EXPECT_EQ(caribu_band("my=a=b.opt").file, "a=b.opt");
  for (const char* word : {"my file.opt", ".opt=x y",
                           "ma\xc3\xaf"
                           "s.opt"}) {
    SCOPED_TRACE(word);
    expect_refusal([&] { static_cast<void>(caribu_band(word)); }, "--optics NAME=FILE");
  }
}

}  // namespace
}  // namespace sunfleck
