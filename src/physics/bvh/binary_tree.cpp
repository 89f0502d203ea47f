// Splits are chosen by the surface area heuristic over bins of the boxes' centres (Wald 2007, "On fast
// construction of SAH-based bounding volume hierarchies"), down to single triangles.

#include "physics/bvh/binary_tree.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace sunfleck::detail {
namespace {

using Int4 [[gnu::vector_size(16)]] = std::int32_t;

constexpr std::uint32_t max_bins = 32;

// Returns the number of bins. Few items need few bins: compared with 32 throughout, 250,000 triangles take a fifth less time
// and the tree costs 0.1 % more; 16 throughout are as quick and cost 0.6 % more.
std::uint32_t bins_for(std::uint32_t count) {
  return std::min(max_bins, 4 + count / 2);
}

int ceil_log2(std::uint32_t count) {
  return std::bit_width(count - 1);
}

// The items of a subtree with the box around them and the box around their centres (times two).
struct ItemRange {
  Subtree subtree;
  Bounds box = nothing;
  Bounds centres{nothing.lo * 2.0F, nothing.hi * 2.0F};

  void add(const Item& item) {
    box.grow(item.box);
    centres.grow(item.twice_centre());
    ++subtree.count;
  }
};

// Maps a centre to its bin on all axes at once.
struct Grid {
  Float4 lo{};
  Float4 bins_per_m{};  // 0 on an axis without extent
  std::uint32_t bins = 0;

  explicit Grid(const ItemRange& range) : lo(range.centres.lo), bins(bins_for(range.subtree.count)) {
    const Float4 size = range.centres.hi - range.centres.lo;
    for (int axis = 0; axis < 3; ++axis) {
      // The factor keeps the last centre below `bins` whatever the rounding.
      const float scale = static_cast<float>(bins) * 0.9999F / size[axis];
      bins_per_m[axis] = size[axis] > 0.0F && std::isfinite(scale) ? scale : 0.0F;
    }
  }
  [[nodiscard]] Int4 bin(Float4 twice_centre) const { return __builtin_convertvector((twice_centre - lo) * bins_per_m, Int4); }
};

// A split of a subtree: items whose bin on `axis` is below `bin` go left.
struct Split {
  int axis = -1;  // -1: none found
  std::int32_t bin = 0;
  float cost = std::numeric_limits<float>::infinity();
  std::uint32_t imbalance = 0;  // decides between equal costs, so that boxes without area are split evenly

  void improve(const Split& other) {
    if (other.cost < cost || (other.cost == cost && other.imbalance < imbalance)) *this = other;
  }
};

class BinaryBuilder {
 public:
  explicit BinaryBuilder(BinaryTree& tree) : items_(tree.items), nodes_(tree.nodes) {}

  // Builds a subtree that is at most `levels` high, which is how deep the recursion is. Subtrees share neither items nor nodes, so
  // that several threads may build them.
  void build(const ItemRange& range, int levels) {
    if (range.subtree.count < 2) return;
    DCHECK(ceil_log2(range.subtree.count), <=, levels);
    const Halves halves = divide(range, levels - 1);
    nodes_[range.subtree.node].left_count = halves.left.subtree.count;
    in_both_children(
        range.subtree, [&] { build(halves.left, levels - 1); }, [&] { build(halves.right, levels - 1); });
  }

  [[nodiscard]] ItemRange measure(std::uint32_t node, std::uint32_t first, std::uint32_t count) const {
    ItemRange range{{node, first, 0}};
    for (std::uint32_t i = first; i < first + count; ++i) range.add(items_[i]);
    return range;
  }

 private:
  struct Bin {
    Bounds box;
    std::uint32_t count;
  };
  using Bins = std::array<std::array<Bin, max_bins>, 3>;
  struct Halves {
    ItemRange left, right;
  };

  // Returns two halves that both fit into `levels`: those of the heuristic if they do, otherwise equal ones.
  Halves divide(const ItemRange& range, int levels) {
    const auto& [node, first, count] = range.subtree;
    if (count > 2) {
      const Grid grid(range);
      const Split split = find_split(range, grid);
      if (split.axis >= 0) {
        Halves halves = partition(range.subtree, grid, split);
        if (std::max(ceil_log2(halves.left.subtree.count), ceil_log2(halves.right.subtree.count)) <= levels) return halves;
      }
      sort_around_median(range);
    }
    const std::uint32_t left_count = count - count / 2;
    return {measure(node + 1, first, left_count), measure(node + left_count, first + left_count, count - left_count)};
  }

