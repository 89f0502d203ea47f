#include "physics/transport/indirect/place_sums.h"

#include "base/check.h"
#include "physics/transport/model/columns.h"

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace sunfleck {
namespace {

// A list takes at most this part of the memory of all sums. Its vectors may have reserved twice as much as they hold.
constexpr std::size_t list_part = 4;

}  // namespace

PlaceSums::PlaceSums(std::size_t places, std::size_t width, const Extent& like) : PlaceSums(places, width) {
  if (form_ == Form::indexed) {
    at_.reserve(like.entries);
    rows_.reserve(like.entries * width_);
  } else if (like.all || like.entries > most_entries_of_list()) {
    form_ = Form::all;
    all_.resize(size());
  }
}

std::size_t PlaceSums::bytes() const {
  return (at_.capacity() + entry_at_.capacity()) * sizeof(std::uint32_t) +
         (rows_.capacity() + all_.capacity()) * sizeof(std::int64_t);
}

PlaceBytes PlaceSums::likely_bytes(const PlaceBytes& list_bytes, const PlaceBytes& all_bytes) {
  const auto likely = [](double list, double all) { return list > all / list_part ? all : list; };
  return {likely(list_bytes.sides, all_bytes.sides), likely(list_bytes.cells, all_bytes.cells)};
}

void PlaceSums::add(std::size_t place, std::span<const std::int64_t> values, std::size_t first) {
  DCHECK(place, <, places_);
  DCHECK(first + values.size(), <=, width_);
  DCHECK(form_ == Form::indexed || values.size() == width_, ==, true);
  switch (form_) {
    case Form::list:
      append(place, values);
      return keep_list_within_limit();
    case Form::indexed: {
      if (entry_at_.empty()) entry_at_.resize(places_);
      std::uint32_t& entry = entry_at_[place];
      if (entry == 0) {
        append_row(place);
        entry = static_cast<std::uint32_t>(at_.size());
      }
      return columns::add(values, &rows_[(entry - 1) * width_ + first]);
    }
    case Form::all:
      return columns::add(values, &all_[place * width_]);
  }
}

// Appends a row of zeros. Grows as vectors do, but never beyond what all places need.
void PlaceSums::append_row(std::size_t place) {
  if (rows_.size() == rows_.capacity()) {
    constexpr std::size_t first_entries = 64;
    rows_.reserve(std::min(size(), std::max(2 * rows_.size(), first_entries * width_)));
  }
  at_.push_back(static_cast<std::uint32_t>(place));
  rows_.resize(rows_.size() + width_);
}

void PlaceSums::append(std::size_t place, std::span<const std::int64_t> values) {
  at_.push_back(static_cast<std::uint32_t>(place));
  rows_.insert(rows_.end(), values.begin(), values.end());
}

void PlaceSums::add(const PlaceSums& other) {
  if (other.size() == 0) return;
  if (size() == 0) {
    *this = other;
    return;
  }
  EXPECT(other.places_, ==, places_);
  EXPECT(other.width_, ==, width_);
  if (other.form_ != Form::all) {
    other.for_each([this](std::size_t place, std::span<const std::int64_t> values) { add(place, values); },
                   [this](std::size_t place) { prefetch(place); });
  } else if (form_ == Form::list) {
    PlaceSums sum = other;
    sum.add(*this);
    *this = std::move(sum);
  } else {
    columns::add(other.all_, all_.data());
  }
}

void PlaceSums::add_all(std::span<const std::int64_t> sums) {
  EXPECT(sums.size(), ==, size());
  if (form_ == Form::all) return columns::add(sums, all_.data());
  for (std::size_t place = 0; place < places_; ++place) {
    const std::span<const std::int64_t> values = sums.subspan(place * width_, width_);
    if (std::any_of(values.begin(), values.end(), [](std::int64_t value) { return value != 0; })) add(place, values);
  }
}

std::vector<std::int64_t> PlaceSums::all() const {
  if (form_ == Form::all) return all_;
  std::vector<std::int64_t> sums(size());
  for (std::size_t k = 0; k < at_.size(); ++k) columns::add(row(rows_, k), &sums[at_[k] * width_]);
  return sums;
}

std::vector<std::int64_t> PlaceSums::take_all() {
  PlaceSums taken = std::exchange(*this, PlaceSums());
  return taken.form_ == Form::all ? std::move(taken.all_) : taken.all();
}

void PlaceSums::put_in_order() {
  if (form_ == Form::list) *this = merged();
}

std::size_t PlaceSums::step_of(std::size_t place) const {
  if (form_ == Form::list) return static_cast<std::size_t>(std::lower_bound(at_.begin(), at_.end(), place) - at_.begin());
  return form_ == Form::indexed && at_.empty() ? 0 : place;
}

PlaceSums PlaceSums::merged() const {
  std::vector<std::uint32_t> order(at_.size());
  std::iota(order.begin(), order.end(), 0U);
  tbb::parallel_sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) { return at_[a] < at_[b]; });
  PlaceSums list(places_, width_);
  for (const std::uint32_t entry : order) {
    if (list.at_.empty() || list.at_.back() != at_[entry]) {
      list.at_.push_back(at_[entry]);
      list.rows_.resize(list.rows_.size() + width_);
    }
    columns::add(row(rows_, entry), &list.rows_[list.rows_.size() - width_]);
  }
  return list;
}

std::size_t PlaceSums::most_entries_of_list() const {
  const std::size_t entry_bytes = sizeof(std::uint32_t) + width_ * sizeof(std::int64_t);
  return size() * sizeof(std::int64_t) / list_part / entry_bytes;
}

// Several entries of one place become one before the list is given up.
void PlaceSums::keep_list_within_limit() {
  const std::size_t most = most_entries_of_list();
  if (at_.size() <= most) return;
  PlaceSums list = merged();
  if (list.at_.size() <= most / 2) {
    *this = std::move(list);
    return;
  }
  all_ = list.all();
  at_ = std::vector<std::uint32_t>();
  rows_ = LargeVector<std::int64_t>();
  form_ = Form::all;
}

PlaceSums::Finder::Finder(const PlaceSums& sums) : sums_(sums) {
  if (sums.form_ != Form::list) return;
  PlaceSums ordered = sums.merged();
  at_ = std::move(ordered.at_);
  rows_ = std::move(ordered.rows_);
}

std::span<const std::int64_t> PlaceSums::Finder::at(std::size_t place) const {
  if (sums_.form_ == Form::all) return sums_.row(sums_.all_, place);
  if (sums_.form_ == Form::indexed) {
    if (sums_.entry_at_.empty() || sums_.entry_at_[place] == 0) return {};
    return sums_.row(sums_.rows_, sums_.entry_at_[place] - 1);
  }
  const auto found = std::lower_bound(at_.begin(), at_.end(), place);
  if (found == at_.end() || *found != place) return {};
  return sums_.row(rows_, static_cast<std::size_t>(found - at_.begin()));
}

}  // namespace sunfleck
