#pragma once
// The ground rectangle of a scene: X (south) from 0 to size_x_m, Z (west) from 0 to size_z_m.

namespace sunfleck {

struct Plot {
  double size_x_m = 1.0;
  double size_z_m = 1.0;
  // True: the canopy repeats sideways without end; false: it stands alone, with soil only under the rectangle.
  bool periodic = true;

  [[nodiscard]] double area_m2() const { return size_x_m * size_z_m; }
};

}  // namespace sunfleck
