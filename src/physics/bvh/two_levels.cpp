#include "physics/bvh/two_levels.h"

#include "base/error.h"
#include "physics/bvh/own_tree.h"
#include "physics/bvh/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace sunfleck::detail {
namespace {

// Enough for 2^30 copies, and for as many triangles in a mesh as a tree holds.
constexpr int depth_of_copies = 10;
constexpr int depth_of_triangles = max_bvh_depth - depth_of_copies - 1;

constexpr shared::CopyTurn unturned{.shift = glm::vec3(0.0F),
                                    .cos_out = 1.0F,
                                    .sin_out = 0.0F,
                                    .scale = 1.0F,
                                    .cos_back = 1.0F,
                                    .sin_back = 0.0F,
                                    .per_scale = 1.0F};

// Meshes of at least this many triangles enter the tree of copies in up to eight pieces, the children of their root, whose
// boxes overlap those of neighbouring plants less (Benthin et al. 2017, "Improved two-level BVHs using partial re-braiding").
constexpr std::size_t least_divided = 512;

// Neighbouring triangles of a part, below one node.
struct Piece {
  std::uint32_t root = 0;
  std::uint32_t first_triangle = 0;
  std::uint32_t triangles = 0;
};

// Returns the pieces of a tree of triangles: the subtrees of its root, or the whole tree.
std::vector<Piece> pieces_of(const Bvh& tree) {
  const auto triangles = static_cast<std::uint32_t>(tree.triangles.size());
  const BvhNode& root = tree.nodes.front();
  const auto children = static_cast<std::uint32_t>(std::popcount(root.inner_mask));
  // The triangles of a node's own leaves come first, then those of each of its inner children.
  const bool has_leaves = children == 0 || tree.nodes[root.child_base].triangle_base != root.triangle_base;
  if (triangles < least_divided || has_leaves) return {{0, 0, triangles}};
  std::vector<Piece> pieces;
  for (std::uint32_t child = root.child_base; child < root.child_base + children; ++child) {
    const std::uint32_t first = tree.nodes[child].triangle_base;
    const bool last = child + 1 == root.child_base + children;
    pieces.push_back({child, first, (last ? triangles : tree.nodes[child + 1].triangle_base) - first});
  }
  return pieces;
}

// A copy of a piece and the box of its triangles in the canopy.
struct PlacedCopy {
  BvhCopy copy{};
  Box box;
};

void grow(Box& box, const glm::vec3& point) {
  box.lo = glm::min(box.lo, point);
  box.hi = glm::max(box.hi, point);
}

constexpr Box nowhere{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};

class TwoLevels {
 public:
  TwoLevels(const Canopy& canopy, float padding_m) : canopy_(canopy), padding_m_(padding_m) {}

  Bvh build() {
    add_own();
    for (std::uint32_t mesh = 0; mesh < canopy_.corners.meshes().size(); ++mesh) add_mesh(mesh);
    for (const MeshCopy& copy : canopy_.corners.copies()) add_images(copy);
    if (copies_.empty()) return {};
    BinaryTree tree;
    for (const PlacedCopy& placed : copies_) {
      tree.items.push_back(padded_item(placed.box, padding_m_, static_cast<std::uint32_t>(tree.items.size())));
    }
    const auto copy = [&](std::uint32_t item) { return copies_[item].copy; };
    Bvh bvh = build_tree(tree, {.triangle = nullptr, .copy = copy}, depth_of_copies);
    append_parts(bvh);
    return bvh;
  }

 private:
  struct Part {
    std::uint32_t mesh;
    Bvh tree;
    std::vector<Piece> pieces;
  };

  // Refuses more triangles than a tree holds before their copies take memory.
  void count(std::uint64_t triangles) {
    triangles_ += triangles;
    if (triangles_ <= max_references) return;
    throw_input(fmt::format("canopy: {} triangles or more, counting the copies that reach into the plot", triangles_),
                fmt::format("a tree holds at most {}", max_references),
                "place fewer plants, or enlarge plot.size if plants are larger than the plot");
  }

  void add_own() {
    if (canopy_.corners.own().empty()) return;
    Bvh tree = build_own_tree(canopy_, padding_m_, depth_of_triangles);
    if (tree.triangles.empty()) return;
    add_part(own_corners, std::move(tree));
    count(parts_.back().tree.triangles.size());
    for (const Piece& piece : parts_.back().pieces) copies_.push_back(placed_piece(unturned, 0, 0, piece));
  }

  // Boxes are padded so that rounding in the canopy's frame loses no hit.
  [[nodiscard]] float padding_in_mesh_m(std::uint32_t mesh) const {
    float largest = 0.0F;
    for (const MeshCopy& copy : canopy_.corners.copies()) {
      if (copy.mesh == mesh) largest = std::max(largest, copy.turn.per_scale);
    }
    return padding_m_ * largest;
  }

