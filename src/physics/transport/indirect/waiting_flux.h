#pragma once
// Flux that waits to be shot, at the places where it landed.

#include "base/large_pages.h"
#include "physics/transport/indirect/emission.h"
#include "physics/transport/model/columns.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Places with the quanta that landed there in several columns: the bands of one light or of several
// (physics/transport/model/lights.h).
class WaitingFlux {
 public:
  // Removes all places. Rows that are added hold these columns.
  void clear(ColumnRange columns);
  void reserve(std::size_t places);
  // Adds a place. One without quanta is dropped.
  void add(const EmissionPoint& place, std::span<const std::int64_t> quanta);
  // Replaces these places by those of `other`, part by part (shared::place_part); within a part they keep the order in which
  // they were added. `other` must be cleared before it is used again. The threads of the run share the work.
  void take_sorted(WaitingFlux& other);

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  // Return all places, and their quanta in the order in which both were added.
  [[nodiscard]] std::span<const EmissionPoint> places() const { return places_; }
  [[nodiscard]] std::span<const std::int64_t> rows() const { return quanta_; }
  // Return numbers above the orders of all places on elements, and above all cells on the ground.
  [[nodiscard]] std::uint32_t end_of_elements() const { return end_of_elements_; }
  [[nodiscard]] std::uint32_t end_of_cells() const { return end_of_cells_; }
  [[nodiscard]] const EmissionPoint& place(std::size_t number) const { return places_[number]; }
  // Returns the quanta of a place in some of the columns.
  [[nodiscard]] std::span<const std::int64_t> quanta(std::size_t number, ColumnRange of) const {
    const std::size_t row = row_of_.empty() ? number : row_of_[number];
    return std::span(quanta_).subspan(row * columns_.count + (of.first - columns_.first), of.count);
  }

 private:
  ColumnRange columns_;
  LargeVector<EmissionPoint> places_;  // [place]
  LargeVector<std::int64_t> quanta_;   // [row * columns + column]
  std::vector<std::uint32_t> row_of_;  // [place]; empty if each has the row of its number
  // Added places have orders, and numbers of cells, below these.
  std::uint32_t end_of_elements_ = 0, end_of_cells_ = 0;
};

}  // namespace sunfleck
