#include "physics/bvh/build.h"

#include "base/check.h"
#include "physics/bvh/binary_tree.h"
#include "physics/bvh/collapse.h"
#include "physics/bvh/references.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace sunfleck {
namespace {

// Return the largest float not above the sum and the smallest not below it, so that boxes never shrink.
float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}
float rounded_up(double value) {
  return -rounded_down(-value);
}

detail::Item padded_item(const Triangle& corners, float padding_m, std::uint32_t number) {
  detail::Item item{detail::nothing};
  for (int axis = 0; axis < 3; ++axis) {
    const float a = corners[0][axis];
    const float b = corners[1][axis];
    const float c = corners[2][axis];
    item.box.lo[axis] = rounded_down(double{std::min({a, b, c})} - padding_m);
    item.box.hi[axis] = rounded_up(double{std::max({a, b, c})} + padding_m);
    EXPECT(item.box.lo[axis], >, -detail::largest_coordinate_m);
    EXPECT(item.box.hi[axis], <, detail::largest_coordinate_m);
  }
  item.box.lo[3] = static_cast<float>(number & 0xffffU);
  item.box.hi[3] = static_cast<float>(number >> 16U);
  return item;
}

}  // namespace

Bvh build_bvh(const Canopy& canopy, float padding_m) {
  EXPECT(padding_m, >=, 0.0F);
  const std::vector<Reference> references = make_references(canopy);
  detail::BinaryTree tree;
  tree.items.reserve(references.size());
  for (const Reference& reference : references) {
    const auto number = static_cast<std::uint32_t>(tree.items.size());
    tree.items.push_back(padded_item(reference_corners(canopy, reference), padding_m, number));
  }
  detail::build_binary_tree(tree);
  return detail::collapse(tree, canopy, references);
}

}  // namespace sunfleck
