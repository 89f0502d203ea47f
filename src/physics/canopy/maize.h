#pragma once
// A parametric maize stand at grain filling.

#include "physics/canopy/mesh.h"

#include <cstdint>

namespace sunfleck {

inline constexpr std::uint64_t most_maize_plants = 10000;  // about 2e8 triangles, about 15 GB

struct MaizeStand {
  int rows = 4;                         // lines of plants running north-south (along X), side by side along Z
  int per_row = 3;                      // plants in each line
  double spacing_in_row_m = 0.6;        // along X
  double spacing_between_rows_m = 0.6;  // along Z
  std::uint64_t seed = 1;
};

// Returns a stand of rows x per_row plants, each different, on a plot of (per_row * spacing_in_row_m) x (rows *
// spacing_between_rows_m); every plant stands at the middle of its own cell. The defaults give a sparse stand of 190,000
// triangles and leaf area index 2.2; five plants to the row, 0.3 m apart, give a dense one of 310,000 triangles and leaf
// area index 4.4.
// A plant's organs are its leaves, with their ranks, and one stem, one ear and one tassel of rank 0. Its optics are "leaf",
// for blades and the tips of the husk, and "stem", for all parts that are too thick to transmit light.
[[nodiscard]] Mesh make_maize(const MaizeStand& stand);

}  // namespace sunfleck
