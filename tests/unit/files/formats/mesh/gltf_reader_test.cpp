// Tests what mesh_reader.h promises for glTF and GLB beyond the other formats.

#include "base/error.h"
#include "base/log.h"
#include "files/formats/mesh/mesh_reader.h"
#include "support/error_text.h"
#include "support/mesh_files.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

using nlohmann::json;

Mesh read_glb(const json& document, const MeshImport& import = {}, const std::string& binary = gltf_binary()) {
  const TempFolder folder;
  return read_mesh(folder.write("a.glb", glb(document, binary)), import);
}

glm::dvec3 corner(const Mesh& mesh, std::size_t triangle, int number) {
  return mesh.vertices[mesh.triangles[triangle][number]];
}

glm::dvec3 normal(const Mesh& mesh, std::size_t triangle) {
  const glm::dvec3 a = corner(mesh, triangle, 0);
  return glm::normalize(glm::cross(corner(mesh, triangle, 1) - a, corner(mesh, triangle, 2) - a));
}

// Tolerates the rounding of positions and transforms, which pass through sums of products of numbers near 1 in double
// precision.
void expect_near(const glm::dvec3& got, const glm::dvec3& expected) {
  EXPECT_LT(glm::distance(got, expected), 1e-14) << got.x << " " << got.y << " " << got.z;
}

TEST(GltfReader, TransformsFollowTheNodeTree) {
  json document = gltf_document();
  const double half = std::sqrt(0.5);
  // A quarter turn about Y takes +X to -Z; the child's matrix doubles, then moves by (0, 1, 0).
  document["nodes"] = json::parse(R"([{"children": [1], "translation": [10, 0, 0]},
                                      {"mesh": 0, "matrix": [2,0,0,0, 0,2,0,0, 0,0,2,0, 0,1,0,1]}])");
  document["nodes"][0]["rotation"] = {0.0, half, 0.0, half};
  const Mesh mesh = read_glb(document);
  expect_near(corner(mesh, 0, 0), {10, 1, 0});
  expect_near(corner(mesh, 0, 1), {10, 1, -2});
  expect_near(corner(mesh, 0, 2), {10, 3, -2});
  expect_near(normal(mesh, 0), {1, 0, 0});

  document["nodes"][0]["scale"] = {1.0, 1.0, 0.5};                                     // scaling comes before rotation
  document["nodes"][1]["matrix"] = {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1};  // turns +X to +Z
  expect_near(corner(read_glb(document), 0, 1), {10.5, 0, 0});
}

TEST(GltfReader, MirroredNodesKeepTheirUpperFace) {
  json document = gltf_document();
  document["nodes"][0]["scale"] = {-1.0, 1.0, 1.0};
  const Mesh mesh = read_glb(document);
  EXPECT_EQ(normal(mesh, 0), glm::dvec3(0, 0, 1));
  EXPECT_EQ(normal(mesh, 1), glm::dvec3(0, 0, 1));
  document["nodes"][0]["scale"] = {1.0, 1.0, -1.0};
  EXPECT_EQ(normal(read_glb(document), 0), glm::dvec3(0, 0, -1));
}

TEST(GltfReader, StripsFansAndUnindexedCorners) {
  json document = gltf_document();
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["mode"] = 6;
  primitive.erase("indices");
  Mesh mesh = read_glb(document);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
  for (const std::size_t triangle : {0U, 1U}) EXPECT_EQ(normal(mesh, triangle), glm::dvec3(0, 0, 1));

  primitive["mode"] = 5;
  primitive["indices"] = 1;
  std::string binary = gltf_binary();
  binary.resize(48);
  for (const std::uint16_t index : {0, 1, 3, 2, 2, 2}) append(binary, index);
  document["accessors"][1]["count"] = 4;
  mesh = read_glb(document, {}, binary);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  for (const std::size_t triangle : {0U, 1U}) EXPECT_EQ(normal(mesh, triangle), glm::dvec3(0, 0, 1));

  primitive["mode"] = 4;
  primitive.erase("indices");
  document["accessors"][0]["count"] = 3;
  EXPECT_EQ(read_glb(document).triangles.size(), 1U);

  const json lines = {{"attributes", {{"POSITION", 0}}}, {"mode", 1}};
  document["meshes"][0]["primitives"].push_back(lines);
  EXPECT_EQ(read_glb(document).triangles.size(), 1U) << "lines are no surface";
}

