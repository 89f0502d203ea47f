#include "files/formats/mesh/mesh_writer.h"

#include "base/error.h"
#include "base/file.h"
#include "files/formats/mesh/mesh_reader.h"
#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace sunfleck {
namespace {

// Identifies a triangle by its content, whatever its place and numbering in the mesh.
using Key = std::tuple<std::uint32_t, std::string, int, std::string, std::array<float, 9>>;

std::vector<Key> keys(const Mesh& mesh) {
  std::vector<Key> all;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Organ& organ = mesh.organs[mesh.organ_of[i]];
    std::array<float, 9> corners{};
    auto coordinate = corners.begin();
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) *coordinate++ = static_cast<float>(mesh.vertices[mesh.triangles[i][corner]][axis]);
    all.emplace_back(organ.plant, organ.name, organ.rank, mesh.optics_names[mesh.optics_of[i]], corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Returns 300 triangles over 200 shared vertices, with organs and optics mixed at random.
Mesh random_mesh() {
  std::mt19937 random(20240611);
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  Mesh mesh;
  mesh.organs = {{0, "soil", 0},           {1, "leaf", 7},          {1, "leaf2", 7},
                 {4000000000U, "stem", 0}, {2, "odd \"name\"", -3}, {3, "none", 1}};
  mesh.optics_names = {"leaf", "bark of ash", "unused", "Blütenblatt"};
  for (int i = 0; i < 200; ++i) mesh.vertices.emplace_back(below(1000) / 7.0, below(1000) / 3.0, below(1000) * -1e-5);
  for (int i = 0; i < 300; ++i) {
    mesh.triangles.emplace_back(below(200), below(200), below(200));
    mesh.organ_of.push_back(below(5));
    mesh.optics_of.push_back(std::array{0U, 1U, 3U}[below(3)]);
  }
  return mesh;
}

TEST(MeshWriter, KeepsTheShapeOfAMeshFarFromZero) {
  const TempFolder folder;
  Mesh mesh = random_mesh();
  for (glm::dvec3& vertex : mesh.vertices) vertex = 1e-3 * vertex + glm::dvec3(500000.0, 0.0, 4.2e6);  // as in UTM
  for (const char* name : {"a.glb", "a.gltf"}) {
    write_mesh(mesh, folder / name);
    const Mesh back = read_mesh(folder / name, {});
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
    glm::dvec3 lo(1e9), hi(-1e9);
    for (const glm::dvec3& vertex : back.vertices) {
      lo = glm::min(lo, vertex);
      hi = glm::max(hi, vertex);
    }
    EXPECT_NEAR(lo.x, 500000.0, 1e-3) << name;
    EXPECT_NEAR(hi.x - lo.x, 0.999 / 7.0, 2e-3) << name;
    EXPECT_NEAR(hi.z, 4.2e6, 1e-6) << name;
  }
}

TEST(MeshWriter, RoundTripIsExactInSinglePrecision) {
  const TempFolder folder;
  const Mesh mesh = random_mesh();
  for (const char* name : {"a.glb", "a.gltf"}) {
    SCOPED_TRACE(name);
    write_gltf(mesh, folder / name);
    const Mesh back = read_mesh(folder / name, {});
    EXPECT_EQ(keys(back), keys(mesh));
    EXPECT_EQ(back.organs, (std::vector<Organ>(mesh.organs.begin(), mesh.organs.end() - 1))) << "an empty organ is left out";
    write_gltf(back, folder / name);
    const Mesh again = read_mesh(folder / name, {});
    EXPECT_EQ(again.triangles, back.triangles) << "written in its own order a mesh keeps it";
    EXPECT_EQ(again.vertices, back.vertices);
    EXPECT_EQ(again.organ_of, back.organ_of);
  }
}

TEST(MeshWriter, SharesVerticesWithinAnOrgan) {
  const TempFolder folder;
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}};
  mesh.organs = {{1, "leaf", 7}, {1, "stem", 0}};
  mesh.optics_names = {"a", "b"};
  mesh.organ_of = {0, 0, 1};
  mesh.optics_of = {0, 1, 0};
  write_gltf(mesh, folder / "a.gltf");
  const auto document = nlohmann::json::parse(read_file(folder / "a.gltf"));
  ASSERT_EQ(document["nodes"].size(), 2U);
  EXPECT_EQ(document["nodes"][0]["name"], "plant1_leaf7");
  EXPECT_EQ(document["nodes"][1]["name"], "plant1_stem");
  EXPECT_EQ(document["nodes"][0]["extras"], nlohmann::json({{"plant", 1}, {"organ", "leaf"}, {"rank", 7}}));
  const auto& primitives = document["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2U) << "one for each optics";
  EXPECT_EQ(primitives[0]["attributes"]["POSITION"], primitives[1]["attributes"]["POSITION"]);
  const auto& positions = document["accessors"][primitives[0]["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(positions["count"], 4);
  EXPECT_EQ(positions["max"], nlohmann::json({1.0, 1.0, 0.0}));
  EXPECT_EQ(document["materials"][1]["name"], "b");
  EXPECT_EQ(read_mesh(folder / "a.gltf", {}).vertices.size(), 7U);
}

TEST(MeshWriter, EmptyMeshMakesAFileWithoutTriangles) {
  const TempFolder folder;
  for (const char* name : {"a.glb", "a.gltf"}) {
    write_gltf({}, folder / name);
    expect_refusal([&] { static_cast<void>(read_mesh(folder / name, {})); }, "no triangles found");
  }
}

TEST(MeshWriter, RefusesOtherEndingsAndFoldersThatAreNotThere) {
  const TempFolder folder;
  const auto expect_refused = [&](const char* name, ErrorKind kind) {
    refusal_of([&] { write_gltf(random_mesh(), folder / name); }, kind);
  };
  expect_refused("a.obj", ErrorKind::input);
  expect_refused("glb", ErrorKind::input);
  expect_refused("gone/a.glb", ErrorKind::failure);
}

}  // namespace
}  // namespace sunfleck
