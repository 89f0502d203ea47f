#include "physics/transport/indirect/packet_draw.h"

#include "base/in_blocks.h"
#include "base/prefetch.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace sunfleck {
namespace {

constexpr double unit = 0x1p32;  // of expectations
// Places and packets that a thread takes at a time.
constexpr std::size_t places_per_draw_block = 2048;
constexpr std::size_t packets_per_block = 4096;

using shared::least_of_column;
using shared::least_packets;
using shared::least_sum;

}  // namespace

PacketDraw::PacketDraw(const Scattering& scattering, const PlaceAim* aim, double packets,
                       const std::vector<std::int64_t>& start, DrawArrays& arrays)
    : scattering_(scattering),
      aim_(aim),
      arrays_(arrays),
      start_(start),
      scales_(start.size()),
      least_(start.size()),
      loads_(start.size()),
      weights_(start.size()) {
  each_ = packets_for_each(packets, start);
}

std::uint64_t PacketDraw::packets_for_each(double packets, const std::vector<std::int64_t>& start) {
  const auto lit = std::count_if(start.begin(), start.end(), [](std::int64_t flux) { return flux > 0; });
  return static_cast<std::uint64_t>(packets * unit / static_cast<double>(std::max<std::ptrdiff_t>(1, lit)));
}

void PacketDraw::draw(const WaitingFlux& places, ColumnRange columns, std::span<const std::int64_t> totals,
                      std::uint64_t offset) {
  columns_ = columns;
  set_scales(totals);
  expect(places);
  take(offset);
  weigh(places, totals);
}

// A column gets its part of the packets, as large as the part of its flux that still waits.
void PacketDraw::set_scales(std::span<const std::int64_t> totals) {
  any_least_ = false;
  for (std::size_t c = columns_.first; c < columns_.first + columns_.count; ++c) {
    scales_.set(c, 0, 0);
    least_.set(c, 0, 0);
    if (totals[c] == 0) continue;
    const auto total = static_cast<std::uint64_t>(totals[c]);
    const auto all = static_cast<std::uint64_t>(std::max(start_[c], totals[c]));
    const std::uint64_t wanted = shared::long_quotient(shared::product_high(each_, total), each_ * total, all);
    scales_.set(c, shared::scale_of(wanted, total));
    if (wanted >= least_of_column) continue;
    least_.set(c, shared::scale_of(least_of_column, total));
    any_least_ = true;
  }
}

// Returns the expectations of the two sides of a place.
std::array<std::uint64_t, 2> PacketDraw::expectations(const EmissionPoint& place, std::span<const std::int64_t> quanta) const {
  const ScatteredParts parts = scattering_.scattered(place);
  OfBothParts expected = columns::sum_scaled(quanta, parts, scales_, columns_.first);
  if (any_least_) {
    // The largest and not the sum, because a packet serves all columns.
    expected = columns::singly::largest_of(expected, columns::largest_scaled(quanta, parts, least_, columns_.first));
  }
  if (place.surface % 2 == 0) return {expected.reflected, expected.transmitted};
  return {expected.transmitted, expected.reflected};
}

// Sums the expectations within each block, and those of all blocks before it.
void PacketDraw::expect(const WaitingFlux& places) {
  arrays_.up_to.resize(2 * places.size());
  const std::size_t blocks = block_count(places.size(), places_per_draw_block);
  before_.assign(2 * blocks + 1, {});
  in_blocks(places.size(), places_per_draw_block, [&](std::size_t block, std::size_t first, std::size_t end) {
    std::array<BlockSums, 2> sums;
    for (std::size_t k = first; k < end; ++k) {
      if (k + prefetch_ahead < end) prefetch_row(places.quanta(k + prefetch_ahead, columns_));
      const EmissionPoint& place = places.place(k);
      const std::array<std::uint64_t, 2> expected = expectations(place, places.quanta(k, columns_));
      const std::uint64_t aim = aim_ != nullptr ? aim_->part(place) : std::uint64_t{1} << 32U;
      for (std::size_t side = 0; side < 2; ++side) {
        sums[side].unaimed += expected[side];
        sums[side].aimed += shared::part_of(expected[side], aim, 0);
        arrays_.up_to[side * places.size() + k] = sums[side].aimed;
      }
    }
    for (std::size_t side = 0; side < 2; ++side) before_[side * blocks + block] = sums[side];
  });
  BlockSums sums;
  for (BlockSums& block : before_) {
    sums.aimed += std::exchange(block.aimed, sums.aimed);
    sums.unaimed += std::exchange(block.unaimed, sums.unaimed);
  }
}

