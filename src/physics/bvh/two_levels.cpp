#include "physics/bvh/two_levels.h"

#include "base/error.h"
#include "physics/bvh/own_tree.h"
#include "physics/bvh/references.h"

#include <fmt/format.h>

#include <algorithm>
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

// A copy and the box of its triangles in the canopy.
struct PlacedCopy {
  BvhCopy copy{};
  Box box;
};

BvhCopy make_copy(const shared::CopyTurn& turn, std::uint32_t part, std::uint32_t first_element) {
  BvhCopy copy{};
  copy.shift = {turn.shift.x, turn.shift.y, turn.shift.z};
  copy.mark = 0xffffffffU;
  copy.first_element = first_element;
  copy.cos_out = turn.cos_out;
  copy.sin_out = turn.sin_out;
  copy.scale = turn.scale;
  copy.cos_back = turn.cos_back;
  copy.sin_back = turn.sin_back;
  copy.per_scale = turn.per_scale;
  copy.part = part;
  return copy;
}

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
  };

  void add_own() {
    if (canopy_.corners.own().empty()) return;
    Part part{own_corners, build_own_tree(canopy_, padding_m_, depth_of_triangles)};
    if (part.tree.triangles.empty()) return;
    PlacedCopy placed{make_copy(unturned, 0, 0), nowhere};
    for (const BvhTriangle& t : part.tree.triangles) {
      for (const auto& corner : {t.a, t.b, t.c}) grow(placed.box, {corner[0], corner[1], corner[2]});
    }
    parts_.push_back(std::move(part));
    copies_.push_back(placed);
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
    parts_.push_back({number, build_tree(tree, {.triangle = triangle, .copy = nullptr}, depth_of_triangles)});
  }

  void add_images(const MeshCopy& placed) {
    const std::uint32_t part = part_of_mesh_[placed.mesh];
    Box box = nowhere;
    for (const BvhTriangle& t : parts_[part].tree.triangles) {
      for (const auto& corner : {t.a, t.b, t.c}) {
        grow(box, shared::placed_point(placed.turn, {corner[0], corner[1], corner[2]}));
      }
    }
    if (parts_[part].tree.triangles.empty()) return;
    const ImageRanges images = images_of(canopy_, box, placed.first_element);
    for (int dz = images.first_z; dz <= images.last_z; ++dz) {
      for (int dx = images.first_x; dx <= images.last_x; ++dx) {
        const auto moved = [&](const glm::vec3& point) {
          return glm::vec3(static_cast<float>(point.x + dx * canopy_.period_m.x), point.y,
                           static_cast<float>(point.z + dz * canopy_.period_m.y));
        };
        shared::CopyTurn turn = placed.turn;
        turn.shift = moved(turn.shift);
        PlacedCopy copy{make_copy(turn, part, placed.first_element), {moved(box.lo), moved(box.hi)}};
        copy.copy.image = pack_image(dx, dz);
        copies_.push_back(copy);
      }
    }
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
      copy.root = part.root;
      copy.order_offset = static_cast<std::uint32_t>(order - part.first_triangle);
      set_copy(bvh, node, copy);
      order += part.triangles;
    }
    if (order > max_references) {
      throw_input(fmt::format("canopy: {} triangles, counting the copies that reach into the plot", order),
                  fmt::format("a tree holds at most {}", max_references),
                  "place fewer plants, or enlarge plot.size if plants are larger than the plot");
    }
  }

  const Canopy& canopy_;
  float padding_m_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> part_of_mesh_;
  std::vector<PlacedCopy> copies_;
};

}  // namespace

Bvh build_two_levels(const Canopy& canopy, float padding_m) {
  return TwoLevels(canopy, padding_m).build();
}

}  // namespace sunfleck::detail
