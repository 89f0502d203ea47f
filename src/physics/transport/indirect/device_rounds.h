#pragma once
// The rounds of an indirect pass as a device makes them on its own: what it is given, and what it finds. Shaders do what
// WaitingFlux, PacketDraw, PacketStarts and PacketBooks do on the host, with the same integers.

#include "physics/transport/indirect/indirect_scene.h"
#include "physics/transport/indirect/scattering.h"
#include "physics/transport/indirect/waiting_flux.h"
#include "shared/rounds.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sunfleck {

// What a device is given for the rounds of one pass.
struct RoundsOrder {
  const IndirectScene& scene;
  const WaitingFlux& places;  // where flux waits before the first round, but for the landings
  // Kept by the tracer; packets also start from block.sampled of them. Null: none.
  std::shared_ptr<const KeptLandings> landings;
  shared::PassBlock block;           // `choices` are the device's own
  double packets = 0.0;              // of the first round, approximately; no round has many more unless packets are aimed
  std::vector<std::uint64_t> faces;  // coefficients: what each reflects, then what each scatters, [face * columns + column]
  std::vector<shared::RoundColumn> columns;  // [column]
  // The small sums (shared/rounds.h), then what moved, [place of the stacks * columns + column].
  std::vector<std::uint64_t> totals;

  // Returns for how many packets a round has room: each column may need a least number of its own. Only where packets are aimed may a
  // round draw more.
  [[nodiscard]] std::uint64_t most_packets() const;
  // Returns the number of places, those of landings that met nothing included.
  [[nodiscard]] std::size_t first_places() const { return places.size() + block.sampled.count; }
};

// What a device found.
struct RoundsSums {
  std::vector<shared::RoundColumn> columns;  // as in RoundsOrder
  std::vector<std::uint64_t> totals;
  std::vector<std::int64_t> side_landed;  // as in IndirectSums, of the packets
  std::vector<std::int64_t> cell_landed, surface_landed;
  std::vector<std::int64_t> plane_cells;  // as PlaneSums::down
  std::vector<std::uint32_t> element_hits;
  std::uint64_t packets = 0, rounds = 0, first_places = 0, most_places = 0;  // places with flux

  // Return the rows of one kind of small sums at the places of a stack, and of what moved from there. [place * columns + column]
  [[nodiscard]] std::span<const std::uint64_t> at_places(const shared::PassBlock& block, const shared::PlaneStack& stack,
                                                         std::uint32_t kind) const;
  [[nodiscard]] std::span<const std::uint64_t> moved(const shared::PassBlock& block, const shared::PlaneStack& stack) const;
};

// Returns what a pass of any replicate needs of a scene; the rest is 0.
[[nodiscard]] shared::PassBlock block_of(const IndirectScene& scene);
// Returns the coefficients of all faces (RoundsOrder::faces).
[[nodiscard]] std::vector<std::uint64_t> coefficients_of(const Scattering& scattering);
// Returns what a device must know of the elements besides their corners. [element]
[[nodiscard]] std::vector<shared::RoundElement> round_elements(const IndirectScene& scene);

// Returns where the corners of elements are in the arrays of corner_arrays(), one after the other; nothing without copies of meshes.
[[nodiscard]] std::vector<shared::ElementRun> element_runs(const ElementCorners& corners);
// Returns the corners that elements have of their own, then those of each mesh.
[[nodiscard]] std::vector<std::span<const Triangle>> corner_arrays(const ElementCorners& corners);

}  // namespace sunfleck