TEST(GltfReader, IndexTypesAndStrides) {
  json document = gltf_document();
  document["bufferViews"][0]["byteStride"] = 16;
  document["bufferViews"][0]["byteLength"] = 60;  // the last element needs no padding
  document["bufferViews"][1]["byteOffset"] = 64;
  const auto put_index = [](std::string& binary, std::uint32_t index, int type) {
    if (type == 5121) append(binary, static_cast<std::uint8_t>(index));
    if (type == 5123) append(binary, static_cast<std::uint16_t>(index));
    if (type == 5125) append(binary, index);
  };
  for (const int type : {5121, 5123, 5125}) {
    std::string binary;
    for (const auto& position : square_corners) {
      for (const float value : position) append(binary, value);
      append(binary, 99.0F);
    }
    for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) put_index(binary, index, type);
    binary.resize((binary.size() + 3) / 4 * 4);
    document["buffers"][0]["byteLength"] = binary.size();
    document["bufferViews"][1]["byteLength"] = binary.size() - 64;
    document["accessors"][1]["componentType"] = type;
    const Mesh mesh = read_glb(document, {}, binary);
    ASSERT_EQ(mesh.triangles.size(), 2U) << type;
    EXPECT_EQ(corner(mesh, 1, 2), glm::dvec3(0, 1, 0));
  }
}

TEST(GltfReader, OrgansFromExtrasNamesAndParents) {
  json document = gltf_document();
  document["nodes"] = json::parse(R"([
    {"children": [1, 2, 3], "extras": {"plant": 4000000000}},
    {"mesh": 0, "extras": {"organ": "leaf", "rank": 7.0}},
    {"mesh": 0, "name": "plant5_stem"},
    {"mesh": 0, "name": "plant5_stem", "extras": {"plant": 6, "organ": "ear", "rank": 2, "note": [1, {"a": null}]}},
    {"mesh": 0, "name": "Cube"}, {"children": [6], "name": "plant9_leaf3"}, {"mesh": 0, "name": "blade"}])");
  document["scenes"][0]["nodes"] = {0, 4, 5};
  const Mesh mesh = read_glb(document);
  EXPECT_EQ(mesh.organs,
            (std::vector<Organ>{{4000000000U, "leaf", 7}, {5, "stem", 0}, {6, "ear", 2}, {1, "Cube", 0}, {9, "leaf", 3}}));
  EXPECT_EQ(mesh.triangles.size(), 10U);
}

TEST(GltfReader, ScenesAreOptional) {
  json document = gltf_document();
  document.erase("scene");
  EXPECT_EQ(read_glb(document).triangles.size(), 2U);
  document.erase("scenes");
  EXPECT_EQ(read_glb(document).triangles.size(), 2U);
  document["scenes"] = json::parse(R"([{"nodes": []}, {"nodes": [0]}])");
  EXPECT_THROW(static_cast<void>(read_glb(document)), Error);
  document["scene"] = 1;
  EXPECT_EQ(read_glb(document).triangles.size(), 2U);
}

TEST(GltfReader, MaterialsMayBeMissing) {
  json document = gltf_document();
  document["meshes"][0]["primitives"][0].erase("material");
  EXPECT_THROW(static_cast<void>(read_glb(document)), Error);
  EXPECT_EQ(read_glb(document, {.optics = "green"}).optics_names, std::vector<std::string>{"green"});
  document = gltf_document();
  document["materials"][0].erase("name");
  EXPECT_EQ(read_glb(document, {.optics = "green"}).optics_names, std::vector<std::string>{"green"});
}