  Split find_split(const ItemRange& range, const Grid& grid) const {
    Bins bins;  // only as many as the grid has are set and read
    for (auto& axis : bins) std::fill_n(axis.begin(), grid.bins, Bin{nothing, 0});
    const auto& [node, first, count] = range.subtree;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Int4 bin = grid.bin(items_[i].twice_centre());
      for (int axis = 0; axis < 3; ++axis) {
        Bin& target = bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(bin[axis])];
        target.box.grow(items_[i].box);
        ++target.count;
      }
    }
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (grid.bins_per_m[axis] > 0.0F) best.improve(sweep(bins[static_cast<std::size_t>(axis)], axis, grid.bins, count));
    }
    return best;
  }

  // Returns the best split between the bins of an axis: the cost is area times count, summed over both sides.
  [[nodiscard]] static Split sweep(const std::array<Bin, max_bins>& bin, int axis, std::uint32_t bins, std::uint32_t count) {
    std::array<float, max_bins> right_cost{};
    Bounds box = nothing;
    std::uint32_t right_count = 0;
    for (std::uint32_t b = bins - 1; b > 0; --b) {
      box.grow(bin[b].box);
      right_count += bin[b].count;
      right_cost[b] = box.half_area() * static_cast<float>(right_count);
    }
    Split best;
    box = nothing;
    std::uint32_t left_count = 0;
    for (std::uint32_t b = 1; b < bins; ++b) {
      box.grow(bin[b - 1].box);
      left_count += bin[b - 1].count;
      if (left_count == 0) continue;
      if (left_count == count) break;
      const float cost = box.half_area() * static_cast<float>(left_count) + right_cost[b];
      const std::uint32_t rest = count - left_count;
      best.improve({axis, static_cast<std::int32_t>(b), cost, std::max(left_count, rest) - std::min(left_count, rest)});
    }
    return best;
  }

  Halves partition(const Subtree& subtree, const Grid& grid, const Split& split) {
    Halves halves{{{subtree.node + 1, subtree.first, 0}}, {{}}};
    std::uint32_t begin = subtree.first;
    std::uint32_t end = subtree.first + subtree.count;
    const auto goes_left = [&](const Item& item) { return grid.bin(item.twice_centre())[split.axis] < split.bin; };
    while (true) {
      for (; begin < end && goes_left(items_[begin]); ++begin) halves.left.add(items_[begin]);
      for (; begin < end && !goes_left(items_[end - 1]); --end) halves.right.add(items_[end - 1]);
      if (begin == end) break;
      std::swap(items_[begin], items_[end - 1]);
    }
    halves.right.subtree.node = subtree.node + halves.left.subtree.count;
    halves.right.subtree.first = begin;
    return halves;
  }

  // Sorts along the axis on which the centres spread most; if all are equal any order is good.
  void sort_around_median(const ItemRange& range) {
    const Float4 size = range.centres.hi - range.centres.lo;
    int axis = 0;
    for (int other = 1; other < 3; ++other) {
      if (size[other] > size[axis]) axis = other;
    }
    if (!(size[axis] > 0.0F)) return;
    const auto& [node, first, count] = range.subtree;
    const auto begin = items_.begin() + first;
    std::nth_element(begin, begin + (count - count / 2), begin + count,
                     [axis](const Item& a, const Item& b) { return a.twice_centre()[axis] < b.twice_centre()[axis]; });
  }

  std::vector<Item>& items_;
  std::vector<BinaryNode>& nodes_;
};

}  // namespace

void build_binary_tree(BinaryTree& tree, int max_height) {
  const auto count = static_cast<std::uint32_t>(tree.items.size());
  if (count > 1) EXPECT(ceil_log2(count), <=, max_height);
  tree.nodes.resize(count < 2 ? 0 : count - 1);
  BinaryBuilder builder(tree);
  builder.build(builder.measure(0, 0, count), max_height);
}

}  // namespace sunfleck::detail
