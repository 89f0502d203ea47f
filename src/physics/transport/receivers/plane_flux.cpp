#include "physics/transport/receivers/plane_flux.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sunfleck {

void PlaneFlux::pass(std::size_t from, std::size_t to, std::span<const std::int64_t> quanta, std::size_t first) {
  std::vector<std::int64_t>& planes = from > to ? down_ : up_;
  const auto [lowest, end] = std::minmax(from, to);
  columns::add(quanta, &planes[lowest * columns_ + first]);
  columns::subtract(quanta, &planes[end * columns_ + first]);
}

std::int64_t PlaneFlux::drop_waiting(std::size_t column) {
  std::int64_t dropped = 0;
  for (std::size_t k = column; k < waiting_.size(); k += columns_) dropped += std::exchange(waiting_[k], 0);
  return dropped;
}

std::vector<std::int64_t> PlaneFlux::count_waiting() {
  std::iota(lowest_.begin(), lowest_.end(), 0);
  for (std::size_t k = waiting_.size(); k-- > 0;) {
    if (waiting_[k] > 0) lowest_[k % columns_] = k;
  }
  return count(waiting_, -1);
}

void PlaneFlux::add_rounds(std::span<const std::uint64_t> waiting, std::span<const std::uint64_t> down,
                           std::span<const std::uint64_t> up, std::span<const std::uint64_t> moved) {
  for (std::size_t k = 0; k < waiting_.size(); ++k) {
    waiting_[k] = static_cast<std::int64_t>(waiting[k]);
    down_[k] += static_cast<std::int64_t>(down[k]);
    up_[k] += static_cast<std::int64_t>(up[k]);
    moved_[k] += static_cast<std::int64_t>(moved[k]);
  }
}

void PlaneFlux::keep(std::size_t column, std::int64_t quanta) {
  waiting_[lowest_[column]] += quanta;
  moved_[lowest_[column]] += quanta;
}

std::vector<std::int64_t> PlaneFlux::sum_of(const std::vector<std::int64_t>& places) const {
  std::vector<std::int64_t> sums(columns_);
  for (std::size_t first = 0; first < places.size(); first += columns_) {
    columns::add(std::span(places).subspan(first, columns_), sums.data());
  }
  return sums;
}

std::vector<std::int64_t> PlaneFlux::count(std::vector<std::int64_t>& places, std::int64_t sign) {
  std::vector<std::int64_t> sums = sum_of(places);
  for (std::size_t k = 0; k < places.size(); ++k) moved_[k] += sign * places[k];
  std::fill(places.begin(), places.end(), 0);
  return sums;
}

void PlaneFlux::close(const std::function<bool(std::size_t plane)>& at_ground) {
  // Turns the differences between neighbouring planes, and between the places, into the flux of each plane.
  for (auto* planes : {&down_, &up_, &moved_}) {
    for (std::size_t k = columns_; k < planes->size(); ++k) (*planes)[k] += (*planes)[k - columns_];
    planes->resize(planes->size() - columns_);
  }
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    const std::int64_t half = at_ground(k / columns_) ? 0 : moved_[k] / 2;
    down_[k] += half;
    up_[k] -= moved_[k] - half;
  }
}

}  // namespace sunfleck