TEST(GltfReader, TransparencyIsSaidToBeIgnored) {
  json document = gltf_document();
  document["materials"][0]["alphaMode"] = "MASK";
  testing::internal::CaptureStderr();
  start_log(Verbosity::normal);
  EXPECT_EQ(read_glb(document).triangles.size(), 2U);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("material 'leaf': its transparency texture is not read"), std::string::npos) << said;
}

TEST(GltfReader, PosesAreSaidToBeIgnored) {
  const auto said_of = [](const json& document) {
    testing::internal::CaptureStderr();
    start_log(Verbosity::normal);
    EXPECT_EQ(read_glb(document).triangles.size(), 2U);
    return testing::internal::GetCapturedStderr();
  };
  json document = gltf_document();
  document["meshes"][0]["weights"] = {0.0, 0.0};
  EXPECT_EQ(said_of(document), "");
  const char* words = "a.glb: skins and morph targets are not read (1 node)";
  document["meshes"][0]["weights"] = {0.0, 0.5};
  EXPECT_NE(said_of(document).find(words), std::string::npos);
  document["nodes"][0]["weights"] = {0.0, 0.0};
  EXPECT_EQ(said_of(document), "") << "the node's weights count";
  document["nodes"][0]["skin"] = 0;
  EXPECT_NE(said_of(document).find(words), std::string::npos);
}

TEST(GltfReader, RefusesWhatItMustUnderstandAndDoesNot) {
  json document = gltf_document();
  document["extensionsRequired"] = {"KHR_materials_unlit", "EXT_texture_webp"};
  EXPECT_EQ(read_glb(document).triangles.size(), 2U);
  for (const char* extension : {"KHR_mesh_quantization", "KHR_draco_mesh_compression", "MY_geometry", "KHR_node_visibility"}) {
    document["extensionsRequired"] = {"KHR_materials_unlit", extension};
    EXPECT_NE(refusal_of([&] {
                static_cast<void>(read_glb(document));
              }).find(std::string("needs the extension '") + extension + "' (it is not supported)"),
              std::string::npos);
  }
}

// A relative path without a file behind it lies in the folder, too.
TEST(GltfReader, SaysThatABufferIsMissing) {
  const TempFolder folder;
  json document = gltf_document();
  document["buffers"][0]["uri"] = "gone.bin";
  const std::filesystem::path file = std::filesystem::relative(folder.write("a.gltf", document.dump()));
  EXPECT_NE(refusal_of([&] { static_cast<void>(read_mesh(file, {})); }).find("there is no such file"), std::string::npos);
}

TEST(GltfReader, BuffersInFilesBesideIt) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "parts");
  static_cast<void>(folder.write("parts/a b.bin", gltf_binary()));
  json document = gltf_document();
  document["buffers"][0]["uri"] = "parts/a%20b.bin";
  EXPECT_EQ(read_mesh(folder.write("a.gltf", document.dump()), {}).triangles.size(), 2U);
  for (const char* uri : {"../a.bin", "/etc/hostname", "gone.bin", "parts", "http://x/y.bin", "data:text/html,x"}) {
    document["buffers"][0]["uri"] = uri;
    EXPECT_THROW(static_cast<void>(read_mesh(folder.write("a.gltf", document.dump()), {})), Error) << uri;
  }
}

struct Damage {
  const char* name;
  std::function<void(json&)> apply;
  const char* words;  // part of the message
};

