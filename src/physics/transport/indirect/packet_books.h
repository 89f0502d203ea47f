#pragma once
// The books of an indirect pass: where quanta landed, what surfaces absorbed, what passed the planes, and what waits where.

#include "physics/transport/indirect/arrivals.h"
#include "physics/transport/indirect/device_rounds.h"
#include "physics/transport/indirect/indirect_scene.h"
#include "physics/transport/indirect/replicate.h"
#include "physics/transport/indirect/scattering.h"
#include "physics/transport/indirect/waiting_flux.h"
#include "physics/transport/receivers/plane_flux.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// The sums of one pass, and the flux that waits at each level and between the receivers. What waits there and what packets take
// along is counted apart from the landings, so that no flux is created where drawing moves it.
class PacketBooks {
 public:
  // The scene must outlive the books.
  PacketBooks(const IndirectScene& scene, bool counts_hits);

  // Only these columns are booked from now on; rows of quanta hold them and no others.
  void book_only(ColumnRange columns) { booked_ = columns; }
  [[nodiscard]] ColumnRange booked() const { return booked_; }

  // Books what rays and packets carry from where it waited to their ends, and adds to `next` what then waits there. The threads
  // of the run share the work.
  void book(const ArrivalBatch& batch, WaitingFlux& next);

  // Adds quanta that wait at a place although they did not land there.
  void add_waiting(std::size_t level_index, std::size_t column, std::int64_t quanta) {
    layers_.waiting(level_index)[column] += quanta;
  }
  void add_waiting_in_zone(std::size_t zone, std::size_t column, std::int64_t quanta) {
    receivers_.waiting(zone)[column] += quanta;
  }

  // Return what a device is given of the books for rounds of its own (RoundsOrder::totals), and complete them with what it found.
  [[nodiscard]] std::vector<std::uint64_t> for_rounds(const shared::PassBlock& block) const;
  void add_rounds(const shared::PassBlock& block, const RoundsSums& found);

  // Returns what waits. [column]
  [[nodiscard]] std::vector<std::int64_t> waiting() const { return layers_.all_waiting(); }
  // Ends a column: what waits of it stays where it is, and counts as unshot.
  void retire(std::size_t column);
  // Takes the waiting flux off its places, before packets leave with it.
  void begin_round();
  // Leaves waiting what no packet of the round took along.
  void end_round();

  [[nodiscard]] const Scattering& scattering() const { return scattering_; }
  [[nodiscard]] IndirectSums& sums() { return sums_; }
  [[nodiscard]] const IndirectSums& sums() const { return sums_; }
  // Completes the sums.
  void close();

 private:
  // The parts of book(). No two of them change the same sums.
  void book_sides(const ArrivalBatch& batch);
  void book_surfaces(const ArrivalBatch& batch);
  void book_layers(const ArrivalBatch& batch);
  void book_receivers(const ArrivalBatch& batch);
  void scatter(const ArrivalBatch& batch, WaitingFlux& next);

  [[nodiscard]] std::span<const std::int64_t> quanta_of(const ArrivalBatch& batch, std::size_t ray) const {
    return batch.quanta.subspan(ray * booked_.count, booked_.count);
  }
  void end(const Arrival& arrival, std::span<const std::int64_t> quanta);
  void add_to(std::vector<std::int64_t>& sums, std::size_t place, std::span<const std::int64_t> quanta) const;

  const IndirectScene& scene_;
  std::size_t columns_;
  ColumnRange booked_;
  IndirectSums sums_;
  Scattering scattering_;
  PlaneFlux layers_, receivers_;         // through the planes of the layers, and the horizontal receivers
  std::vector<std::int64_t> waited_;     // [column], what waited when the round began
  std::vector<std::int64_t> scattered_;  // [column], of the current landing
};

}  // namespace sunfleck
