#pragma once
// The ground rectangle that a scene is about: X (south) from 0 to size_x_m, Z (west) from 0 to size_z_m.

namespace sunfleck {

struct Plot {
  double size_x_m = 1.0;
  double size_z_m = 1.0;
  bool periodic = true;  // the canopy repeats sideways without end; false: it stands alone, soil under the rectangle only

  [[nodiscard]] double area_m2() const { return size_x_m * size_z_m; }
};

}  // namespace sunfleck
