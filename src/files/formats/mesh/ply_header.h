#pragma once
// Reads the header of a PLY file.

#include "files/formats/mesh/mesh_source.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace sunfleck {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

// The quantities that are read; the others are skipped.
enum class PlyUse { none, x, y, z, red, green, blue, corners, organ, optics };

struct PlyProperty {
  std::string_view name;
  PlyUse use = PlyUse::none;
  PlyType type = PlyType::float32;   // type of the value, or of a list's entries
  std::optional<PlyType> list_size;  // set for a list
};

struct PlyElement {
  std::string_view name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has(PlyUse use) const;
  [[nodiscard]] bool has_colour() const;
};

// The views point into the source's bytes.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::map<std::uint32_t, std::string_view> organs, optics;  // names in comments like `comment organ 3 plant1_leaf7`, by number
  std::vector<PlyElement> elements;
  std::string_view body;
  std::size_t lines = 0;  // lines of the header
};

// Throws Error (input) with the line if the header is malformed.
[[nodiscard]] PlyHeader read_ply_header(const MeshSource& source);

}  // namespace sunfleck
