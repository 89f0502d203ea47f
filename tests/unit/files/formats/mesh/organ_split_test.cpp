#include "files/formats/mesh/organ_split.h"

#include "base/log.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/formats/mesh/mesh_writer.h"
#include "support/mesh_files.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunfleck {
namespace {

// Returns the organ of each triangle as `name rank`.
std::vector<std::string> organs_of(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const std::uint32_t number : mesh.organ_of)
    names.push_back(mesh.organs.at(number).name + " " + std::to_string(mesh.organs[number].rank));
  return names;
}

using Names = std::vector<std::string>;

Mesh read_split(const TempFolder& folder, const std::string& name, std::string_view bytes, OrganSplit split = OrganSplit::names,
                const char* optics = "leaf") {
  return read_mesh(folder.write(name, bytes), {.optics = optics, .split = split});
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Organs, EveryObjectOfAnObjIsAnOrgan) {
  const TempFolder folder;
  const Mesh mesh = read_split(folder, "a.obj",
                               corners +
                                   "o trunk.007\nusemtl bark\nf 1 2 3\no Cube\nusemtl green\nf 1 2 3\nusemtl red\nf 1 3 4\n"
                                   "o trunk.007\nusemtl bark\nf 1 3 4\n");
  EXPECT_EQ(organs_of(mesh), (Names{"trunk.007 0", "Cube 0", "Cube 0", "trunk.007 0"})) << "a name may recur";
  EXPECT_EQ(mesh.organs.size(), 2U);
}

TEST(Organs, OfObjectsAndGroupsThoseThatTellMoreApartCount) {
  const TempFolder folder;
  const std::string groups = corners + "o plant\ng leaf a\nf 1 2 3\ng leaf b\nf 1 3 4\ng default\nf 1 2 4\n";
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", groups)), (Names{"leaf a 0", "leaf b 0", "plant 0"}));
  const std::string objects = corners + "o one\ng plant\nf 1 2 3\no two\ng plant\nf 1 3 4\n";
  EXPECT_EQ(organs_of(read_split(folder, "b.obj", objects)), (Names{"one 0", "two 0"}));
}

TEST(Organs, ASingleObjectIsCutByItsMaterials) {
  const TempFolder folder;
  const std::string text = corners + "o maize\nusemtl leaf\nf 1 2 3\nusemtl stem\nf 1 3 4\n";
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", text)), (Names{"leaf 0", "stem 0"}));
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", corners + "o maize\nusemtl leaf\nf 1 2 3\n")), Names{"maize 0"});
  const std::string second = text + "o weed\nf 1 2 4\n";
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", second)), (Names{"maize 0", "maize 0", "weed 0"}));
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", second, OrganSplit::materials)),
            (Names{"maize leaf 0", "maize stem 0", "weed 0"}));
}

TEST(Organs, PartsShareCornersByPosition) {
  const TempFolder folder;
  // Two triangles that touch with other vertices at the same place, one apart, one of another material at that place.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv -1 0 0\nv 0 -1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\n"
      "usemtl leaf\nf 1 2 3\nf 7 8 9\nf 4 5 6\nusemtl stem\nf 1 2 3\n";
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", text, OrganSplit::parts)), (Names{"leaf 1", "leaf 2", "leaf 1", "stem 0"}));
  const std::string named = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\no plant1_leaf7\nf 1 2 3\nf 4 5 6\n";
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", named, OrganSplit::parts)), (Names{"leaf 1 7", "leaf 2 7"}))
      << "the rank is the leaf's";
  const Mesh one = read_split(folder, "a.obj", named + "o plant1_leaf\nf 1 2 3\nf 4 5 6\n", OrganSplit::parts);
  EXPECT_EQ(organs_of(one), (Names{"leaf 1 7", "leaf 2 7", "leaf 1 0", "leaf 2 0"}));
}

TEST(Organs, PartsOfAMeshFromMemory) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.optics_of = mesh.organ_of = {0, 0};
  mesh.optics_names = {"leaf"};
  mesh.organs = {{3, "leaf", 0}};
  const Mesh split = import_mesh(mesh, "leaves", {.split = OrganSplit::parts});
  EXPECT_EQ(split.organs, (std::vector<Organ>{{3, "leaf", 1}, {3, "leaf", 2}}));
}

TEST(Organs, SolidsOfAnStl) {
  const TempFolder folder;
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";
  const std::string text = "solid upper leaf\n" + facet + "endsolid\nsolid\n" + facet + "endsolid\nsolid upper leaf\n" + facet +
                           "endsolid\nsolid plant2_leaf3\n" + facet + "endsolid\n";
  const Mesh mesh = read_split(folder, "a.stl", text);
  EXPECT_EQ(organs_of(mesh), (Names{"upper leaf 0", "leaf 0", "upper leaf 2 0", "leaf 3"}));
  EXPECT_EQ(mesh.organs.back().plant, 2U);
}