void PacketDraw::take(std::uint64_t offset) {
  arrays_.number.clear();
  const auto [sum, unaimed] = before_.back();
  if (sum < least_sum) return;
  if (first_round_ && aim_ != nullptr) pace_ = shared::long_quotient(unaimed >> 32U, unaimed << 32U, sum);
  first_round_ = false;
  const std::uint64_t gain = std::max(pace_, shared::long_quotient(least_packets, 0, sum) + 1);
  arrays_.number.resize(shared::drawn_up_to(sum, gain, offset));
  const std::size_t places = arrays_.up_to.size() / 2;
  const std::size_t blocks = before_.size() / 2;
  in_blocks(places, places_per_draw_block, [&](std::size_t block, std::size_t first, std::size_t end) {
    for (std::size_t side = 0; side < 2; ++side) {
      take_block(before_[side * blocks + block].aimed, gain, offset, side * places + first, side * places + end);
    }
  });
}

// Completes the sums of a block, and numbers the sides of the packets that are drawn from it.
void PacketDraw::take_block(std::uint64_t before, std::uint64_t gain, std::uint64_t offset, std::size_t first,
                            std::size_t end) {
  std::uint64_t taken = shared::drawn_up_to(before, gain, offset);
  for (std::size_t k = first; k < end; ++k) {
    arrays_.up_to[k] += before;
    const std::uint64_t up_to = shared::drawn_up_to(arrays_.up_to[k], gain, offset);
    for (; taken < up_to; ++taken) arrays_.number[taken] = static_cast<std::uint32_t>(k);
  }
}

void PacketDraw::weigh(const WaitingFlux& places, std::span<const std::int64_t> totals) {
  arrays_.weight.resize(packets() * columns_.count);
  std::fill(weights_.begin(), weights_.end(), 0);
  std::mutex joining;
  in_blocks(packets(), packets_per_block, [&](std::size_t, std::size_t first, std::size_t end) {
    std::vector<std::uint64_t> weights(weights_.size());
    weigh_block(places, first, end, weights);
    const std::lock_guard lock(joining);
    for (std::size_t c = 0; c < weights.size(); ++c) weights_[c] += weights[c];
  });
  for (std::size_t c = columns_.first; c < columns_.first + columns_.count; ++c) {
    loads_.set(c, shared::load_of(static_cast<std::uint64_t>(totals[c]), weights_[c]));
  }
}

// Adds the weights of the packets from `first` to `end`.
void PacketDraw::weigh_block(const WaitingFlux& places, std::size_t first, std::size_t end,
                             std::vector<std::uint64_t>& weights) {
  shared::Sharing sharing{};
  for (std::size_t p = first; p < end; ++p) {
    if (p + prefetch_ahead < end) prefetch_row(places.quanta(source(p + prefetch_ahead).place, columns_));
    const std::uint32_t number = arrays_.number[p];
    if (p == first || number != arrays_.number[p - 1]) {
      const std::uint64_t before = number > 0 ? arrays_.up_to[number - 1] : 0;
      sharing = shared::sharing_of(arrays_.up_to[number] - before, aim_ == nullptr ? 0 : shared::least_aim_bits);
    }
    const PacketSource from = source(p);
    columns::weigh(places.quanta(from.place, columns_), scattering_.sent(places.place(from.place), from.side), scales_,
                   columns_.first, sharing, &arrays_.weight[p * columns_.count], weights.data());
  }
}

}  // namespace sunfleck
