#include "files/scene/mesh_scene.h"

#include "files/scene/scene_reader.h"
#include "support/error_text.h"
#include "support/mesh_files.h"
#include "support/plant_mesh.h"
#include "support/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

const PlantShape bean{.leaves = 5, .height_m = 0.2, .leaf_length_m = 0.12, .leaf_width_m = 0.08, .rise = 0.5};

double area_of(const Canopy& canopy) {
  double area = 0.0;
  for (const Triangle& corners : canopy.corners) area += area_m2(corners);
  return area;
}

Scene made_scene(const TempFolder& folder, const std::vector<std::string>& names) {
  std::vector<MeshToShow> meshes;
  for (const std::string& name : names) meshes.push_back({folder / name, name});
  return read_scene(SceneText{folder / "made.toml", mesh_scene_text(meshes, false), {}});
}

TEST(MeshScene, StandsUprightInMetresOnItsPlot) {
  const TempFolder folder;
  Mesh plant = plant_mesh(bean);
  folder.write("upright.obj", obj_of(plant));
  const double area = area_of(made_scene(folder, {"upright.obj"}).model.canopy);
  for (int turn = 0; turn < 2; ++turn) {
    for (glm::dvec3& v : plant.vertices) v = glm::dvec3(v.z, v.x, v.y) * (turn == 0 ? 1000.0 : 1.0);  // z up, then x up
    folder.write("turned.obj", obj_of(plant));
    const Scene scene = made_scene(folder, {"turned.obj"});
    EXPECT_EQ(scene.warnings, std::vector<std::string>{});
    EXPECT_NEAR(area_of(scene.model.canopy), area, 1e-3 * area);
    const Box box = bounds(scene.model.canopy);
    const glm::dvec3 lo = glm::dvec3(box.lo) + scene.model.canopy.origin_m;
    const glm::dvec3 hi = glm::dvec3(box.hi) + scene.model.canopy.origin_m;
    EXPECT_NEAR(lo.y, 0.0, 1e-6);
    EXPECT_GT(hi.y, 0.199);
    EXPECT_LT(hi.y, 0.25);
    EXPECT_NEAR(lo.x + hi.x, scene.model.plot.size_x_m, 1e-4);  // in the middle
    EXPECT_NEAR(lo.z + hi.z, scene.model.plot.size_z_m, 1e-4);
    EXPECT_GT(lo.x, 0.0);
    EXPECT_LT(scene.model.plot.size_x_m, 2.0 * (hi.x - lo.x));
  }
}

TEST(MeshScene, PutsSeveralMeshesSideBySide) {
  const TempFolder folder;
  folder.write("a.obj", obj_of(plant_mesh(bean)));
  folder.write("b.stl", stl_text_square());
  folder.write("c.can", can_square());
  const Scene scene = made_scene(folder, {"a.obj", "b.stl", "c.can"});
  const Canopy& canopy = scene.model.canopy;
  EXPECT_EQ(canopy.size(), 72U + 2U + 2U);
  std::vector<glm::vec3> middles;
  for (const std::size_t element : {0U, 72U, 74U}) middles.push_back(canopy.corners[element][0]);
  for (std::size_t i = 0; i < middles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(std::max(std::abs(middles[i].x - middles[j].x), std::abs(middles[i].z - middles[j].z)), 0.3F);
}

TEST(MeshScene, LiftsWhatFloatsOrIsBuried) {
  const TempFolder folder;
  for (const double up_m : {-3.0, 0.0, 2.0}) {
    Mesh plant = plant_mesh(bean);
    for (glm::dvec3& v : plant.vertices) v.y += up_m;
    folder.write("a.obj", obj_of(plant));
    const Scene scene = made_scene(folder, {"a.obj"});
    EXPECT_NEAR(bounds(scene.model.canopy).lo.y + scene.model.canopy.origin_m.y, 0.0, 1e-6) << up_m;
  }
}

// Leaves of five triangles on a tube, in a file without materials.
std::string tree_without_materials(const std::string& leaf, const std::string& trunk) {
  std::string text = "o " + trunk + "\nv 0 0 0\nv 0.02 0 0\nv 0.02 0 2\nv 0 0 2\nf 1 2 3\nf 1 3 4\n";
  for (int k = 0; k < 9; ++k) {
    const double z = 1.0 + 0.1 * k;
    text += fmt::format("o {}.{}\nv 0 0 {}\nv 0.2 0 {}\nv 0.2 0.2 {}\nf -3 -2 -1\n", leaf, k, z, z, z);
  }
  return text;
}

TEST(MeshScene, GivesOrgansTheOpticsOfTheirRoles) {
  const TempFolder folder;
  for (const auto& [leaf, trunk] : {std::pair<const char*, const char*>{"leaf", "trunk"}, {"leaf stalk leaf", "leaf stalk"}}) {
    folder.write("tree.obj", tree_without_materials(leaf, trunk));
    const Scene scene = made_scene(folder, {"tree.obj"});
    EXPECT_EQ(scene.warnings, std::vector<std::string>{});
    const RadiationModel& model = scene.model;
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const bool of_leaf = model.canopy.organs[model.canopy.organ_of[e]].name != trunk;
      const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
      EXPECT_EQ(optics.name, of_leaf ? "leaf" : "stem");
      EXPECT_EQ(optics.upper[0].transmittance, of_leaf ? 0.05 : 0.0);
    }
  }
}

TEST(MeshScene, NamesTheOpticsOfAStemByItsRole) {
  const TempFolder folder;
  folder.write("stem.obj", "o stem\nv 0 0 0\nv 0.02 0 0\nv 0.02 0 1\nf 1 2 3\n");
  const Scene scene = made_scene(folder, {"stem.obj"});
  EXPECT_EQ(scene.model.canopy.optics_names, std::vector<std::string>{"stem"});
  EXPECT_EQ(scene.model.optics[0].upper[0].transmittance, 0.0);
}

TEST(MeshScene, QuotesEveryName) {
  const TempFolder folder;
  const std::string name = "my \"best\" plant\\1.obj";
  folder.write(name, "usemtl Blatt \"a\"\\b\n" + obj_of(plant_mesh(bean)));
  const Scene scene = made_scene(folder, {name});
  EXPECT_EQ(scene.model.canopy.optics_names.at(0), "Blatt \"a\"\\b");
}

TEST(MeshScene, RefusesWhatCannotStand) {
  const TempFolder folder;
  folder.write("line.obj", "v 0 0 0\nv 0 1 0\nv 0 2 0\nf 1 2 3\n");
  folder.write("a\nb.obj", obj_square());
  EXPECT_NE(refusal_of([&] { made_scene(folder, {"line.obj"}); }).find("vertical line"), std::string::npos);
  EXPECT_NE(refusal_of([&] { made_scene(folder, {"a\nb.obj"}); }).find("rename it"), std::string::npos);
  EXPECT_NE(refusal_of([&] { made_scene(folder, {"gone.obj"}); }).find("gone.obj"), std::string::npos);
}

}  // namespace
}  // namespace sunfleck
