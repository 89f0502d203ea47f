#include "files/formats/mesh/mesh_reader.h"

#include "base/error.h"
#include "base/file.h"
#include "files/formats/mesh/organ_name.h"
#include "support/error_text.h"
#include "support/mesh_corners.h"
#include "support/mesh_files.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

const Corners square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};

Mesh read_text(const TempFolder& folder, const std::string& name, std::string_view bytes, const MeshImport& import = {}) {
  return read_mesh(folder.write(name, bytes), import);
}

MeshImport as_it_stands(const char* optics = "leaf") {
  return {.optics = optics, .up = FileAxis::y};
}

TEST(MeshReader, EveryFormatGivesTheSameSquare) {
  const TempFolder folder;
  const std::vector<std::pair<std::string, std::string>> files{{"a.obj", obj_square()},
                                                               {"a.can", can_square()},
                                                               {"a.can.gz", gzip(can_square())},
                                                               {"text.stl", stl_text_square()},
                                                               {"binary.stl", stl_binary_square()},
                                                               {"text.ply", ply_text_square()},
                                                               {"little.PLY", ply_binary_square(ByteOrder::little)},
                                                               {"big.ply", ply_binary_square(ByteOrder::big)},
                                                               {"a.dae", dae_square()},
                                                               {"a.glb", glb(gltf_document(), gltf_binary())}};
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(is_mesh_file(name));
    const Mesh mesh = read_text(folder, name, bytes, as_it_stands());
    EXPECT_EQ(corners_of(mesh), square);
    EXPECT_EQ(mesh.optics_names, std::vector<std::string>{"leaf"});
    EXPECT_EQ(mesh.optics_of, (std::vector<std::uint32_t>{0, 0}));
    EXPECT_EQ(mesh.organs.size(), 1U);
    EXPECT_EQ(mesh.organ_of, (std::vector<std::uint32_t>{0, 0}));
  }
  EXPECT_FALSE(is_mesh_file("a.fbx"));
  EXPECT_FALSE(is_mesh_file("a.gz"));
}

TEST(MeshReader, LineEndsOfOtherSystemsChangeNothing) {
  const TempFolder folder;
  for (const std::string ending : {"\r\n", "\r"})
    for (const auto& [name, unix_text] : {std::pair{"a.obj", obj_square()},
                                          {"a.can", can_square()},
                                          {"a.stl", stl_text_square()},
                                          {"a.ply", ply_text_square()}}) {
      SCOPED_TRACE(name);
      std::string text;
      for (const char c : unix_text) text += c == '\n' ? ending : std::string(1, c);
      EXPECT_EQ(corners_of(read_text(folder, name, text, as_it_stands())), square);
    }
}

TEST(MeshReader, TurnsZUpFilesAndScales) {
  const TempFolder folder;
  const std::string text = "v 1 2 3\nv 4 2 3\nv 1 5 3\nusemtl a\nf 1 2 3\n";
  const glm::dvec3 as_y_up(2, 4, 6), as_z_up(-4, 6, -2);
  EXPECT_EQ(read_text(folder, "a.obj", text, {.scale = 2.0}).vertices[0], as_y_up);
  EXPECT_EQ(read_text(folder, "a.obj", text, {.up = FileAxis::z, .scale = 2.0}).vertices[0], as_z_up);
  const std::string can = "p 1 100001001001 3 1 2 3 4 2 3 1 5 3\n";
  EXPECT_EQ(read_text(folder, "a.can", can, {.scale = 2.0}).vertices[0], as_z_up);
  EXPECT_EQ(read_text(folder, "a.can", can, {.up = FileAxis::y, .scale = 2.0}).vertices[0], as_y_up);
}

