// Dynamic programming chooses the binary nodes to keep, at minimal expected cost; then children are assigned to slots and
// boxes are rounded to the grid.

#include "physics/bvh/collapse.h"

#include "base/check.h"
#include "physics/bvh/encode.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace sunfleck::detail {
namespace {

// These are the costs of a node visit (80 bytes fetched, eight boxes) and of a triangle test (48 bytes, one triangle), as in
// Ylitie et al. 2017, section 4.1; only their ratio matters. Between 0.3 and 1.5 a scalar closest-hit walk takes the same time
// within 5 %, while the tree grows from 0.11 to 0.15 nodes per triangle on leaf strips and from 0.12 to 0.24 on scattered
// triangles.
constexpr float node_cost = 1.0F;
constexpr float triangle_cost = 0.3F;
constexpr std::uint32_t max_leaf_triangles = 3;

// The decisions for a binary node, packed into BinaryNode::plan. split(j), j = 2..8: how many of j roots of this subtree go
// to its left child; 0 means that j - 1 roots are just as good.
class Plan {
 public:
  explicit Plan(std::uint32_t bits = 0) : bits_(bits) {}
  [[nodiscard]] std::uint32_t bits() const { return bits_; }
  [[nodiscard]] int split(int roots) const { return static_cast<int>((bits_ >> (3 * (roots - 2))) & 7U); }
  void set_split(int roots, int left) { bits_ |= static_cast<std::uint32_t>(left) << (3 * (roots - 2)); }
  [[nodiscard]] bool leaf() const { return ((bits_ >> 21U) & 1U) != 0; }
  void set_leaf() { bits_ |= 1U << 21U; }
  [[nodiscard]] int height() const { return static_cast<int>(bits_ >> 22U); }
  void set_height(int height) { bits_ |= static_cast<std::uint32_t>(height) << 22U; }

 private:
  std::uint32_t bits_;
};

// The box of a subtree, and the least cost of representing it by at most j nodes, leaves or inner ones: cost[j], j = 1..7.
struct Costs {
  Bounds box = nothing;
  std::array<float, 8> cost{};
  int height = 0;
};

struct Distribution {
  float cost = std::numeric_limits<float>::infinity();
  int left = 1;
};

Distribution distribute(const Costs& left, const Costs& right, int roots) {
  Distribution best;
  for (int k = 1; k < roots; ++k) {
    const float cost = left.cost[static_cast<std::size_t>(k)] + right.cost[static_cast<std::size_t>(roots - k)];
    if (cost < best.cost) best = {cost, k};
  }
  return best;
}

class Collapser {
 public:
  Collapser(BinaryTree& tree, const ItemContents& contents, int max_depth)
      : tree_(tree), contents_(contents), max_depth_(max_depth) {}

  Bvh run() {
    if (tree_.items.empty()) return {};
    const Subtree whole{0, 0, static_cast<std::uint32_t>(tree_.items.size())};
    solve(whole);
    if (!of_copies()) bvh_.triangles.reserve(tree_.items.size());
    bvh_.nodes.reserve(tree_.items.size() / 7 + 1);  // 0.10 to 0.13 nodes per triangle are usual
    bvh_.nodes.resize(1);
    emit(0, whole, 1);
    bvh_.nodes.shrink_to_fit();
    ENSURE(bvh_.depth, <=, max_depth_);
    ENSURE(of_copies() ? bvh_.copies.size() : bvh_.triangles.size(), ==, tree_.items.size());
    return std::move(bvh_);
  }

 private:
  struct Children {
    std::array<Subtree, 8> subtree;
    std::size_t count = 0;

    void add(const Subtree& child) { subtree[count++] = child; }
  };

  [[nodiscard]] const BinaryNode& node_of(const Subtree& subtree) const { return tree_.nodes[subtree.node]; }
  [[nodiscard]] Plan plan_of(const Subtree& subtree) const { return Plan(node_of(subtree).plan); }
  [[nodiscard]] Subtree left_of(const Subtree& s) const { return {s.node + 1, s.first, node_of(s).left_count}; }
  [[nodiscard]] Subtree right_of(const Subtree& s) const {
    const std::uint32_t left_count = node_of(s).left_count;
    return {s.node + left_count, s.first + left_count, s.count - left_count};
  }
  [[nodiscard]] Bounds box(const Subtree& s) const {
    Bounds box = nothing;
    for (std::uint32_t i = s.first; i < s.first + s.count; ++i) box.grow(tree_.items[i].box);
    return box;
  }
  [[nodiscard]] bool of_copies() const { return contents_.copy != nullptr; }
  [[nodiscard]] bool is_leaf(const Subtree& s) const { return s.count == 1 || plan_of(s).leaf(); }
  [[nodiscard]] int height(const Subtree& s) const { return s.count == 1 ? 0 : plan_of(s).height(); }

