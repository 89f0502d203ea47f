#include "files/formats/mesh/polygon_cut.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

namespace sunfleck {
namespace {

// Returns twice the area of a polygon, as a vector along its normal. Positions are relative to the first corner, since the corners
// may be far from zero.
glm::dvec3 twice_area(std::span<const glm::dvec3> corners) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 2; i < corners.size(); ++i) sum += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

// Returns the corners as seen along the axis that is closest to the polygon's normal, from the side from which they run
// counter-clockwise.
std::vector<glm::dvec2> seen_from_above(std::span<const glm::dvec3> corners) {
  const glm::dvec3 normal = twice_area(corners);
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  }
  const int first = normal[axis] < 0.0 ? (axis + 2) % 3 : (axis + 1) % 3;
  const int second = 3 - axis - first;
  std::vector<glm::dvec2> flat;
  for (const glm::dvec3& corner : corners)
    flat.emplace_back(corner[first] - corners[0][first], corner[second] - corners[0][second]);
  return flat;
}

// Returns twice the area of a triangle, positive if it runs counter-clockwise.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class EarCutter {
 public:
  explicit EarCutter(std::span<const glm::dvec3> corners) : flat_(seen_from_above(corners)), left_(corners.size()) {
    std::iota(left_.begin(), left_.end(), 0U);
  }

  std::vector<CornerTriangle> run() {
    std::vector<CornerTriangle> triangles;
    std::size_t from = 0;
    while (left_.size() >= 3) {
      const std::size_t ear = next_ear(from);
      triangles.push_back({left_[before(ear)], left_[ear], left_[after(ear)]});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
      from = ear;
    }
    return triangles;
  }

 private:
  [[nodiscard]] std::size_t before(std::size_t k) const { return (k + left_.size() - 1) % left_.size(); }
  [[nodiscard]] std::size_t after(std::size_t k) const { return (k + 1) % left_.size(); }
  [[nodiscard]] double turn_at(std::size_t k) const {
    return turn(flat_[left_[before(k)]], flat_[left_[k]], flat_[left_[after(k)]]);
  }

  // Returns the next ear from there on; without any, a corner between two edges of one line, or the next corner.
  [[nodiscard]] std::size_t next_ear(std::size_t from) const {
    for (const bool flat : {false, true}) {
      for (std::size_t step = 0; step < left_.size(); ++step) {
        const std::size_t k = (from + step) % left_.size();
        if (flat ? turn_at(k) == 0.0 : is_ear(k)) return k;
      }
    }
    return from % left_.size();
  }

  // Returns whether the triangle at a corner lies in the polygon: it turns with it, and no corner that turns the other way is in it.
  [[nodiscard]] bool is_ear(std::size_t k) const {
    if (!(turn_at(k) > 0.0)) return false;
    const std::array<glm::dvec2, 3> ear = {flat_[left_[before(k)]], flat_[left_[k]], flat_[left_[after(k)]]};
    for (std::size_t other = 0; other < left_.size(); ++other) {
      const glm::dvec2& place = flat_[left_[other]];
      if (std::find(ear.begin(), ear.end(), place) != ear.end() || turn_at(other) > 0.0) continue;
      if (turn(ear[0], ear[1], place) >= 0.0 && turn(ear[1], ear[2], place) >= 0.0 && turn(ear[2], ear[0], place) >= 0.0)
        return false;
    }
    return true;
  }

  std::vector<glm::dvec2> flat_;
  std::vector<std::uint32_t> left_;  // corners that are not cut off
};

}  // namespace

bool fan_folds(std::span<const glm::dvec3> corners) {
  if (corners.size() < 4) return false;
  const glm::dvec3 whole = twice_area(corners);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    if (glm::dot(glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]), whole) < 0.0) return true;
  }
  return false;
}

std::vector<CornerTriangle> cut_ears(std::span<const glm::dvec3> corners) {
  EXPECT(corners.size(), >=, std::size_t{3});
  EXPECT(corners.size(), <=, most_corners_with_ears);
  return EarCutter(corners).run();
}

}  // namespace sunfleck
