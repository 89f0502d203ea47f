#include "physics/bvh/build.h"

#include "base/check.h"
#include "physics/bvh/own_tree.h"
#include "physics/bvh/two_levels.h"

namespace sunfleck {

Bvh build_bvh(const Canopy& canopy, float padding_m) {
  EXPECT(padding_m, >=, 0.0F);
  if (!canopy.corners.copies().empty()) return detail::build_two_levels(canopy, padding_m);
  return detail::build_own_tree(canopy, padding_m, max_bvh_depth);
}

}  // namespace sunfleck
