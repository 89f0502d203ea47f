#include "physics/transport/indirect/waiting_flux.h"

#include "base/in_blocks.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sunfleck {
namespace {

// Numbers the parts to which places belong.
class Parts {
 public:
  static constexpr std::size_t count = shared::place_parts;

  // Orders of elements and numbers of cells are below these.
  Parts(std::uint32_t elements, std::uint32_t cells)
      : of_elements_(parts_each(shared::element_parts, elements)), of_ground_(parts_each(shared::ground_parts, cells)) {}

  [[nodiscard]] std::size_t operator()(const EmissionPoint& place) const {
    if (place.order < ground_order) return shared::place_part(place.order, of_elements_);
    return shared::element_parts + shared::place_part(place.order - ground_order, of_ground_);
  }

 private:
  static std::uint64_t parts_each(std::uint32_t parts, std::uint32_t places) {
    return (std::uint64_t{parts} << 32U) / std::max(1U, places);
  }

  std::uint64_t of_elements_, of_ground_;
};

// Places that are sorted together.
constexpr std::size_t places_per_block = 16384;

using PartCounts = std::array<std::uint32_t, Parts::count>;

// Turns the numbers of places of each block in each part into the numbers of all places before them: those of earlier parts,
// and of earlier blocks in the same part.
void sum_before(std::vector<PartCounts>& blocks) {
  std::uint32_t sum = 0;
  for (std::size_t part = 0; part < Parts::count; ++part) {
    for (PartCounts& block : blocks) sum += std::exchange(block[part], sum);
  }
}

}  // namespace

void WaitingFlux::clear(ColumnRange columns) {
  columns_ = columns;
  places_.clear();
  quanta_.clear();
  row_of_.clear();
  end_of_elements_ = end_of_cells_ = 0;
}

void WaitingFlux::reserve(std::size_t places) {
  places_.reserve(places);
  quanta_.reserve(places * columns_.count);
}

void WaitingFlux::add(const EmissionPoint& place, std::span<const std::int64_t> quanta) {
  if (std::all_of(quanta.begin(), quanta.end(), [](std::int64_t q) { return q == 0; })) return;
  std::uint32_t& end = place.order < ground_order ? end_of_elements_ : end_of_cells_;
  end = std::max(end, (place.order & ~ground_order) + 1);
  places_.push_back(place);
  quanta_.insert(quanta_.end(), quanta.begin(), quanta.end());
}

void WaitingFlux::take_sorted(WaitingFlux& other) {
  // Rows as long as this stay where they are: moving them would cost more than reading them in any order.
  constexpr std::size_t least_left_in_place = 32;
  columns_ = other.columns_;
  const std::size_t width = columns_.count;
  const bool stay = width >= least_left_in_place;
  const Parts part_of(other.end_of_elements_, other.end_of_cells_);
  std::vector<PartCounts> next(block_count(other.size(), places_per_block));
  in_blocks(other.size(), places_per_block, [&](std::size_t block, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) ++next[block][part_of(other.places_[k])];
  });
  sum_before(next);
  places_.resize(other.size());
  row_of_.resize(stay ? other.size() : 0);
  if (!stay) quanta_.resize(other.quanta_.size());
  in_blocks(other.size(), places_per_block, [&](std::size_t block, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
      const std::size_t to = next[block][part_of(other.places_[k])]++;
      places_[to] = other.places_[k];
      if (stay) row_of_[to] = static_cast<std::uint32_t>(k);
      for (std::size_t c = 0; !stay && c < width; ++c) quanta_[to * width + c] = other.quanta_[k * width + c];
    }
  });
  if (stay) std::swap(quanta_, other.quanta_);
}

}  // namespace sunfleck
