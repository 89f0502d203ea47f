#include "physics/transport/indirect/place_sums.h"

#include "base/check.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sunfleck {
namespace {

// A list takes at most this part of the memory of all sums. Its vectors may have reserved twice as much as they hold.
constexpr std::size_t list_part = 4;

}  // namespace

std::size_t PlaceSums::bytes() const {
  return at_.capacity() * sizeof(std::uint32_t) + values_.capacity() * sizeof(std::int64_t);
}

double PlaceSums::likely_bytes(double list_bytes, double all_bytes) {
  return list_bytes > all_bytes / list_part ? all_bytes : list_bytes;
}

void PlaceSums::add(std::size_t place, std::span<const std::int64_t> values) {
  DCHECK(place, <, places_);
  DCHECK(values.size(), ==, width_);
  if (all_) {
    for (std::size_t k = 0; k < width_; ++k) values_[place * width_ + k] += values[k];
    return;
  }
  at_.push_back(static_cast<std::uint32_t>(place));
  values_.insert(values_.end(), values.begin(), values.end());
  keep_within_limit();
}

void PlaceSums::add(const PlaceSums& other) {
  if (other.size() == 0) return;
  if (size() == 0) {
    *this = other;
    return;
  }
  EXPECT(other.places_, ==, places_);
  EXPECT(other.width_, ==, width_);
  if (other.is_list()) {
    other.for_each([this](std::size_t place, std::span<const std::int64_t> values) { add(place, values); },
                   [this](std::size_t place) { prefetch(place); });
  } else if (is_list()) {
    PlaceSums sum = other;
    sum.add(*this);
    *this = std::move(sum);
  } else {
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k] += other.values_[k];
  }
}

std::vector<std::int64_t> PlaceSums::all() const {
  if (all_) return values_;
  std::vector<std::int64_t> sums(size());
  for (std::size_t k = 0; k < at_.size(); ++k) {
    for (std::size_t j = 0; j < width_; ++j) sums[at_[k] * width_ + j] += values_[k * width_ + j];
  }
  return sums;
}

std::vector<std::int64_t> PlaceSums::take_all() {
  PlaceSums taken = std::exchange(*this, PlaceSums());
  return taken.all_ ? std::move(taken.values_) : taken.all();
}

PlaceSums PlaceSums::merged() const {
  std::vector<std::uint32_t> order(at_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) { return at_[a] < at_[b]; });
  PlaceSums list(places_, width_);
  for (const std::uint32_t entry : order) {
    if (list.at_.empty() || list.at_.back() != at_[entry]) {
      list.at_.push_back(at_[entry]);
      list.values_.resize(list.values_.size() + width_);
    }
    for (std::size_t j = 0; j < width_; ++j) list.values_[list.values_.size() - width_ + j] += values_[entry * width_ + j];
  }
  return list;
}

// Several entries of one place become one before the list is given up.
void PlaceSums::keep_within_limit() {
  const std::size_t entry_bytes = sizeof(std::uint32_t) + width_ * sizeof(std::int64_t);
  const std::size_t most = size() * sizeof(std::int64_t) / list_part / entry_bytes;
  if (at_.size() <= most) return;
  PlaceSums list = merged();
  if (list.at_.size() <= most / 2) {
    *this = std::move(list);
    return;
  }
  values_ = list.all();
  at_ = std::vector<std::uint32_t>();
  all_ = true;
}

PlaceSums::Finder::Finder(const PlaceSums& sums) : sums_(sums) {
  if (!sums.is_list()) return;
  PlaceSums ordered = sums.merged();
  at_ = std::move(ordered.at_);
  values_ = std::move(ordered.values_);
}

std::span<const std::int64_t> PlaceSums::Finder::at(std::size_t place) const {
  if (!sums_.is_list()) return {&sums_.values_[place * sums_.width_], sums_.width_};
  const auto found = std::lower_bound(at_.begin(), at_.end(), place);
  if (found == at_.end() || *found != place) return {};
  return {&values_[static_cast<std::size_t>(found - at_.begin()) * sums_.width_], sums_.width_};
}

}  // namespace sunfleck
