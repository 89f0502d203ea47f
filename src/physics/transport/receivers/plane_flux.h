#pragma once
// The flux of packets through a stack of horizontal planes: those of the layers, or the receivers.

#include "physics/transport/model/columns.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sunfleck {

// The planes cut space into places, numbered from the bottom: place 0 lies below the lowest plane, place k above k planes.
// Packets carry quanta of several columns; rows of places hold all of them.
class PlaneFlux {
 public:
  PlaneFlux(std::size_t planes, std::size_t columns)
      : columns_(columns),
        down_((planes + 1) * columns),
        up_(down_),
        waiting_(down_),
        taken_(down_),
        lowest_(columns),
        moved_(down_) {}

  // Adds the quanta that a straight path carries from one place to another, in the columns from `first` on.
  void pass(std::size_t from, std::size_t to, std::span<const std::int64_t> quanta, std::size_t first = 0);

  // Return the sums of what waits at a place, and of what packets take along from there, to add to. [column]
  [[nodiscard]] std::int64_t* waiting(std::size_t place) { return &waiting_[place * columns_]; }
  [[nodiscard]] std::int64_t* taken_from(std::size_t place) { return &taken_[place * columns_]; }

  // Returns what waits at all places. [column]
  [[nodiscard]] std::vector<std::int64_t> all_waiting() const { return sum_of(waiting_); }
  // Returns the same and sets it to 0 everywhere: from now on it is missing at its places in the sums of what moves.
  std::vector<std::int64_t> count_waiting();
  // Returns what packets have taken along, [column], and sets it to 0: from now on it counts in the sums of what moves.
  std::vector<std::int64_t> count_taken() { return count(taken_, 1); }
  // Sets what waits of a column to 0, and returns it: it stays where it is.
  std::int64_t drop_waiting(std::size_t column);
  // Continue with rounds that a device made: it was given what waits at all places and set it to these quanta, and the others
  // are added. All are [place * columns + column].
  [[nodiscard]] const std::vector<std::int64_t>& waiting_everywhere() const { return waiting_; }
  void add_rounds(std::span<const std::uint64_t> waiting, std::span<const std::uint64_t> down,
                  std::span<const std::uint64_t> up, std::span<const std::uint64_t> moved);
  // Lets quanta that no packet took along wait at the lowest place where any of the column waited before count_waiting: that
  // crosses no plane below which there was none, and no other planes among the receivers than among the layers.
  void keep(std::size_t column, std::int64_t quanta);

  // Completes the flux through the planes. Sampling moves flux between places: flux that waits at one is shot from another,
  // with a mean of zero. To keep the books of the planes in between exact to the quantum, half of the net flux moved through
  // a plane is added to its downward flux and half is subtracted from its upward flux. At the ground all of it is subtracted
  // from the upward flux, because the downward flux there is what lands on the soil.
  void close(const std::function<bool(std::size_t plane)>& at_ground);

  // The flux through the planes once they are closed. [plane * columns + column]
  [[nodiscard]] const std::vector<std::int64_t>& down() const { return down_; }
  [[nodiscard]] const std::vector<std::int64_t>& up() const { return up_; }

 private:
  [[nodiscard]] std::vector<std::int64_t> sum_of(const std::vector<std::int64_t>& places) const;
  std::vector<std::int64_t> count(std::vector<std::int64_t>& places, std::int64_t sign);

  std::size_t columns_;
  std::vector<std::int64_t> down_, up_;        // [place * columns + column]; before close() the differences to the plane below
  std::vector<std::int64_t> waiting_, taken_;  // [place * columns + column]
  std::vector<std::size_t> lowest_;            // [column], index into waiting_
  std::vector<std::int64_t> moved_;            // [place * columns + column], what was shot from a place, less what waited there
};

}  // namespace sunfleck
