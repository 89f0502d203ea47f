#include "physics/transport/receivers/plane_flux.h"

#include <algorithm>

namespace sunfleck {

void PlaneFlux::pass(std::size_t from, std::size_t to, std::span<const std::int64_t> quanta) {
  std::vector<std::int64_t>& planes = from > to ? down_ : up_;
  const auto [first, end] = std::minmax(from, to);
  columns::add(quanta, &planes[first * bands_]);
  columns::subtract(quanta, &planes[end * bands_]);
}

void PlaneFlux::close(const std::function<bool(std::size_t plane)>& at_ground) {
  // Turns the differences between neighbouring planes, and between the places, into the flux of each plane.
  for (auto* planes : {&down_, &up_, &moved_}) {
    for (std::size_t k = bands_; k < planes->size(); ++k) (*planes)[k] += (*planes)[k - bands_];
    planes->resize(planes->size() - bands_);
  }
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    const std::int64_t half = at_ground(k / bands_) ? 0 : moved_[k] / 2;
    down_[k] += half;
    up_[k] -= moved_[k] - half;
  }
}

}  // namespace sunfleck
