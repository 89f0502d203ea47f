#pragma once
// What one replicate finds on the sunlit and on all parts of organs, layers and leaves; shade_classes.h makes two classes of it.

#include "physics/transport/indirect/conversion.h"
#include "physics/transport/indirect/place_sums.h"
#include "physics/transport/indirect/replicate.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sunfleck {

// Sums over the parts of groups.
struct ShadeSums {
  ShadeSums(std::size_t groups, std::size_t bands);

  void add(const ShadeSums& other);

  [[nodiscard]] std::size_t groups() const { return lit_m2.size(); }
  // Returns the sums of one group, [band].
  [[nodiscard]] std::span<double> of(std::size_t group, std::vector<double>& sums) const {
    return std::span(sums).subspan(group * bands, bands);
  }

  std::size_t bands = 0;
  std::vector<double> lit_m2;  // [group]
  // [group * bands + band], absorbed; the last one where the sun shines
  std::vector<double> direct_w, indirect_w, lit_indirect_w;
  // [group * bands + band], W2 m-2. With b and o the densities of absorbed light of the beam and other light: the integral of
  // b^2 + 2 b o over the lit area, and those of o times the sum of o in all earlier replicates, over all area and the lit area.
  std::vector<double> lit_square, indirect_square, lit_indirect_square;
};

// The sums of the three kinds of groups.
struct ShadeGroupSums {
  // Without `all_groups` those of organs and layers are empty.
  ShadeGroupSums(const Conversion& conversion, bool all_groups);

  void add(const ShadeGroupSums& other);

  ShadeSums organs, layers, leaves;  // layers: their leaves; the last has one group
};

// Returns the sums of a replicate. What a triangle absorbs of light other than the beam is divided by its sunlit share, and what its
// part in a layer absorbs by that part's: the beam's landings and the packets that land are independent, so the product has no bias
// if the other light is even over the triangle. `landed` is what landed on each side in all replicates added before; the landings of
// this one are added to it. Rows of wide sums are added as soon as the shade sums have read them, while they are in the processor's
// caches.
[[nodiscard]] ShadeGroupSums sum_shade_and_add(const Conversion& conversion, const Replicate& replicate, bool all_groups,
                                               PlaceSums& landed);

}  // namespace sunfleck
