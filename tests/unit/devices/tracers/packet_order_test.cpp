#include "devices/tracers/packet_order.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace sunfleck {
namespace {

std::vector<shared::Packet> packets_towards_anywhere(std::size_t count) {
  RandomStream random(1, 0);
  std::vector<shared::Packet> packets(count);
  for (shared::Packet& packet : packets) {
    for (int axis = 0; axis < 3; ++axis) packet.direction[axis] = static_cast<float>(2.0 * random.unit() - 1.0);
  }
  return packets;
}

unsigned octant(const glm::vec3& direction) {
  return (direction.x < 0.0F ? 4U : 0U) | (direction.y < 0.0F ? 2U : 0U) | (direction.z < 0.0F ? 1U : 0U);
}

TEST(PacketOrder, HoldsEveryPacketOnceAndInItsWindow) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{511}, std::size_t{512}, std::size_t{1300}}) {
    std::vector<std::uint32_t> order = order_by_direction(packets_towards_anywhere(count));
    ASSERT_EQ(order.size(), count);
    for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(order[k] / 512, k / 512);
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all);
  }
}

TEST(PacketOrder, BringsDirectionsTogether) {
  const std::vector<shared::Packet> packets = packets_towards_anywhere(512);
  const std::vector<std::uint32_t> order = order_by_direction(packets);
  for (std::size_t k = 1; k < order.size(); ++k) {
    EXPECT_LE(octant(packets[order[k - 1]].direction), octant(packets[order[k]].direction));
  }
}

TEST(PacketOrder, LeavesABeamAsItIs) {
  std::vector<shared::Packet> beam(700);
  for (shared::Packet& ray : beam) ray.direction = {0.3F, -0.9F, 0.1F};
  const std::vector<std::uint32_t> order = order_by_direction(beam);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

// Directions along an axis, and of any length, do no harm.
TEST(PacketOrder, TakesAnyDirection) {
  std::vector<shared::Packet> packets(4);
  packets[0].direction = {0.0F, -1.0F, 0.0F};
  packets[1].direction = {1e-30F, 1e-30F, 0.0F};
  packets[2].direction = {-1e30F, 0.0F, 0.0F};
  packets[3].direction = {0.0F, 0.0F, 0.0F};
  std::vector<std::uint32_t> order = order_by_direction(packets);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace sunfleck
