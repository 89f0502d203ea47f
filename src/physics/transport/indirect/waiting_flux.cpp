#include "physics/transport/indirect/waiting_flux.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace sunfleck {
namespace {

// Numbers the parts to which places belong.
class Parts {
 public:
  static constexpr std::size_t count = shared::element_parts + shared::ground_parts;

  explicit Parts(std::span<const EmissionPoint> places) {
    std::uint32_t elements = 0, cells = 0;
    for (const EmissionPoint& place : places) {
      std::uint32_t& end = place.order < ground_order ? elements : cells;
      end = std::max(end, (place.order & ~ground_order) + 1);
    }
    of_elements_ = parts_each(shared::element_parts, elements);
    of_ground_ = parts_each(shared::ground_parts, cells);
  }

  [[nodiscard]] std::size_t operator()(const EmissionPoint& place) const {
    if (place.order < ground_order) return shared::place_part(place.order, of_elements_);
    return shared::element_parts + shared::place_part(place.order - ground_order, of_ground_);
  }

 private:
  static std::uint64_t parts_each(std::uint32_t parts, std::uint32_t places) {
    return (std::uint64_t{parts} << 32U) / std::max(1U, places);
  }

  std::uint64_t of_elements_ = 0, of_ground_ = 0;
};

}  // namespace

void WaitingFlux::clear(ColumnRange columns) {
  columns_ = columns;
  places_.clear();
  quanta_.clear();
  row_of_.clear();
}

void WaitingFlux::reserve(std::size_t places) {
  places_.reserve(places);
  quanta_.reserve(places * columns_.count);
}

void WaitingFlux::add(const EmissionPoint& place, std::span<const std::int64_t> quanta) {
  if (std::all_of(quanta.begin(), quanta.end(), [](std::int64_t q) { return q == 0; })) return;
  places_.push_back(place);
  quanta_.insert(quanta_.end(), quanta.begin(), quanta.end());
}

void WaitingFlux::take_sorted(WaitingFlux& other) {
  // Rows as long as this stay where they are: moving them would cost more than reading them in any order.
  constexpr std::size_t least_left_in_place = 32;
  columns_ = other.columns_;
  const std::size_t width = columns_.count;
  const bool stay = width >= least_left_in_place;
  const Parts part_of(other.places_);
  std::array<std::uint32_t, Parts::count + 1> next{};
  for (const EmissionPoint& place : other.places_) ++next[part_of(place) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  places_.resize(other.size());
  row_of_.resize(stay ? other.size() : 0);
  if (!stay) quanta_.resize(other.quanta_.size());
  for (std::size_t k = 0; k < other.size(); ++k) {
    const std::size_t to = next[part_of(other.places_[k])]++;
    places_[to] = other.places_[k];
    if (stay) row_of_[to] = static_cast<std::uint32_t>(k);
    for (std::size_t c = 0; !stay && c < width; ++c) quanta_[to * width + c] = other.quanta_[k * width + c];
  }
  if (stay) std::swap(quanta_, other.quanta_);
}

}  // namespace sunfleck
