#include "physics/canopy/copies.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace sunfleck {
namespace {

using Bits = std::array<std::uint32_t, 9>;

// Returns the coordinates with the corners in ascending order: the same for all windings of one triangle.
Bits sorted_bits(Triangle corners) {
  std::sort(corners.begin(), corners.end(),
            [](const glm::vec3& a, const glm::vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  Bits bits{};
  std::size_t k = 0;
  for (const glm::vec3& corner : corners) {
    // Adding zero turns -0 into +0.
    for (const float coordinate : {corner.x, corner.y, corner.z}) bits[k++] = std::bit_cast<std::uint32_t>(coordinate + 0.0F);
  }
  return bits;
}

// Returns a hash by FNV-1a over words (Fowler, Noll and Vo), with a final step that mixes high bits down.
std::uint64_t hash(const Bits& bits) {
  std::uint64_t value = 0xcbf29ce484222325U;
  for (const std::uint32_t word : bits) value = (value ^ word) * 0x100000001b3U;
  return value ^ value >> 32U;
}

}  // namespace

std::vector<Copy> find_copies(std::span<const Triangle> corners) {
  struct Hashed {
    std::uint64_t hash;
    std::uint32_t element;
    bool operator<(const Hashed& other) const { return std::tie(hash, element) < std::tie(other.hash, other.element); }
  };
  std::vector<Hashed> order;
  order.reserve(corners.size());
  for (std::size_t e = 0; e < corners.size(); ++e) {
    if (area_m2(corners[e]) > 0.0) order.push_back({hash(sorted_bits(corners[e])), static_cast<std::uint32_t>(e)});
  }
  std::sort(order.begin(), order.end());
  std::vector<Copy> copies;
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && order[end].hash == order[first].hash) ++end;
    // A hash nearly always belongs to a single element; otherwise all pairs are compared, since different triangles may
    // share it.
    for (std::size_t k = first + 1; k < end; ++k) {
      const Bits own = sorted_bits(corners[order[k].element]);
      const auto original =
          std::find_if(order.begin() + static_cast<std::ptrdiff_t>(first), order.begin() + static_cast<std::ptrdiff_t>(k),
                       [&](const Hashed& other) { return sorted_bits(corners[other.element]) == own; });
      if (original != order.begin() + static_cast<std::ptrdiff_t>(k)) copies.push_back({order[k].element, original->element});
    }
    first = end;
  }
  std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) { return a.element < b.element; });
  return copies;
}

std::vector<bool> copied_elements(std::span<const Copy> copies, std::size_t elements) {
  std::vector<bool> copied(elements);
  for (const Copy& copy : copies) copied[copy.element] = true;
  return copied;
}

}  // namespace sunfleck
