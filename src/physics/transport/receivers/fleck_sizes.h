#pragma once
// The sizes of the sunflecks on a horizontal plane.

#include "physics/canopy/plot.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// The flecks of at least lower_m2 and less than upper_m2.
struct FleckClass {
  double lower_m2 = 0.0;
  double upper_m2 = 0.0;
  std::size_t flecks = 0;
  double area_share = 0.0;  // of the plane
};

// A cell's share of ten rays has a standard error of up to 0.16. With fewer rays, chance would join, split and make flecks.
inline constexpr double least_fleck_rays = 10.0;

struct FleckSizes {
  // Area of each fleck, ascending.
  std::vector<double> areas_m2;
  // Classes with bounds 1, 2, 5, 10, ... cm2, from the class of the smallest fleck to that of the largest; empty without
  // flecks.
  std::vector<FleckClass> classes;
  double area_share = 0.0;     // of all flecks together, in the plane
  double rays_per_cell = 0.0;  // mean number of rays that a cell would receive without the canopy

  // Returns whether a cell has enough rays, on average, for the sizes to mean anything.
  [[nodiscard]] bool enough_rays() const { return rays_per_cell >= least_fleck_rays; }
};

// Returns the sunflecks of a plane. A fleck is a set of edge-connected cells, each reached by at least half of the beam rays
// that cross it; in a periodic plot cells on opposite borders are connected too. A cell that no ray crosses belongs to no
// fleck. A fleck that meets itself across the border counts with its area within one plot. A plane without counts of beam
// rays has no flecks.
[[nodiscard]] FleckSizes fleck_sizes(const PlaneResult& plane, const Plot& plot);

}  // namespace sunfleck
