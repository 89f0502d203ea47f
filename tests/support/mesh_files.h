#pragma once
// One square of two triangles, (0,0,0) (1,0,0) (1,1,0) and (0,0,0) (1,1,0) (0,1,0), as a file in each format.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

inline constexpr std::array<std::array<float, 3>, 4> square_corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

template <class T>
void append(std::string& bytes, T value) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof value);
  bytes.append(raw.data(), raw.size());
}

inline std::string obj_square() {
  return "# a square\nmtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl leaf\nf 1//1 2//1 3//1 4//1\n";
}

inline std::string can_square() {
  return "# CARIBU\n\np 1 100012007001 3 0 0 0 1 0 0 1 1 0\np 2 100012007002 9 3 0 0 0 1 1 0 0 1 0\n";
}

inline std::string dae_square() {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_materials><material id="green" name="leaf"/></library_materials>
<library_geometries><geometry id="shape" name="Shape"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="m" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="NORMAL" source="#n" offset="1"/><vcount>4</vcount><p>0 9 1 9 2 9 3 9</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n1" name="blade"><instance_geometry url="#shape"><bind_material>
<technique_common><instance_material symbol="m" target="#green"/></technique_common></bind_material></instance_geometry>
</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";
}

// Returns the square as one organ of 1 m, in centimetres with z up: x east, y north.
inline std::string opf_square() {
  return R"(<?xml version="1.0"?>
<opf version="2.0">
<meshBDD><mesh Id="0" enableScale="true"><points>0 0 0 0 1 0 1 1 0 1 0 0</points>
<faces><face Id="0">0 1 2</face><face Id="1">0 2 3</face></faces></mesh></meshBDD>
<shapeBDD><shape Id="5"><name>blade</name><meshIndex>0</meshIndex></shape></shapeBDD>
<topology class="Individual" scale="1" id="1"><geometry class="Mesh"><mat>0 0 0 0 0 0 0 0 0 0 0 0</mat><dUp>NaN</dUp></geometry>
<decomp class="leaf" scale="2" id="7"><Length>1</Length><geometry class="Mesh"><shapeIndex>5</shapeIndex>
<mat>0 0 0 0 0 -100 0 0 100 0 0 0</mat><dUp>1</dUp><dDwn>1</dDwn></geometry></decomp></topology>
</opf>
)";
}

inline std::string stl_text_square() {
  return "solid my leaf\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
         "  FACET NORMAL 0 0 1\n  OUTER LOOP\n  VERTEX 0 0 0\n  VERTEX 1 1 0\n  VERTEX 0 1 0\n  ENDLOOP\n  "
         "ENDFACET\nendsolid\n";
}

// Returns a binary file whose comment begins with `solid`, as in many binary files.
inline std::string stl_binary_square() {
  std::string bytes = "solid but binary";
  bytes.resize(80, ' ');
  append(bytes, std::uint32_t{2});
  for (const std::array<int, 3>& triangle : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    for (const float normal : {0.0F, 0.0F, 1.0F}) append(bytes, normal);
    for (const int corner : triangle)
      for (const float value : square_corners[static_cast<std::size_t>(corner)]) append(bytes, value);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string ply_text_square() {
  return "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty uchar red\n"
         "property float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\nproperty int label\n"
         "element edge 1\nproperty list uchar int ends\nend_header\n"
         "0 9 0 0\n1 9 0 0\n1 9 1 0\n0 9 1 0\n3 0 1 2 5\n3 0 2 3 5\n2 0 1\n";
}

enum class ByteOrder { little, big };

// Returns the whole square as one quadrangle, with coordinates of three types.
inline std::string ply_binary_square(ByteOrder order) {
  const bool big = order == ByteOrder::big;
  std::string bytes = std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
                      " 1.0\nelement vertex 4\nproperty short x\nproperty double y\nproperty list uchar short extra\n"
                      "property float z\nelement face 1\nproperty list uint8 uint16 vertex_index\nend_header\n";
  const auto put = [&](auto value) {
    std::string raw;
    append(raw, value);
    if (big) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  };
  for (const std::array<float, 3>& corner : square_corners) {
    put(static_cast<std::int16_t>(corner[0]));
    put(static_cast<double>(corner[1]));
    put(std::uint8_t{1});
    put(std::int16_t{77});
    put(corner[2]);
  }
  put(std::uint8_t{4});
  for (std::uint16_t corner = 0; corner < 4; ++corner) put(corner);
  return bytes;
}

inline std::string gzip(std::string_view text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(bytes.size() - stream.avail_out);
  deflateEnd(&stream);
  return bytes;
}

inline std::string glb(const nlohmann::json& document, const std::string& binary) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(28 + text.size() + binary.size()));
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  append(bytes, static_cast<std::uint32_t>(binary.size()));
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

// Returns the positions (48 bytes), then the six indices of the square as 16-bit numbers.
inline std::string gltf_binary() {
  std::string binary;
  for (const std::array<float, 3>& corner : square_corners)
    for (const float value : corner) append(binary, value);
  for (const std::uint16_t index : {0, 1, 2, 0, 2, 3}) append(binary, index);
  return binary;
}

inline nlohmann::json gltf_document() {
  return nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "plant3_leaf7.001", "mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "leaf", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}], "images": [{"uri": "gone.png"}],
    "buffers": [{"byteLength": 60}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})");
}

// Checks a position that readers computed in double precision.
inline void expect_at(const glm::dvec3& found, const glm::dvec3& expected) {
  EXPECT_LT(glm::distance(found, expected), 1e-12) << found.x << " " << found.y << " " << found.z;
}

}  // namespace sunfleck
