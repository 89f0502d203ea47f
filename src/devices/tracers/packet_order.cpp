#include "devices/tracers/packet_order.h"

#include "base/rounding.h"
#include "shared/rounds.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sunfleck {
namespace {

constexpr std::size_t window = 512;
constexpr std::size_t windows_per_task = 16;
constexpr std::size_t sectors = shared::sectors;  // 16 per octant

// Returns a sector: the octahedron's faces, each divided into a grid by two components of the direction.
std::uint8_t sector_of(const glm::vec3& direction) {
  const float x = std::fabs(direction.x);
  const float y = std::fabs(direction.y);
  const float sum = std::max(x + y + std::fabs(direction.z), std::numeric_limits<float>::min());
  const float per_share = 3.999F / sum;
  const unsigned octant = (direction.x < 0.0F ? 4U : 0U) | (direction.y < 0.0F ? 2U : 0U) | (direction.z < 0.0F ? 1U : 0U);
  const auto column = static_cast<unsigned>(x * per_share);
  const auto row = static_cast<unsigned>(y * per_share);
  return static_cast<std::uint8_t>(octant * 16 + row * 4 + column);
}

// Counting sort that keeps the order of packets within a sector.
void order_window(std::span<const shared::Packet> packets, std::uint32_t first, std::span<std::uint32_t> order) {
  std::array<std::uint8_t, window> sector{};
  std::array<std::uint32_t, sectors + 1> begin{};
  for (std::size_t k = 0; k < packets.size(); ++k) {
    sector[k] = sector_of(packets[k].direction);
    ++begin[sector[k] + 1U];
  }
  for (std::size_t s = 0; s < sectors; ++s) begin[s + 1] += begin[s];
  for (std::size_t k = 0; k < packets.size(); ++k) order[begin[sector[k]]++] = first + static_cast<std::uint32_t>(k);
}

}  // namespace

std::vector<std::uint32_t> order_by_direction(std::span<const shared::Packet> packets) {
  std::vector<std::uint32_t> order(packets.size());
  const std::size_t windows = block_count(packets.size(), window);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, windows, windows_per_task), [&](const auto& range) {
    for (std::size_t first = range.begin() * window; first < std::min(range.end() * window, packets.size()); first += window) {
      const std::size_t count = std::min(window, packets.size() - first);
      order_window(packets.subspan(first, count), static_cast<std::uint32_t>(first), std::span(order).subspan(first, count));
    }
  });
  return order;
}

}  // namespace sunfleck
