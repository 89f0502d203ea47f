#include "physics/bvh/own_tree.h"

#include "base/check.h"
#include "physics/bvh/references.h"

#include <cmath>
#include <limits>
#include <vector>

namespace sunfleck::detail {
namespace {

// Return the largest float not above the sum and the smallest not below it, so that boxes never shrink.
float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}
float rounded_up(double value) {
  return -rounded_down(-value);
}

}  // namespace

Item padded_item(const Box& box, float padding_m, std::uint32_t number) {
  Item item{nothing};
  for (int axis = 0; axis < 3; ++axis) {
    item.box.lo[axis] = rounded_down(double{box.lo[axis]} - padding_m);
    item.box.hi[axis] = rounded_up(double{box.hi[axis]} + padding_m);
    EXPECT(item.box.lo[axis], >, -largest_coordinate_m);
    EXPECT(item.box.hi[axis], <, largest_coordinate_m);
  }
  item.box.lo[3] = static_cast<float>(number & 0xffffU);
  item.box.hi[3] = static_cast<float>(number >> 16U);
  return item;
}

Bvh build_tree(BinaryTree& tree, const ItemContents& contents, int max_depth) {
  build_binary_tree(tree, 3 * max_depth);
  return collapse(tree, contents, max_depth);
}

Bvh build_own_tree(const Canopy& canopy, float padding_m, int max_depth) {
  const std::vector<Reference> references = make_references(canopy);
  BinaryTree tree;
  tree.items.reserve(references.size());
  for (const Reference& reference : references) {
    const auto number = static_cast<std::uint32_t>(tree.items.size());
    tree.items.push_back(padded_item(box_of(reference_corners(canopy, reference)), padding_m, number));
  }
  const auto triangle = [&](std::uint32_t item) { return reference_triangle(canopy, references[item]); };
  return build_tree(tree, {.triangle = triangle, .copy = nullptr}, max_depth);
}

}  // namespace sunfleck::detail
