#pragma once
// The ground rectangle of a scene: X (south) from 0 to size_x_m, Z (west) from 0 to size_z_m.

namespace sunfleck {

// The axes in which the user gives and receives coordinates, in the order of the three numbers. The program itself only knows
// the first; files/scene converts what it reads, and files/results what it writes (physics/canopy/axes.h).
enum class Axes {
  south_up_west,  // X south, Y up, Z west, from the plot's north-east corner
  east_north_up   // x east, y north, z up, from its south-west corner
};

struct Plot {
  double size_x_m = 1.0;
  double size_z_m = 1.0;
  // True: the canopy repeats sideways without end; false: it stands alone, with soil only under the rectangle.
  bool periodic = true;
  Axes axes = Axes::south_up_west;

  [[nodiscard]] double area_m2() const { return size_x_m * size_z_m; }
};

}  // namespace sunfleck
