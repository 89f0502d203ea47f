#pragma once
// A result with one receiver plane, small enough to check by hand.

#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <utility>
#include <vector>

namespace sunfleck::test {

// Returns 3 x 2 cells of 0.5 m2 on a plot of 1 m (X) by 3 m (Z), 0.5 m high, with bands PAR (100 W m-2 direct) and NIR (200 W
// m-2). Each cell but one has 12 rays of 1/24 m2 of level ground each. The north-east cell is in the sun, and so is half of the
// one west of it.
inline std::pair<RadiationModel, RadiationResult> small_plane() {
  RadiationModel model;
  model.plot = {1.0, 3.0, true};
  model.bands = {{"PAR", 100.0, 0.0}, {"NIR", 200.0, 0.0}};
  model.sun = SunPosition{0.5, 1.0};
  RadiationResult result;
  result.w_per_quantum = {0.5, 0.25};
  result.ground_per_ray_m2 = 0.5 / 12.0;
  PlaneResult plane;
  plane.height_m = 0.5;
  plane.cells_x = 2;
  plane.cells_z = 3;
  plane.reached = {12, 0, 6, 0, 0, 0};
  plane.crossing = {12, 12, 12, 12, 12, 0};
  plane.down = {10, 0, 20, 0, 0, 4, 0, 0, 0, 0, 0, 0};
  plane.sunfleck_ratio = {0.3, 0.01};
  result.planes = {plane};
  return {model, result};
}

}  // namespace sunfleck::test
