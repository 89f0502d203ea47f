#include "physics/transport/receivers/fleck_sizes.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace sunfleck {
namespace {

constexpr double m2_per_cm2 = 1e-4;
constexpr double rounding = 1e-9;  // relative; keeps a cell of exactly 1 cm2 from falling below its bound

// Disjoint sets of cells (Tarjan 1975, J. ACM 22:215); the root of a set is its lowest cell.
class Sets {
 public:
  explicit Sets(std::size_t cells) : parent_(cells) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t root(std::size_t cell) {
    while (parent_[cell] != cell) {
      parent_[cell] = parent_[parent_[cell]];
      cell = parent_[cell];
    }
    return cell;
  }

  void join(std::size_t a, std::size_t b) {
    const std::size_t root_a = root(a);
    const std::size_t root_b = root(b);
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

std::vector<bool> sunlit_cells(const PlaneResult& plane) {
  std::vector<bool> sunlit(plane.crossing.size());
  for (std::size_t cell = 0; cell < sunlit.size(); ++cell)
    sunlit[cell] = plane.crossing[cell] > 0 && 2 * plane.reached[cell] >= plane.crossing[cell];
  return sunlit;
}

// Returns the number of cells of each fleck.
std::vector<std::size_t> fleck_cells(const std::vector<bool>& sunlit, std::size_t cells_x, std::size_t cells_z, bool periodic) {
  Sets sets(sunlit.size());
  for (std::size_t z = 0; z < cells_z; ++z) {
    for (std::size_t x = 0; x < cells_x; ++x) {
      const std::size_t cell = z * cells_x + x;
      if (!sunlit[cell]) continue;
      const std::size_t south = z * cells_x + (x + 1) % cells_x;
      const std::size_t west = (z + 1) % cells_z * cells_x + x;
      if ((periodic || x + 1 < cells_x) && sunlit[south]) sets.join(cell, south);
      if ((periodic || z + 1 < cells_z) && sunlit[west]) sets.join(cell, west);
    }
  }
  std::vector<std::size_t> of_root(sunlit.size());
  for (std::size_t cell = 0; cell < sunlit.size(); ++cell) {
    if (sunlit[cell]) ++of_root[sets.root(cell)];
  }
  of_root.erase(std::remove(of_root.begin(), of_root.end(), std::size_t{0}), of_root.end());
  return of_root;
}

// Returns the n-th class bound: ..., 0.5, 1, 2, 5, 10, ... cm2 for n = ..., -1, 0, 1, 2, 3, ...
double bound_m2(int n) {
  constexpr double steps[] = {1.0, 2.0, 5.0};
  const int decade = static_cast<int>(std::floor(n / 3.0));
  return steps[n - 3 * decade] * std::pow(10.0, decade) * m2_per_cm2;
}

int class_of(double area_m2) {
  int n = 3 * static_cast<int>(std::floor(std::log10(area_m2 / m2_per_cm2)));
  while (bound_m2(n) > area_m2 * (1.0 + rounding)) --n;
  while (bound_m2(n + 1) <= area_m2 * (1.0 + rounding)) ++n;
  return n;
}

std::vector<FleckClass> classes_of(const std::vector<double>& areas_m2, double plane_m2) {
  if (areas_m2.empty()) return {};
  const int first = class_of(areas_m2.front());
  const int last = class_of(areas_m2.back());
  std::vector<FleckClass> classes;
  for (int n = first; n <= last; ++n) classes.push_back({bound_m2(n), bound_m2(n + 1), 0, 0.0});
  for (const double area_m2 : areas_m2) {
    FleckClass& to = classes[static_cast<std::size_t>(class_of(area_m2) - first)];
    ++to.flecks;
    to.area_share += area_m2 / plane_m2;
  }
  return classes;
}

}  // namespace

FleckSizes fleck_sizes(const PlaneResult& plane, const Plot& plot) {
  const std::size_t cells = std::size_t{plane.cells_x} * plane.cells_z;
  EXPECT(cells, >, std::size_t{0});
  EXPECT(plane.reached.size(), ==, plane.crossing.size());
  FleckSizes sizes;
  if (plane.crossing.empty()) return sizes;
  EXPECT(plane.crossing.size(), ==, cells);
  const double cell_m2 = plot.area_m2() / static_cast<double>(cells);
  for (const std::size_t count : fleck_cells(sunlit_cells(plane), plane.cells_x, plane.cells_z, plot.periodic))
    sizes.areas_m2.push_back(static_cast<double>(count) * cell_m2);
  std::sort(sizes.areas_m2.begin(), sizes.areas_m2.end());
  sizes.classes = classes_of(sizes.areas_m2, plot.area_m2());
  sizes.area_share = std::accumulate(sizes.areas_m2.begin(), sizes.areas_m2.end(), 0.0) / plot.area_m2();
  const std::uint64_t rays = std::accumulate(plane.crossing.begin(), plane.crossing.end(), std::uint64_t{0});
  sizes.rays_per_cell = static_cast<double>(rays) / static_cast<double>(cells);
  return sizes;
}

}  // namespace sunfleck