TEST(MeshReader, CanLabelsGiveOrgans) {
  const TempFolder folder;
  const std::string corners = " 3 0 0 0 1 0 0 1 1 0\n";
  const Mesh mesh = read_text(folder, "a.can",
                              "p 1 100012007001" + corners + "p 1 000000000797" + corners + "p 1 100012000001" + corners +
                                  "p 1 200003000001" + corners + "p 1 299999999999" + corners + "p 1 797" + corners +
                                  "p 1 100012007002" + corners);
  EXPECT_EQ(mesh.organs,
            (std::vector<Organ>{{12, "leaf", 7}, {0, "soil", 0}, {12, "stem", 0}, {3, "stem2", 0}, {99999, "leaf2", 999}}));
  EXPECT_EQ(mesh.organ_of, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 1, 0}));
  EXPECT_EQ(mesh.optics_names, (std::vector<std::string>{"leaf", "soil", "stem", "stem2", "leaf2"}));
  EXPECT_EQ(mesh.optics_of, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 1, 0}));
  EXPECT_EQ(mesh.labels,
            (std::vector<std::uint64_t>{100012007001, 797, 100012000001, 200003000001, 299999999999, 797, 100012007002}));
}

TEST(MeshReader, PolygonsBecomeFansInFileOrder) {
  const TempFolder folder;
  const Corners fan{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {0, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(corners_of(read_text(folder, "a.can", "p 1 100001001001 5 0 0 0 2 0 0 3 1 0 2 2 0 0 2 0 # five\n", as_it_stands())),
            fan);
  EXPECT_EQ(
      corners_of(read_text(folder, "a.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n", as_it_stands())),
      fan);
}

// The fan of a notched square would fold over itself and have half as much area again.
TEST(MeshReader, PolygonsThatAreNotConvexKeepTheirArea) {
  const TempFolder folder;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 0.2 0\nv 0 1 0\nf 1 2 3 4 5\n";
  const std::string can = "p 1 100001001001 5 0 0 0 1 0 0 1 1 0 0.5 0.2 0 0 1 0\n";
  for (const auto& [name, text] : {std::pair{"a.obj", obj}, std::pair{"a.can", can}}) {
    const Corners cut = corners_of(read_text(folder, name, text, as_it_stands()));
    ASSERT_EQ(cut.size(), 9U) << name;
    double area = 0.0;
    for (std::size_t k = 0; k < cut.size(); k += 3)
      area += 0.5 * glm::length(glm::cross(cut[k + 1] - cut[k], cut[k + 2] - cut[k]));
    EXPECT_NEAR(area, 0.6, 1e-12) << name;
  }
  std::string comb = "v 0 0 0\n", face = "f 1";
  for (int k = 1; k <= 1200; ++k) {
    comb += "v " + std::to_string(k) + (k % 2 == 0 ? " 9 0\n" : " 1 0\n");
    face += ' ' + std::to_string(k + 1);
  }
  expect_refusal([&] { static_cast<void>(read_text(folder, "comb.obj", comb + face + '\n', as_it_stands())); },
                 "a polygon of 1201 corners that is not convex");
}

TEST(MeshReader, ObjNumbersAndNegativeIndices) {
  const TempFolder folder;
  const Mesh mesh = read_text(folder, "a.obj",
                              "v +0.1 1e-400 -.5\nv 1 0 0 1 0.5 0.5 0.5\nv\t1 1 0\nf -3/1/1 -2/2/2 -1/3/3\n"
                              "v 5 5 5\nf 5 -1 1\nv 6 6 6",
                              as_it_stands());
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.vertices[0], glm::dvec3(0.1, 0.0, -0.5));
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(4, 3, 0));  // vertex 5 comes after its face
}

TEST(MeshReader, ObjMaterialsAndGroups) {
  const TempFolder folder;
  const Mesh mesh = read_text(folder, "a.obj",
                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\no plant2_stem\nusemtl green bark \nf 1 2 3\n"
                              "g odd plant2_leaf4\nf 1 2 3\ng other\nf 1 2 3\no thing\nf 1 2 3\n",
                              as_it_stands("plain"));
  EXPECT_EQ(mesh.optics_names, (std::vector<std::string>{"plain", "green bark"}));
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "plain", 0}, {2, "stem", 0}, {2, "leaf", 4}, {1, "thing", 0}}));
  EXPECT_EQ(mesh.organ_of, (std::vector<std::uint32_t>{0, 1, 2, 1, 3}));
}

// Groups before objects tell no faces apart, and are not counted as if they did.
TEST(MeshReader, ObjObjectsEndGroups) {
  const TempFolder folder;
  const Mesh mesh =
      read_text(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\ng one\no a\nf 1 2 3\ng two\no b\nf 1 2 3\ng three\nf 1 2 3\n",
                as_it_stands("plain"));
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "a", 0}, {1, "b", 0}}));
}

