#include "physics/bvh/decode.h"

#include "physics/bvh/binary_tree.h"
#include "physics/bvh/encode.h"

#include <bit>
#include <glm/common.hpp>

namespace sunfleck {
namespace {

double half_area(const Box& box) {
  const glm::dvec3 size = glm::dvec3(box.hi) - glm::dvec3(box.lo);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

Box child_box(const BvhNode& node, int slot) {
  const auto k = static_cast<std::size_t>(slot);
  const glm::vec3 step{detail::power_of_two(node.exponent[0]), detail::power_of_two(node.exponent[1]),
                       detail::power_of_two(node.exponent[2])};
  const glm::vec3 origin{node.origin[0], node.origin[1], node.origin[2]};
  return {origin + glm::vec3(node.lo_x[k], node.lo_y[k], node.lo_z[k]) * step,
          origin + glm::vec3(node.hi_x[k], node.hi_y[k], node.hi_z[k]) * step};
}

BvhStatistics statistics(const Bvh& bvh) {
  BvhStatistics result;
  if (bvh.nodes.empty()) return result;
  Box root{glm::vec3(detail::largest_coordinate_m), glm::vec3(-detail::largest_coordinate_m)};
  double area_of_visits = 0.0;
  for (const BvhNode& node : bvh.nodes) {
    for (int slot = 0; slot < 8; ++slot) {
      const auto meta = node.meta[static_cast<std::size_t>(slot)];
      if (meta == 0) continue;
      const bool inner = ((node.inner_mask >> slot) & 1) != 0;
      const Box box = child_box(node, slot);
      const int visits = inner ? 1 : std::popcount(static_cast<unsigned>(meta) >> 5U);
      area_of_visits += visits * half_area(box);
      ++(inner ? result.inner_children : result.leaf_children);
      if (&node != &bvh.nodes.front()) continue;
      root.lo = glm::min(root.lo, box.lo);
      root.hi = glm::max(root.hi, box.hi);
    }
  }
  const double root_area = half_area(root);
  result.sah_cost =
      root_area > 0.0 ? 1.0 + area_of_visits / root_area : static_cast<double>(bvh.nodes.size() + bvh.triangles.size());
  return result;
}

}  // namespace sunfleck
