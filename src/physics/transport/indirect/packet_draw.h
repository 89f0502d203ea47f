#pragma once
// How the packets of a round are drawn from the flux that waits, and what each of them carries.

#include "base/large_pages.h"
#include "physics/transport/indirect/place_aim.h"
#include "physics/transport/indirect/scattering.h"
#include "physics/transport/indirect/waiting_flux.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// The side of a place from which a packet starts.
struct PacketSource {
  std::uint32_t place = 0;
  std::uint32_t side = 0;
};

// The large arrays of a draw, filled anew by each.
struct DrawArrays {
  LargeVector<std::uint64_t> up_to;   // [upper sides of all places, then lower sides], sums of expectations
  std::vector<std::uint32_t> number;  // [packet], index into up_to, ascending
  LargeVector<std::uint32_t> weight;  // [packet * columns + column] (shared::share_of)
};

// Draws packets by systematic sampling: from all upper sides, part by part of the places, then from all lower ones. With both
// sides of a landing next to each other, the same side would be taken every time when a landing's expectation is one packet
// (rho + tau = 1). A packet stands for what its side sends divided by the number of packets expected from it; each column is
// then scaled so that all packets together carry its total. (Scaling level by level would be biased, since it would be a ratio
// of a few packets each.)
//
// The threads of the run share each step. Sums of expectations are made in blocks: within each, then over the blocks, then of
// both.
class PacketDraw {
 public:
  // A first round of all flux in `start`, [column], has about `packets` packets; each column that has any counts alike. `aim`
  // is null if light is not aimed; it and the other objects must outlive this one.
  PacketDraw(const Scattering& scattering, const PlaceAim* aim, double packets, const std::vector<std::int64_t>& start,
             DrawArrays& arrays);

  // Returns the packets of the first round for each column, in units of 2^-32; the arguments are those of the constructor.
  [[nodiscard]] static std::uint64_t packets_for_each(double packets, const std::vector<std::int64_t>& start);

  // Draws the packets of a round. `totals` is what waits, [column], and only `columns` have any; `offset` is random. The places
  // must not change as long as the draw is used.
  void draw(const WaitingFlux& places, ColumnRange columns, std::span<const std::int64_t> totals, std::uint64_t offset);

  [[nodiscard]] std::size_t packets() const { return arrays_.number.size(); }
  [[nodiscard]] PacketSource source(std::size_t packet) const {
    const std::uint32_t number = arrays_.number[packet];
    const auto places = static_cast<std::uint32_t>(arrays_.up_to.size() / 2);
    return number < places ? PacketSource{number, 0} : PacketSource{number - places, 1};
  }
  // Returns whether any packet carries a column.
  [[nodiscard]] bool carries(std::size_t column) const { return loads_.value[column] > 0; }
  // Sets `quanta` to what a packet carries, in the columns that were drawn.
  void carry(std::size_t packet, std::span<std::int64_t> quanta) const {
    columns::carry(std::span(arrays_.weight).subspan(packet * columns_.count, columns_.count), loads_, columns_.first,
                   quanta.data());
  }

 private:
  // Sums of expectations.
  struct BlockSums {
    std::uint64_t aimed = 0, unaimed = 0;
  };

  void set_scales(std::span<const std::int64_t> totals);
  void expect(const WaitingFlux& places);
  void take(std::uint64_t offset);
  void take_block(std::uint64_t before, std::uint64_t gain, std::uint64_t offset, std::size_t first, std::size_t end);
  void weigh(const WaitingFlux& places, std::span<const std::int64_t> totals);
  void weigh_block(const WaitingFlux& places, std::size_t first, std::size_t end, std::vector<std::uint64_t>& weights);
  [[nodiscard]] std::array<std::uint64_t, 2> expectations(const EmissionPoint& place,
                                                          std::span<const std::int64_t> quanta) const;

  const Scattering& scattering_;
  const PlaceAim* aim_;
  DrawArrays& arrays_;
  std::vector<std::int64_t> start_;  // [column]
  std::uint64_t each_ = 0;           // packets for each column in the first round, in units of 2^-32
  ColumnRange columns_;
  FactorColumns scales_, least_;  // packets for each quantum: wanted, and at least
  bool any_least_ = false;
  FactorColumns loads_;
  std::vector<std::uint64_t> weights_;  // [column], sums over all packets
  std::vector<BlockSums> before_;       // [side * blocks + block], of all before it; the last element is of all blocks
  // Packets drawn for each one expected, in units of 2^-32. Aiming takes packets from the first round, which this makes up for.
  std::uint64_t pace_ = std::uint64_t{1} << 32U;
  bool first_round_ = true;
};

}  // namespace sunfleck
