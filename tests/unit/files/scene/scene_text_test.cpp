// Tests scenes given as text in memory, with meshes given as triangles.

#include "support/scene_text.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

namespace sunfleck::test {
namespace {

const std::string text_head =
    "[plot]\nsize = [1.0, 1.0]\n[sun]\nelevation = 60.0\nazimuth = 90.0\n[[band]]\nname = \"PAR\"\ndirect = 100.0\n"
    "[optics.leaf]\nreflectance = 0.1\n";

Scene read(const Mesh& mesh, const std::string& more = "") {
  return read_scene(SceneText{"given.toml", text_head + "[[geometry]]\nmesh = \"a\"\n" + more, {{"a", mesh}}});
}

TEST(SceneText, HoldsAMesh) {
  const Scene scene = read(one_leaf());
  ASSERT_EQ(scene.model.canopy.size(), 1U);
  EXPECT_EQ(scene.model.canopy.organs.front(), (Organ{3, "leaf", 7}));
  EXPECT_EQ(scene.title, "given");
  EXPECT_NEAR(area_m2(scene.model.canopy.corners.front()), 0.18, 1e-6);
}

TEST(SceneText, TurnsAMeshToTheAxesOfTheScene) {
  const std::string text = "axes = \"east-north-up\"\n" + text_head + "[[geometry]]\nmesh = \"a\"\n";
  const auto first_corner = [&](const std::string& more) {
    const Scene scene = read_scene(SceneText{"given.toml", text + more, {{"a", one_leaf()}}});
    return scene.model.canopy.corners.front()[0];
  };
  // (0.2, 0.5, 0.2) is 0.2 m east and 0.5 m north of the south-west corner, at a height of 0.2 m.
  EXPECT_NEAR(glm::distance(first_corner(""), glm::vec3(0.5F, 0.2F, 0.8F)), 0.0F, 1e-6F);
  EXPECT_EQ(first_corner("up = \"z\"\n"), first_corner(""));
  EXPECT_NEAR(glm::distance(first_corner("up = \"y\"\nat = [[0, 0.5, 0]]\n"), glm::vec3(0.7F, 0.5F, 0.8F)), 0.0F, 1e-6F);
}

TEST(SceneText, KeepsItsAxesInNewLight) {
  Scene scene = read(one_leaf());
  expect_refusal(
      [&] {
        relight(scene, {"given.toml", "axes = \"east-north-up\"\n" + text_head, {}});
      },
      "axes differs from the scene");
}

TEST(SceneText, PlacesAMeshLikeAFile) {
  const Scene scene = read(one_leaf(), "up = \"z\"\nscale = 0.5\nat = [[0, 0, 0], [0.1, 0, 0]]\n");
  EXPECT_EQ(scene.model.canopy.size(), 2U);
  EXPECT_NEAR(area_m2(scene.model.canopy.corners.front()), 0.045, 1e-6);
  EXPECT_NEAR(unit_normal(scene.model.canopy.corners.front()).x, -1.0, 1e-6) << "z-up: y = north = -X";
}

TEST(SceneText, IsMarkedByItsMeshes) {
  Mesh other = one_leaf();
  other.vertices[0].y += 1e-9;
  EXPECT_EQ(read(one_leaf()).digest, read(one_leaf()).digest);
  EXPECT_NE(read(one_leaf()).digest, read(other).digest);
  other = one_leaf();
  other.organs[0].rank = 8;
  EXPECT_NE(read(one_leaf()).digest, read(other).digest);
}

TEST(SceneText, RefusesMeshesThatDoNotFitTogether) {
  const auto refused = [](const auto& change, const std::string& words) {
    Mesh mesh = one_leaf();
    change(mesh);
    const std::string message = expect_refusal([&] { static_cast<void>(read(mesh)); }, words);
    EXPECT_EQ(message.rfind("given.toml:12: geometry.mesh", 0), 0U) << message;
  };
  refused([](Mesh& mesh) { mesh.triangles.clear(); }, "no triangle");
  refused([](Mesh& mesh) { mesh.triangles[0].y = 3; }, "vertex number 3 of triangle 0");
  refused([](Mesh& mesh) { mesh.optics_of[0] = 1; }, "optics number 1 of triangle 0");
  refused([](Mesh& mesh) { mesh.optics_of.push_back(0); }, "2 optics numbers");
  refused([](Mesh& mesh) { mesh.organ_of.clear(); }, "0 organ numbers");
  refused([](Mesh& mesh) { mesh.organ_of[0] = 9; }, "organ number 9 of triangle 0");
  refused([](Mesh& mesh) { mesh.labels = {1, 2}; }, "2 labels");
  for (int axis = 0; axis < 3; ++axis) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e39}) {
      refused([&](Mesh& mesh) { mesh.vertices[1][axis] = bad; }, "must be finite");
    }
  }
}

TEST(SceneText, WantsOneSourceOfTriangles) {
  for (const char* more : {"file = \"plates.obj\"\n", "generator = \"maize\"\n"}) {
    expect_refusal([&] { static_cast<void>(read(one_leaf(), more)); }, "is also given");
  }
  expect_refusal(
      [] {
        static_cast<void>(read_scene(SceneText{"given.toml", text_head + "[[geometry]]\nmesh = \"b\"\n", {{"a", one_leaf()}}}));
      },
      "no mesh of that name");
}

TEST(SceneText, HasNoMeshesInAFile) {
  expect_refusal(
      [] {
        static_cast<void>(read_scene(SceneText{"given.toml", text_head + "[[geometry]]\nmesh = \"a\"\n", {}}));
      },
      "mesh");
}

}  // namespace
}  // namespace sunfleck::test
