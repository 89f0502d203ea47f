#pragma once
// The sunflecks of a horizontal plane and how large they are.

#include "canopy/plot.h"
#include "transport/result.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// Flecks of at least lower_m2 and less than upper_m2.
struct FleckClass {
  double lower_m2 = 0.0;
  double upper_m2 = 0.0;
  std::size_t flecks = 0;
  double area_share = 0.0;  // of the plane
};

struct FleckSizes {
  std::vector<double> areas_m2;  // of each fleck, ascending
  std::vector<FleckClass>
      classes;                 // bounds 1, 2, 5, 10, ... cm2, from the smallest fleck's class to the largest's; empty: none
  double area_share = 0.0;     // of all flecks in the plane
  double rays_per_cell = 0.0;  // that a cell would get without the canopy, on average
};

// A fleck is a set of cells, joined at their edges, at least half of whose beam rays reach the plane; in a periodic plot cells
// of opposite borders are joined too. A cell that no ray crosses belongs to none. A fleck that meets itself across the border
// counts with its area within one plot. A plane without counts of beam rays has no fleck.
[[nodiscard]] FleckSizes fleck_sizes(const PlaneResult& plane, const Plot& plot);

}  // namespace sunfleck