TEST(GltfReader, RefusesDamagedModels) {
  const std::vector<Damage> damages{
      {"accessor count", [](json& d) { d["accessors"][0]["count"] = 5; }, "end beyond bufferView 0"},
      {"huge count", [](json& d) { d["accessors"][0]["count"] = 4000000000000000000U; }, "end beyond bufferView 0"},
      {"no elements", [](json& d) { d["accessors"][0]["count"] = 0; }, "empty"},
      {"negative count", [](json& d) { d["accessors"][0]["count"] = -4; }, "malformed glTF"},
      {"accessor offset", [](json& d) { d["accessors"][0]["byteOffset"] = 4; }, "end beyond bufferView 0"},
      {"huge offset", [](json& d) { d["accessors"][0]["byteOffset"] = 18446744073709551612U; }, "end beyond"},
      {"view length", [](json& d) { d["bufferViews"][1]["byteLength"] = 13; }, "ends beyond its buffer"},
      {"view offset", [](json& d) { d["bufferViews"][1]["byteOffset"] = 18446744073709551612U; }, "ends beyond its buffer"},
      {"view of no buffer", [](json& d) { d["bufferViews"][0]["buffer"] = 1; }, "buffer 1"},
      {"stride", [](json& d) { d["bufferViews"][0]["byteStride"] = 8; }, "overlap"},
      {"no view", [](json& d) { d["accessors"][0].erase("bufferView"); }, "bufferView -1"},
      {"view index", [](json& d) { d["accessors"][0]["bufferView"] = 2; }, "bufferView 2"},
      {"position type", [](json& d) { d["accessors"][0]["type"] = "VEC2"; }, "must be VEC3 of float"},
      {"position component", [](json& d) { d["accessors"][0]["componentType"] = 5123; }, "must be VEC3 of float"},
      {"index type", [](json& d) { d["accessors"][1]["type"] = "VEC2"; }, "must be SCALAR"},
      {"index component", [](json& d) { d["accessors"][1]["componentType"] = 5122; }, "must be SCALAR"},
      {"index value", [](json& d) { d["accessors"][0]["count"] = 3; }, "index 3"},
      {"sparse",
       [](json& d) {
         d["accessors"][0]["sparse"] =
             json::parse(R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})");
       },
       "sparse"},
      {"accessor index", [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7; }, "accessor 7"},
      {"no position",
       [](json& d) {
         d["meshes"][0]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
       },
       "without POSITION"},
      {"mode", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 7; }, "mode 7"},
      {"corners", [](json& d) { d["accessors"][1]["count"] = 5; }, "5 corners"},
      {"material index", [](json& d) { d["meshes"][0]["primitives"][0]["material"] = 1; }, "material 1"},
      {"mesh index", [](json& d) { d["nodes"][0]["mesh"] = 9; }, "mesh 9"},
      {"scene index", [](json& d) { d["scene"] = 3; }, "scene 3"},
      {"root index", [](json& d) { d["scenes"][0]["nodes"] = {5}; }, "node 5"},
      {"child index", [](json& d) { d["nodes"][0]["children"] = {1}; }, "node 1"},
      {"cycle", [](json& d) { d["nodes"][0]["children"] = {0}; }, "reached twice"},
      {"shared child",
       [](json& d) {
         d["scenes"][0]["nodes"] = {0, 0};
       },
       "reached twice"},
      {"matrix",
       [](json& d) {
         d["nodes"][0]["matrix"] = {1, 2, 3};
       },
       "matrix has 3 numbers"},
      {"rotation",
       [](json& d) {
         d["nodes"][0]["rotation"] = {0, 0, 0, 0};
       },
       "unit quaternion"},
      {"scale",
       [](json& d) {
         d["nodes"][0]["scale"] = {1e308, 1e308, 1e308};
       },
       "single precision"},
      {"plant",
       [](json& d) {
         d["nodes"][0]["extras"] = {{"plant", -1}};
       },
       "extras.plant"},
      {"organ",
       [](json& d) {
         d["nodes"][0]["extras"] = {{"organ", 7}};
       },
       "extras.organ"},
      {"rank",
       [](json& d) {
         d["nodes"][0]["extras"] = {{"rank", 1.5}};
       },
       "extras.rank"},
      {"compression", [](json& d) { d["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }, "KHR_draco"},
      {"instances", [](json& d) { d["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = json::object(); }, "instancing"},
      {"buffer length", [](json& d) { d["buffers"][0]["byteLength"] = 64; }, "only 60 are present"},
      {"no buffer length", [](json& d) { d["buffers"][0].erase("byteLength"); }, "no byteLength"},
      {"second buffer",
       [](json& d) {
         d["buffers"].push_back({{"byteLength", 4}});
       },
       "buffer 1 has no content"},
      {"old version", [](json& d) { d["asset"]["version"] = "1.0"; }, "only 2.x"},
      {"no version", [](json& d) { d.erase("asset"); }, "malformed glTF"},
      {"index beyond 32 bits", [](json& d) { d["nodes"][0]["children"] = {4294967296U}; }, "children"},
      {"number as text",
       [](json& d) {
         d["nodes"][0]["scale"] = {"2", "2", "2"};
       },
       "scale"},
      {"negative mesh", [](json& d) { d["nodes"][0]["mesh"] = -1; }, "mesh"},
      {"wrong type", [](json& d) { d["nodes"][0]["mesh"] = "leaf"; }, "malformed glTF"},
      {"nothing to see", [](json& d) { d["scenes"][0]["nodes"] = json::array(); }, "no triangle"},
      {"deep extras",
       [](json& d) {
         json deep = 1;
         for (int i = 0; i < 200; ++i) deep = json::array({deep});
         d["nodes"][0]["extras"] = deep;
       },
       "nested"},
  };
  for (const Damage& damage : damages) {
    SCOPED_TRACE(damage.name);
    json document = gltf_document();
    damage.apply(document);
    const std::string message = refusal_of([&] { static_cast<void>(read_glb(document)); });
    EXPECT_NE(message.find("a.glb: "), std::string::npos) << message;
    EXPECT_NE(message.find(damage.words), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(GltfReader, RefusesPositionsThatAreNotFinite) {
  std::string binary = gltf_binary();
  const float bad = std::nanf("");
  std::memcpy(binary.data() + 16, &bad, sizeof bad);
  EXPECT_THROW(static_cast<void>(read_glb(gltf_document(), {}, binary)), Error);
}

TEST(GltfReader, RefusesTextInItsOwnWords) {
  const TempFolder folder;
  folder.write("cut.gltf", "{\"buffers\": [{\"uri\": \"data:;base64," + std::string(10'000, 'A'));
  EXPECT_LT(refusal_of([&] { static_cast<void>(read_mesh(folder / "cut.gltf", {})); }).size(), 400U)
      << "no buffer in a message";
  for (const auto& wrong : {std::pair("some words\n", "not a glTF file"), std::pair("{\"a\": x}", "malformed JSON (parse")}) {
    const std::string message = refusal_of([&] { static_cast<void>(read_mesh(folder.write("a.glb", wrong.first), {})); });
    EXPECT_NE(message.find(wrong.second), std::string::npos) << message;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  }
}

TEST(GltfReader, RefusesDamagedContainers) {
  const TempFolder folder;
  const std::string good = glb(gltf_document(), gltf_binary());
  const std::size_t binary_chunk = good.size() - gltf_binary().size() - 8;
  for (const std::size_t place :
       {std::size_t{4}, std::size_t{8}, std::size_t{12}, std::size_t{16}, binary_chunk, binary_chunk + 4})
    for (const unsigned char value : {0x00, 0x01, 0x7F, 0xFF}) {
      std::string damaged = good;
      if (static_cast<unsigned char>(damaged[place]) == value) continue;
      damaged[place] = static_cast<char>(value);
      EXPECT_THROW(static_cast<void>(read_mesh(folder.write("a.glb", damaged), {})), Error) << place << " " << int{value};
    }
  EXPECT_THROW(static_cast<void>(read_mesh(folder.write("a.glb", good + "tail"), {})), Error);
  EXPECT_THROW(static_cast<void>(read_mesh(folder.write("a.gltf", std::string(100000, '[')), {})), Error);
}

}  // namespace
}  // namespace sunfleck