// Programs write nan where they know no value of a property.
TEST(MeshReader, PlyValuesThatAreNotUsed) {
  const TempFolder folder;
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nproperty float area\nend_header\n";
  const std::string corners = "0 0 0 nan\n1 0 0 -inf\n0 1 0 none\n3 0 1 2 nan\n";
  const Mesh mesh = read_text(folder, "a.ply", head + "property float scalar\n" + faces + corners, as_it_stands("plain"));
  EXPECT_EQ(mesh.triangles.size(), 1U);
  const std::string used = head + "property float red\n" + faces + corners;
  EXPECT_NE(refusal_of([&] {
              static_cast<void>(read_text(folder, "b.ply", used, as_it_stands("plain")));
            }).find("b.ply:12: 'nan' (not a finite number)"),
            std::string::npos);
}

TEST(MeshReader, NodeNamesGiveOrgans) {
  EXPECT_EQ(organ_from_name("plant1_leaf7"), (Organ{1, "leaf", 7}));
  EXPECT_EQ(organ_from_name("plant12_leaf7.001"), (Organ{12, "leaf", 7}));
  EXPECT_EQ(organ_from_name("plant1_leaf2_7"), (Organ{1, "leaf2", 7}));
  EXPECT_EQ(organ_from_name("plant1_scar_-2"), (Organ{1, "scar", -2}));
  EXPECT_EQ(organ_from_name("plant0_soil"), (Organ{0, "soil", 0}));
  EXPECT_EQ(organ_from_name("Plant2_Leaf03"), (Organ{2, "Leaf", 3}));
  for (const char* name : {"", "leaf7", "plant_leaf7", "plant1", "plant1_", "plant1_7", "plantx_leaf", "plant-1_leaf7",
                           "plant99999999999_leaf", "plant1_leaf99999999999"})
    EXPECT_FALSE(organ_from_name(name)) << name;
}

TEST(MeshReader, TrianglesWithoutAreaAreKept) {
  const TempFolder folder;
  EXPECT_EQ(read_text(folder, "a.can", "p 1 100001001001 3 1 1 1 1 1 1 -0.0 1 1\n").triangles.size(), 1U);
}

TEST(MeshReader, GzipOfSeveralMembers) {
  const TempFolder folder;
  const std::string line = "p 1 100001001001 3 0 0 0 1 0 0 1 1 0\n";
  EXPECT_EQ(read_text(folder, "a.can.gz", gzip(line) + gzip(line + line)).triangles.size(), 3U);
}

TEST(MeshReader, ManyTrianglesOfACompressedFile) {
  const TempFolder folder;
  std::string text;
  const int count = 100000;  // several times the first output buffer of the decompression
  for (int i = 0; i < count; ++i)
    text += "p 1 1000010" + std::to_string(10 + i % 90) + "001 3 0 0 " + std::to_string(i) + " 1 0 0 1 1 0\n";
  const Mesh mesh = read_text(folder, "a.can.gz", gzip(text), as_it_stands());
  ASSERT_EQ(mesh.triangles.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(mesh.organs.size(), 90U);
  for (int i = 0; i < count; ++i)
    ASSERT_EQ(mesh.vertices[mesh.triangles[static_cast<std::size_t>(i)][0]].z, static_cast<double>(i));
}

TEST(File, IsWrittenWholeAndReadBack) {
  const TempFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(folder / "x.bin", "something longer");
  write_file(folder / "x.bin", bytes);
  EXPECT_EQ(read_file(folder / "x.bin"), bytes);
  write_file(folder / "empty", "");
  EXPECT_EQ(read_file(folder / "empty"), "");
  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) entries += entry.exists() ? 1 : 0;
  EXPECT_EQ(entries, 2U) << "something was left aside";
}

TEST(File, SaysWhyItCannotWrite) {
  const TempFolder folder;
  expect_refusal([&] { write_file(folder / "nowhere/x.csv", "a"); },
                 "x.csv: cannot be written (No such file or directory); create its folder first", ErrorKind::failure);
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THROW(write_file(folder / "taken", "a"), Error);
  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) entries += entry.exists() ? 1 : 0;
  EXPECT_EQ(entries, 1U) << "something was left aside";
}

}  // namespace
}  // namespace sunfleck
