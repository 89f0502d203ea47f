#pragma once
// Points of surfaces from which light leaves, and rays that start there.

#include "physics/canopy/canopy.h"
#include "shared/rounds.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace sunfleck {

// A point on a side of an element, or on the ground, where light landed. What is reflected leaves from the same side, what is
// transmitted from the other one.
struct EmissionPoint {
  std::uint32_t surface = 0;  // 2 * element + side, or shared::landed_on_ground
  std::uint32_t order = 0;    // in the tree's leaf order; on the ground ground_order + cell of the soil's map
  float a = 0.0F;             // barycentric weight of corner b; x on the ground
  float b = 0.0F;             // barycentric weight of corner c; z on the ground
  std::int32_t level = 0;     // layer of the place; -1 for soil
  std::uint32_t face = 0;     // number of the face's coefficients (Scattering)
  std::uint32_t u = 0;        // random bits by which the quanta split (shared::part_of)
};

using shared::ground_order;

// Returns the array index of a level; the soil's level has index 0.
[[nodiscard]] constexpr std::size_t level_index(std::int32_t level) {
  return static_cast<std::size_t>(std::int64_t{level} + 1);
}

using shared::anywhere;

// How far the origin of a packet lies from its surface, and the height of the ground.
struct EmissionFrame {
  float offset_m = 0.0F;  // distance of the origin in front of the surface
  float ground_y_m = 0.0F;
};

// A packet without direction that starts at a point of a surface, and the normal of the side there.
struct PacketStart {
  shared::Packet packet;
  glm::vec3 normal{0.0F, 1.0F, 0.0F};
};
// `surface`, `a` and `b` are those of an EmissionPoint, and the packet starts on the side that `surface` names.
[[nodiscard]] PacketStart start_at(const Canopy& canopy, std::uint32_t surface, float a, float b, const EmissionFrame& frame);

}  // namespace sunfleck