  // Ylitie et al. 2017, equations 2 to 5. The recursion is as deep as the binary tree.
  Costs solve(const Subtree& subtree) {
    Costs costs;
    if (subtree.count == 1) {
      costs.box = box(subtree);
      costs.cost.fill(costs.box.half_area() * triangle_cost);
      return costs;
    }
    Costs left, right;
    in_both_children(
        subtree, [&] { left = solve(left_of(subtree)); }, [&] { right = solve(right_of(subtree)); });
    costs.box.grow(left.box);
    costs.box.grow(right.box);
    const float area = costs.box.half_area();
    Plan plan;
    const Distribution all = distribute(left, right, 8);
    plan.set_split(8, all.left);
    const float as_node = all.cost + area * node_cost;
    const float as_leaf = area * triangle_cost * static_cast<float>(subtree.count);
    const bool leaf = !of_copies() && subtree.count <= max_leaf_triangles && as_leaf <= as_node;
    if (leaf) plan.set_leaf();
    costs.cost[1] = leaf ? as_leaf : as_node;
    for (int roots = 2; roots < 8; ++roots) {
      const Distribution some = distribute(left, right, roots);
      const float fewer = costs.cost[static_cast<std::size_t>(roots - 1)];
      if (some.cost < fewer) plan.set_split(roots, some.left);
      costs.cost[static_cast<std::size_t>(roots)] = std::min(some.cost, fewer);
    }
    costs.height = 1 + std::max(left.height, right.height);
    plan.set_height(costs.height);
    tree_.nodes[subtree.node].plan = plan.bits();
    return costs;
  }

  // Collects the roots that the plan gives to a subtree which may have `roots` of them.
  void gather(const Subtree& subtree, int roots, Children& children) const {
    if (subtree.count > 1) {
      const Plan plan = plan_of(subtree);
      while (roots > 1 && plan.split(roots) == 0) --roots;
      if (roots > 1) {
        gather(left_of(subtree), plan.split(roots), children);
        gather(right_of(subtree), roots - plan.split(roots), children);
        return;
      }
    }
    children.add(subtree);
  }

  // Collects all subtrees that lie `levels` binary levels below.
  void gather_levels(const Subtree& subtree, int levels, Children& children) const {
    if (levels == 0 || is_leaf(subtree)) return children.add(subtree);
    gather_levels(left_of(subtree), levels - 1, children);
    gather_levels(right_of(subtree), levels - 1, children);
  }

  // Returns the planned children of a node. If one of them is too high for the levels of nodes that remain below this one,
  // returns the descendants three binary levels down instead, which fit: the subtree's height is at most 3 * (levels_below
  // + 1).
  [[nodiscard]] Children children_of(const Subtree& subtree, int levels_below) const {
    Children children;
    if (subtree.count == 1) {
      children.add(subtree);
      return children;
    }
    gather(left_of(subtree), plan_of(subtree).split(8), children);
    gather(right_of(subtree), 8 - plan_of(subtree).split(8), children);
    const bool fits = std::all_of(children.subtree.begin(), children.subtree.begin() + children.count,
                                  [&](const Subtree& s) { return is_leaf(s) || height(s) <= 3 * levels_below; });
    if (fits) return children;
    children.count = 0;
    gather_levels(left_of(subtree), 2, children);
    gather_levels(right_of(subtree), 2, children);
    return children;
  }

  void emit(std::size_t number, const Subtree& subtree, int level) {
    bvh_.depth = std::max(bvh_.depth, level);
    const Children children = children_of(subtree, max_depth_ - level);
    std::array<Bounds, 8> boxes;
    for (std::size_t i = 0; i < children.count; ++i) boxes[i] = box(children.subtree[i]);
    const std::span<const Bounds> used(boxes.data(), children.count);
    const std::array<int, 8> child_in = assign_slots(used);

    BvhNode node = empty_node(used);
    node.child_base = static_cast<std::uint32_t>(bvh_.nodes.size());
    node.triangle_base = static_cast<std::uint32_t>(bvh_.triangles.size());
    std::array<Subtree, 8> inner;
    std::size_t inner_count = 0;
    for (std::size_t slot = 0; slot < 8; ++slot) {
      if (child_in[slot] < 0) continue;
      const auto child = static_cast<std::size_t>(child_in[slot]);
      set_box(node, slot, boxes[child]);
      if (!of_copies() && is_leaf(children.subtree[child])) {
        node.meta[slot] = leaf_meta(children.subtree[child].count, bvh_.triangles.size() - node.triangle_base);
        append_triangles(children.subtree[child]);
      } else {
        node.meta[slot] = static_cast<std::uint8_t>((1U << 5U) | (24U + slot));
        node.inner_mask = static_cast<std::uint8_t>(node.inner_mask | (1U << slot));
        inner[inner_count++] = children.subtree[child];
      }
    }
    bvh_.nodes[number] = node;
    bvh_.nodes.resize(bvh_.nodes.size() + inner_count);
    for (std::size_t i = 0; i < inner_count; ++i) {
      if (of_copies() && is_leaf(inner[i])) {
        append_copy(static_cast<std::uint32_t>(node.child_base + i), inner[i]);
      } else {
        emit(node.child_base + i, inner[i], level + 1);
      }
    }
  }

  void append_copy(std::uint32_t number, const Subtree& leaf) {
    set_copy(bvh_, number, contents_.copy(tree_.items[leaf.first].reference()));
    bvh_.copies.push_back(number);
  }

  void append_triangles(const Subtree& leaf) {
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      bvh_.triangles.push_back(contents_.triangle(tree_.items[i].reference()));
    }
  }

  static std::uint8_t leaf_meta(std::uint32_t count, std::size_t first) {
    return static_cast<std::uint8_t>((((1U << count) - 1U) << 5U) | first);
  }

  BinaryTree& tree_;
  const ItemContents& contents_;
  int max_depth_;
  Bvh bvh_;
};

}  // namespace

Bvh collapse(BinaryTree& tree, const ItemContents& contents, int max_depth) {
  return Collapser(tree, contents, max_depth).run();
}

}  // namespace sunfleck::detail
