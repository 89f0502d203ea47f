#pragma once
// Triangles that occupy exactly the same place, as in meshes that were merged twice or that model a leaf by two skins.

#include "physics/canopy/triangle.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// An element that lies exactly on an earlier one.
struct Copy {
  std::uint32_t element = 0;
  std::uint32_t original = 0;  // the first element with the same three corners

  friend bool operator==(const Copy&, const Copy&) = default;
};

// Returns the elements whose three corners, in any order, are those of an earlier element, ascending. Triangles without area
// are ignored. `corners` is [element].
[[nodiscard]] std::vector<Copy> find_copies(std::span<const Triangle> corners);

// Marks the copies among `elements` elements. [element]
[[nodiscard]] std::vector<bool> copied_elements(std::span<const Copy> copies, std::size_t elements);

}  // namespace sunfleck
