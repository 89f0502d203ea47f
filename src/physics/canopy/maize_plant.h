#pragma once
// One maize plant at grain filling: numbers and shapes drawn from published profiles, before any triangle is made.

#include "physics/canopy/maize.h"
#include "physics/canopy/maize_surface.h"

#include <cstdint>
#include <vector>

namespace sunfleck {

struct MaizeLeaf {
  int rank = 0;  // counted from the ground, including senesced leaves
  Blade blade;
};

// A plant that stands at (0, 0, 0).
struct MaizePlant {
  std::vector<MaizeLeaf> leaves;  // green leaves, by rank
  Tube stem;                      // with its sheaths, up to the foot of the tassel
  Tube ear;                       // the husked ear on its shank
  std::vector<Blade> husk_tips;   // the short blades in which the husk leaves end
  std::vector<Tube> tassel;       // the spike, then its branches
};

// Returns a plant. Plants of one seed differ by their number.
[[nodiscard]] MaizePlant grow_maize_plant(std::uint64_t seed, std::uint32_t number);

// Returns the same stand as the other make_maize with triangles of a chosen size.
[[nodiscard]] Mesh make_maize(const MaizeStand& stand, const MaizeDetail& detail);

}  // namespace sunfleck
