#pragma once
// Surfaces cut in two again and again, down to single elements: the scales on which the light of neighbours is compared.

#include "physics/canopy/canopy.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Places `begin` to `end` - 1 in the order of a tree.
struct TreeRange {
  std::uint32_t begin = 0, end = 0;

  [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

// A cut of a range: its two parts meet at `middle`.
struct TreeCut {
  TreeRange whole;
  std::uint32_t middle = 0;
};

struct SurfaceTree {
  std::vector<std::uint32_t> order;  // [place], the element there
  std::vector<TreeRange> surfaces;   // those with elements, in the order of their numbers
  std::vector<TreeCut> cuts;         // each after those of the ranges that contain it
};

// Returns a tree of the elements with a weight. Each range is cut across its longest extent, at a random place in the middle
// third and with extents stretched at random, so that trees with different streams have different cuts; an average over
// several trees shows none of them. `surface_of` and `weights` are [element].
[[nodiscard]] SurfaceTree make_surface_tree(const Canopy& canopy, std::span<const std::uint32_t> surface_of,
                                            std::span<const double> weights, std::uint64_t stream);

}  // namespace sunfleck
