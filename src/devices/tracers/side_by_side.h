#pragma once
// Walks the tree with several rays side by side: what one ray waits for, memory or a test on which its way depends, comes while
// the others go on.

#include "devices/tracers/cpu_walk.h"

#include <cstddef>

namespace sunfleck {

// Number of searches that go on side by side.
inline constexpr std::size_t searches_at_once = 8;

// Where searches come from, and where hits go.
class SearchSource {
 public:
  virtual ~SearchSource() = default;

  // Sets the first search of a slot, a number below searches_at_once; returns false if there is none.
  [[nodiscard]] virtual bool begin(std::size_t slot, Search& search) = 0;

  // Takes the nearest hit of a slot's search, and turns `search`, which is that one, into the next; returns false if there is
  // none.
  [[nodiscard]] virtual bool next(std::size_t slot, const CpuHit& hit, Search& search) = 0;
};

// Makes all searches of the source. The hits are those of nearest_hit().
void search_side_by_side(const Bvh& bvh, SearchSource& source);

}  // namespace sunfleck