TEST(Organs, NodesOfAGltf) {
  const TempFolder folder;
  nlohmann::json document = gltf_document();
  document["nodes"] = nlohmann::json::parse(R"([
    {"name": "plant", "children": [1, 2, 3, 4]}, {"mesh": 0, "name": "Leaf"}, {"mesh": 0, "name": "Leaf"}, {"mesh": 0},
    {"children": [5], "extras": {"plant": 6}}, {"mesh": 0, "name": "Leaf"}])");
  document["scenes"][0]["nodes"] = {0};
  document["meshes"][0].erase("name");
  const Mesh mesh = read_mesh(folder.write("a.glb", glb(document, gltf_binary())), {.optics = "leaf"});
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "Leaf", 0}, {1, "Leaf 2", 0}, {1, "plant", 0}, {6, "Leaf", 0}}));
}

TEST(Organs, NamesThatATableCannotHold) {
  const TempFolder folder;
  EXPECT_EQ(organs_of(read_split(folder, "a.obj", corners + "o Bl\xfctenblatt\nf 1 2 3\n")), Names{"Bl\xc3\xbctenblatt 0"});
  EXPECT_EQ(organs_of(read_split(folder, "b.obj", corners + "o ear\x1b[1m\nf 1 2 3\n")), Names{"ear?[1m 0"});
}

std::string coloured_ply(const std::string& vertex, const std::string& vertices, const std::string& face,
                         const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + vertex +
         "element face 2\nproperty list uchar int vertex_indices\n" + face + "end_header\n" + vertices + faces;
}

const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
const std::string plain_vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Organs, ColoursOfAPlyNameOrgansAndMaterials) {
  const TempFolder folder;
  const std::string faces = coloured_ply("", plain_vertices, rgb, "3 0 1 2 30 60 10\n3 0 2 3 65 45 15\n");
  const Mesh mesh = read_mesh(folder.write("a.ply", faces), {});
  EXPECT_EQ(organs_of(mesh), (Names{"colour_1e3c0a 0", "colour_412d0f 0"}));
  EXPECT_EQ(mesh.optics_names, (Names{"colour_1e3c0a", "colour_412d0f"}));
  const Mesh leaf = read_split(folder, "a.ply", faces);
  EXPECT_EQ(organs_of(leaf), organs_of(mesh));
  EXPECT_EQ(leaf.optics_names, Names{"leaf"}) << "the scene's optics, where it gives any";
  MeshImport converted{.optics = "leaf"};
  converted.keeps_colours = true;
  EXPECT_EQ(read_mesh(folder / "a.ply", converted).optics_names, mesh.optics_names);
  const std::string diffuse = "property float diffuse_red\nproperty float diffuse_green\nproperty float diffuse_blue\n";
  const Mesh by_vertex =
      read_split(folder, "b.ply",
                 "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                 "property float z\n" +
                     diffuse +
                     "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0\n"
                     "1 0 0 1 0 0\n1 1 0 1 0 0\n0 0 0 0 .5 0\n1 0 0 0 .5 0\n1 1 0 0 .5 0\n3 0 1 2\n3 3 4 5\n");
  EXPECT_EQ(organs_of(by_vertex), (Names{"colour_ff0000 0", "colour_008000 0"}));
}

TEST(Organs, ColoursThatAreNoOrgans) {
  const TempFolder folder;
  const std::string mixed = coloured_ply(rgb, "0 0 0 1 2 3\n1 0 0 1 2 3\n1 1 0 1 2 3\n0 1 0 9 9 9\n", "", "3 0 1 2\n3 0 2 3\n");
  ::testing::internal::CaptureStderr();
  start_log(Verbosity::normal);
  EXPECT_EQ(organs_of(read_split(folder, "a.ply", mixed)), (Names{"leaf 0", "leaf 0"}));
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("corners of different colours in 1 of its faces"), std::string::npos);
  const std::string one = coloured_ply("", plain_vertices, rgb, "3 0 1 2 30 60 10\n3 0 2 3 30 60 10\n");
  EXPECT_EQ(organs_of(read_split(folder, "a.ply", one)), (Names{"leaf 0", "leaf 0"}));
  std::string many =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 65\nproperty list uchar int vertex_indices\n" +
      rgb + "end_header\n0 0 0\n1 0 0\n1 1 0\n";
  for (int i = 0; i < 65; ++i) many += "3 0 1 2 0 0 " + std::to_string(i) + "\n";
  EXPECT_EQ(read_split(folder, "a.ply", many).organs.size(), 1U) << "a scan";
}

// Names that end like ranks or like the suffixes of editors survive every format that holds names.
TEST(Organs, NamesSurviveConversion) {
  const TempFolder folder;
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.optics_names = {"leaf"};
  for (const char* name :
       {"leaf.351", "Circle.166_Circle.168", "a_", "a.", "a-", "7", "leaf 2", "colour_1e3c04", "x_-3", "plant1"})
    for (const int rank : {0, 4, -2}) mesh.organs.push_back({2, name, rank});
  for (std::uint32_t i = 0; i < mesh.organs.size(); ++i) {
    mesh.triangles.emplace_back(0, 1, 2);
    mesh.organ_of.push_back(i);
    mesh.optics_of.push_back(0);
  }
  for (const char* name : {"a.obj", "a.ply", "a.glb", "a.gltf"}) {
    write_mesh(mesh, folder / name);
    EXPECT_EQ(read_mesh(folder / name, {}).organs, mesh.organs) << name;
  }
}

}  // namespace
}  // namespace sunfleck
