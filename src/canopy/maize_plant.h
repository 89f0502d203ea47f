#pragma once
// One maize plant at grain filling: numbers and shapes drawn from published profiles, before any triangle is made.

#include "canopy/maize.h"
#include "canopy/maize_surface.h"

#include <cstdint>
#include <vector>

namespace sunfleck {

struct MaizeLeaf {
  int rank = 0;  // counted from the ground, senesced leaves included
  Blade blade;
};

// Standing at (0, 0, 0).
struct MaizePlant {
  std::vector<MaizeLeaf> leaves;  // green ones, by rank
  Tube stem;                      // with its sheaths, to the foot of the tassel
  Tube ear;                       // the husked ear on its shank
  std::vector<Blade> husk_tips;   // where the husk leaves end in short blades
  std::vector<Tube> tassel;       // the spike, then its branches
};

// Plants of one seed differ by their number.
[[nodiscard]] MaizePlant grow_maize_plant(std::uint64_t seed, std::uint32_t number);

// make_maize with triangles of another size.
[[nodiscard]] Mesh make_maize(const MaizeStand& stand, const MaizeDetail& detail);

}  // namespace sunfleck
