// Tests meshes that are written as OBJ, PLY and .can, and read back.

#include "files/formats/mesh/mesh_text.h"

#include "base/error.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/formats/mesh/mesh_writer.h"
#include "support/error_text.h"
#include "support/mesh_corners.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

// Returns 200 triangles over 100 shared vertices, with digits that only double precision holds and optics that labels can
// express.
Mesh labelled_mesh() {
  std::mt19937 random(20261122);
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  Mesh mesh;
  mesh.organs = {{0, "soil", 0}, {1, "leaf", 7}, {99999, "leaf2", 999}, {3, "stem2", 0}, {12, "stem", 0}};
  mesh.optics_names = {"soil", "leaf", "leaf2", "stem2", "stem"};
  for (int i = 0; i < 100; ++i) mesh.vertices.emplace_back(below(1000) / 7.0 - 50.0, below(1000) / 3.0, below(1000) * -1e-5);
  for (int i = 0; i < 200; ++i) {
    mesh.triangles.emplace_back(below(100), below(100), below(100));
    mesh.organ_of.push_back(below(5));
    mesh.optics_of.push_back(mesh.organ_of.back());
  }
  return mesh;
}

std::vector<std::string> optics_in_order(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const std::uint32_t optics : mesh.optics_of) names.push_back(mesh.optics_names[optics]);
  return names;
}

std::vector<Organ> organs_in_order(const Mesh& mesh) {
  std::vector<Organ> organs;
  for (const std::uint32_t organ : mesh.organ_of) organs.push_back(mesh.organs[organ]);
  return organs;
}

TEST(MeshText, RoundTripsAreExact) {
  const TempFolder folder;
  const Mesh mesh = labelled_mesh();
  for (const char* name : {"a.obj", "a.can", "a.CAN", "a.Obj", "a.ply"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(is_writable_mesh(name));
    write_mesh(mesh, folder / name);
    const Mesh back = read_mesh(folder / name, {});
    EXPECT_EQ(corners_of(back), corners_of(mesh));
    EXPECT_EQ(optics_in_order(back), optics_in_order(mesh));
    EXPECT_EQ(organs_in_order(back), organs_in_order(mesh));
  }
}

TEST(MeshText, PlyNamesOrgansAndOptics) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.organs = {{1, "stem", 0}, {4, "leaf", 7}};
  mesh.optics_names = {"bark", "green leaf"};
  mesh.organ_of = {1};
  mesh.optics_of = {1};
  const std::string bytes = ply_mesh_bytes(mesh);
  EXPECT_NE(bytes.find("comment organ 1 plant4_leaf7\n"), std::string::npos);
  EXPECT_NE(bytes.find("comment optics 1 green leaf\n"), std::string::npos);
  EXPECT_NE(bytes.find("element face 1\n"), std::string::npos);
  const std::size_t body = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.size() - body, 3 * 24 + 1 + 12 + 16U);
  std::uint32_t plant = 0;
  bytes.copy(reinterpret_cast<char*>(&plant), 4, body + 72 + 13);
  EXPECT_EQ(plant, 4U);
}

TEST(MeshText, CanLabelsAreTheMeshsOwn) {
  Mesh mesh = labelled_mesh();
  mesh.labels.assign(mesh.triangles.size(), no_label);
  mesh.organ_of[0] = mesh.optics_of[0] = 1;
  mesh.labels[0] = 100001007456;
  const std::string text = can_text(mesh);
  const std::size_t first = text.find("p 1 ");
  EXPECT_EQ(text.substr(first, 17), "p 1 100001007456 ");
  EXPECT_EQ(text.find("-0 "), std::string::npos) << "no negative zero";
}

TEST(MeshText, ACanKnowsLeavesAndStems) {
  Mesh mesh = labelled_mesh();
  EXPECT_TRUE(optics_lost_in_can(mesh).empty());
  mesh.optics_names = {"soil2", "leaf", "leaf10", "green", "stem"};
  EXPECT_EQ(optics_lost_in_can(mesh), (std::vector<std::string>{"soil2", "leaf10", "green"}));
  // In the file a sheath with a leaf's optics becomes a leaf; an organ that is neither becomes a stem.
  mesh.organs.assign(5, {1, "sheath", 0});
  mesh.optics_names = {"soil", "leaf", "leaf2", "green", "stem"};
  const TempFolder folder;
  write_mesh(mesh, folder / "a.can");
  std::vector<std::string> expected = optics_in_order(mesh);
  for (std::string& name : expected)
    if (name == "green") name = "stem";
  EXPECT_EQ(optics_in_order(read_mesh(folder / "a.can", {})), expected);
}

// A material without a word for a part of a plant says nothing about the part.
TEST(MeshText, ACanTakesThePartFromTheOrganWhereTheMaterialNamesNone) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.triangles.assign(3, {0, 1, 2});
  mesh.organs = {{1, "leaf", 3}, {1, "culm", 0}, {2, "ear", 0}};
  mesh.optics_names = {"green", "brown", "leaf2"};
  mesh.organ_of = mesh.optics_of = {0, 1, 2};
  const std::string text = can_text(mesh);
  for (const char* label : {"p 1 100001003000 3 ", "p 1 100001000000 3 ", "p 1 200002001000 3 "})
    EXPECT_NE(text.find(label), std::string::npos) << text;
}

// In a plant without leaves, what no name describes is a leaf, as in a run.
TEST(MeshText, ACanHasLeavesWhereNamesSayNothing) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.triangles.assign(4, {0, 1, 2});
  mesh.organs = {{1, "feuille_0", 0}, {1, "feuille_3", 3}, {2, "feuille_0", 0}, {2, "leaf", 4}};
  mesh.optics_names = {"vert"};
  mesh.organ_of = {0, 1, 2, 3};
  mesh.optics_of = {0, 0, 0, 0};
  const std::string text = can_text(mesh);
  for (const char* label : {"p 1 100001001000 3 ", "p 1 100001003000 3 ", "p 1 100002000000 3 ", "p 1 100002004000 3 "})
    EXPECT_NE(text.find(label), std::string::npos) << text;
}

TEST(MeshText, RefusesWhatHasNoPlace) {
  const TempFolder folder;
  const auto message = [&](const Mesh& mesh, const char* name, ErrorKind kind = ErrorKind::input) {
    return refusal_of([&] { write_mesh(mesh, folder / name); }, kind);
  };
  EXPECT_NE(message(labelled_mesh(), "a.stl")
                .find("a.stl: unknown kind of mesh (its name ends in '.stl'); use a name that ends in .glb"),
            std::string::npos);
  EXPECT_FALSE(is_writable_mesh("a.can.gz"));
  EXPECT_NE(message(labelled_mesh(), "gone/a.obj", ErrorKind::failure).find("gone/a.obj"), std::string::npos);
  Mesh mesh = labelled_mesh();
  mesh.organs[1].plant = 100'000;
  EXPECT_NE(message(mesh, "a.can", ErrorKind::failure).find("plant 100000 has no label ("), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.can"));
}

}  // namespace
}  // namespace sunfleck
