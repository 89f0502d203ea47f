#pragma once
// Reads the geometries of COLLADA files.

#include "files/formats/mesh/xml_file.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sunfleck {

// The elements of a file by their id.
using DaeElements = std::unordered_map<std::string_view, pugi::xml_node>;

// Returns the element to which a reference like `#leaf` points; refuses a file without one, or with one of another name.
[[nodiscard]] pugi::xml_node dae_target(const XmlFile& xml, const DaeElements& elements, pugi::xml_node from,
                                        std::string_view attribute, std::string_view name);

// Polygons of one material.
struct DaePolygons {
  std::string_view material;           // the symbol that instances bind to a material; may be empty
  std::vector<std::uint32_t> corners;  // numbers of positions
  std::vector<std::size_t> sizes;      // [polygon], corners; at least 3
};

struct DaeGeometry {
  std::vector<glm::dvec3> positions;  // of all <vertices>
  std::vector<DaePolygons> parts;
};

// Reads the <mesh> of a <geometry> (COLLADA 1.4.1, section 5); lines are left out. Throws Error (input) for missing data, corners
// out of range, and polygons with holes. `numbers_left` is how many numbers of positions may still be read, since arrays that
// many <vertices> share would make a small file large; those read are subtracted, and more are refused.
[[nodiscard]] DaeGeometry read_dae_geometry(const XmlFile& xml, const DaeElements& elements, pugi::xml_node geometry,
                                            std::size_t& numbers_left);

}  // namespace sunfleck
