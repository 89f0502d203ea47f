#include "physics/transport/triangles/surface_tree.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace sunfleck {
namespace {

constexpr std::uint64_t tree_seed = 0x5eedf0e57;

class TreeMaker {
 public:
  TreeMaker(std::vector<glm::vec3> centres, std::uint64_t stream) : centres_(std::move(centres)), random_(tree_seed, stream) {}

  void cut_all(SurfaceTree& tree) {
    std::vector<TreeRange> waiting(tree.surfaces.rbegin(), tree.surfaces.rend());
    while (!waiting.empty()) {
      const TreeRange range = waiting.back();
      waiting.pop_back();
      if (range.size() < 2) continue;
      const std::uint32_t middle = cut(range, tree.order);
      tree.cuts.push_back({range, middle});
      waiting.push_back({middle, range.end});
      waiting.push_back({range.begin, middle});
    }
  }

 private:
  // Sorts the elements of the range to both sides of a cut and returns its place.
  std::uint32_t cut(const TreeRange& range, std::vector<std::uint32_t>& order) {
    glm::vec3 lo = centres_[order[range.begin]];
    glm::vec3 hi = lo;
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      lo = glm::min(lo, centres_[order[k]]);
      hi = glm::max(hi, centres_[order[k]]);
    }
    const glm::vec3 extent = (hi - lo) * glm::vec3(stretch(), stretch(), stretch());
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const double share = (1.0 + random_.unit()) / 3.0;
    const auto offset = static_cast<std::uint32_t>(std::lround(share * range.size()));
    const std::uint32_t middle = range.begin + std::clamp(offset, 1U, range.size() - 1);
    const auto place = [&](std::uint32_t k) { return order.begin() + k; };
    std::nth_element(place(range.begin), place(middle), place(range.end), [&](std::uint32_t a, std::uint32_t b) {
      const float at_a = centres_[a][axis];
      const float at_b = centres_[b][axis];
      return at_a < at_b || (at_a == at_b && a < b);
    });
    return middle;
  }

  float stretch() { return static_cast<float>(0.5 + random_.unit()); }

  std::vector<glm::vec3> centres_;  // [element]
  RandomStream random_;
};

std::vector<glm::vec3> centres_of(const Canopy& canopy) {
  std::vector<glm::vec3> centres;
  centres.reserve(canopy.size());
  for (const Triangle& corners : canopy.corners) centres.push_back((corners[0] + corners[1] + corners[2]) / 3.0F);
  return centres;
}

}  // namespace

SurfaceTree make_surface_tree(const Canopy& canopy, std::span<const std::uint32_t> surface_of, std::span<const double> weights,
                              std::uint64_t stream) {
  SurfaceTree tree;
  for (std::uint32_t e = 0; e < canopy.size(); ++e) {
    if (weights[e] > 0.0) tree.order.push_back(e);
  }
  std::stable_sort(tree.order.begin(), tree.order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return surface_of[a] < surface_of[b]; });
  const auto count = static_cast<std::uint32_t>(tree.order.size());
  for (std::uint32_t begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && surface_of[tree.order[end]] == surface_of[tree.order[begin]]) ++end;
    tree.surfaces.push_back({begin, end});
  }
  TreeMaker(centres_of(canopy), stream).cut_all(tree);
  return tree;
}

}  // namespace sunfleck
