#include "physics/bvh/decode.h"

#include "physics/bvh/encode.h"

namespace sunfleck {

Box child_box(const BvhNode& node, int slot) {
  const auto k = static_cast<std::size_t>(slot);
  const glm::vec3 step{detail::power_of_two(node.exponent[0]), detail::power_of_two(node.exponent[1]),
                       detail::power_of_two(node.exponent[2])};
  const glm::vec3 origin{node.origin[0], node.origin[1], node.origin[2]};
  return {origin + glm::vec3(node.lo_x[k], node.lo_y[k], node.lo_z[k]) * step,
          origin + glm::vec3(node.hi_x[k], node.hi_y[k], node.hi_z[k]) * step};
}

}  // namespace sunfleck