  void add_mesh(std::uint32_t number) {
    const SharedMesh& mesh = canopy_.corners.meshes()[number];
    const float padding_m = padding_in_mesh_m(number);
    std::vector<std::uint32_t> traced;
    BinaryTree tree;
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
      if (!mesh.traced[t]) continue;
      tree.items.push_back(padded_item(box_of(mesh.corners[t]), padding_m, static_cast<std::uint32_t>(traced.size())));
      traced.push_back(static_cast<std::uint32_t>(t));
    }
    const auto triangle = [&](std::uint32_t item) { return bvh_triangle(mesh.corners[traced[item]], traced[item], 0); };
    part_of_mesh_.push_back(static_cast<std::uint32_t>(parts_.size()));
    add_part(number, build_tree(tree, {.triangle = triangle, .copy = nullptr}, depth_of_triangles));
  }

  void add_part(std::uint32_t mesh, Bvh tree) {
    std::vector<Piece> pieces;
    if (!tree.triangles.empty()) pieces = pieces_of(tree);
    parts_.push_back({mesh, std::move(tree), std::move(pieces)});
  }

  [[nodiscard]] PlacedCopy placed_piece(const shared::CopyTurn& turn, std::uint32_t first_element, std::uint32_t part,
                                        const Piece& piece) const {
    PlacedCopy placed{.box = nowhere};
    BvhCopy& copy = placed.copy;
    copy.shift = {turn.shift.x, turn.shift.y, turn.shift.z};
    copy.mark = 0xffffffffU;
    copy.root = piece.root;
    copy.first_element = first_element;
    copy.cos_out = turn.cos_out;
    copy.sin_out = turn.sin_out;
    copy.scale = turn.scale;
    copy.cos_back = turn.cos_back;
    copy.sin_back = turn.sin_back;
    copy.per_scale = turn.per_scale;
    copy.part = part;
    copy.first_triangle = piece.first_triangle;
    copy.triangles = piece.triangles;
    const std::span<const BvhTriangle> all = parts_[part].tree.triangles;
    for (const BvhTriangle& t : all.subspan(piece.first_triangle, piece.triangles)) {
      for (const auto& corner : {t.a, t.b, t.c}) {
        grow(placed.box, shared::placed_point(turn, {corner[0], corner[1], corner[2]}));
      }
    }
    return placed;
  }

  void add_images(const MeshCopy& placed) {
    const std::uint32_t part = part_of_mesh_[placed.mesh];
    for (const Piece& piece : parts_[part].pieces) {
      const PlacedCopy copy = placed_piece(placed.turn, placed.first_element, part, piece);
      const ImageRanges images = images_of(canopy_, copy.box, placed.first_element);
      count(images.count() * copy.copy.triangles);
      for (int dz = images.z.first; dz <= images.z.last; ++dz) {
        for (int dx = images.x.first; dx <= images.x.last; ++dx) copies_.push_back(moved(copy, dx, dz));
      }
    }
  }

  [[nodiscard]] PlacedCopy moved(PlacedCopy placed, int dx, int dz) const {
    const auto shift = [](float at, double by) { return static_cast<float>(at + by); };
    const glm::dvec2 by(dx * canopy_.period_m.x, dz * canopy_.period_m.y);
    placed.copy.shift[0] = shift(placed.copy.shift[0], by.x);
    placed.copy.shift[2] = shift(placed.copy.shift[2], by.y);
    for (glm::vec3* corner : {&placed.box.lo, &placed.box.hi}) {
      corner->x = shift(corner->x, by.x);
      corner->z = shift(corner->z, by.y);
    }
    placed.copy.image = pack_image(dx, dz);
    return placed;
  }

  void append_parts(Bvh& bvh) {
    for (Part& part : parts_) {
      const auto first_node = static_cast<std::uint32_t>(bvh.nodes.size());
      const auto first_triangle = static_cast<std::uint32_t>(bvh.triangles.size());
      for (BvhNode& node : part.tree.nodes) {
        node.child_base += first_node;
        node.triangle_base += first_triangle;
      }
      bvh.nodes.insert(bvh.nodes.end(), part.tree.nodes.begin(), part.tree.nodes.end());
      bvh.triangles.insert(bvh.triangles.end(), part.tree.triangles.begin(), part.tree.triangles.end());
      bvh.parts.push_back({part.mesh, first_node, first_triangle, static_cast<std::uint32_t>(part.tree.triangles.size())});
      bvh.depth = std::max(bvh.depth, part.tree.depth + depth_of_copies + 1);
      part.tree = {};
    }
    std::uint64_t order = 0;
    for (const std::uint32_t node : bvh.copies) {
      BvhCopy copy = copy_at(bvh, node);
      const BvhPart& part = bvh.parts[copy.part];
      copy.root += part.root;
      copy.first_triangle += part.first_triangle;
      copy.order_offset = static_cast<std::uint32_t>(order - copy.first_triangle);
      set_copy(bvh, node, copy);
      order += copy.triangles;
    }
  }

  const Canopy& canopy_;
  float padding_m_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> part_of_mesh_;
  std::vector<PlacedCopy> copies_;
  std::uint64_t triangles_ = 0;  // of all copies
};

}  // namespace

Bvh build_two_levels(const Canopy& canopy, float padding_m) {
  return TwoLevels(canopy, padding_m).build();
}

}  // namespace sunfleck::detail
