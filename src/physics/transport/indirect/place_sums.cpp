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

PlaceSums::PlaceSums(std::size_t places, std::size_t width) : PlaceSums(places, width, Extent(), PlaceMemory()) {}

PlaceSums::PlaceSums(std::size_t places, std::size_t width, const Extent& like, const PlaceMemory& memory)
    : places_(places), width_(width), form_(width < least_indexed_width ? Form::list : Form::indexed) {
  if (form_ == Form::indexed) {
    rows_ = RowBlocks(width, places, memory.rows);
  } else if (like.all || like.entries > most_entries_of_list()) {
    form_ = Form::all;
    all_ = memory.all != nullptr ? memory.all->zeros(size()) : std::vector<std::int64_t>(size());
  }
}

std::size_t PlaceSums::bytes() const {
  return (at_.capacity() + row_at_.capacity()) * sizeof(std::uint32_t) + rows_.bytes() +
         (entries_.capacity() + all_.capacity()) * sizeof(std::int64_t);
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
    case Form::indexed:
      if (row_at_.empty()) row_at_.resize(places_);
      if (!has(place)) append_row(place);
      return columns::add(values, &rows_[row_at_[place] - 1][first]);
    case Form::all:
      return columns::add(values, &all_[place * width_]);
  }
}

void PlaceSums::append_row(std::size_t place) {
  rows_.append();
  row_at_[place] = static_cast<std::uint32_t>(rows_.size());
}

void PlaceSums::append_rows_of(const PlaceSums& other) {
  EXPECT(other.row_at_.size(), ==, row_at_.size());
  EXPECT(other.width_, ==, width_);
  for (std::size_t place = 0; place < places_; ++place) {
    if (other.has(place) && !has(place)) append_row(place);
  }
}

void PlaceSums::append(std::size_t place, std::span<const std::int64_t> values) {
  at_.push_back(static_cast<std::uint32_t>(place));
  entries_.insert(entries_.end(), values.begin(), values.end());
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

void PlaceSums::give_back(SpareVectors<std::int64_t>& spare) {
  PlaceSums taken = std::exchange(*this, PlaceSums());
  if (taken.form_ == Form::all) spare.give_back(std::move(taken.all_));
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
  std::vector<std::int64_t> sums;
  if (form_ == Form::list) {
    sums.resize(size());
    for_each([&](std::size_t place, std::span<const std::int64_t> values) { columns::add(values, &sums[place * width_]); });
    return sums;
  }
  // Each number of a wide array is written once.
  sums.reserve(size());
  for_each([&](std::size_t place, std::span<const std::int64_t> values) {
    sums.resize(place * width_);
    sums.insert(sums.end(), values.begin(), values.end());
  });
  sums.resize(size());
  return sums;
}

std::vector<std::int64_t> PlaceSums::take_all() {
  PlaceSums taken = std::exchange(*this, PlaceSums());
  taken.keep_all();
  return std::move(taken.all_);
}

void PlaceSums::put_in_order() {
  if (form_ == Form::list) *this = merged();
}

std::size_t PlaceSums::step_of(std::size_t place) const {
  if (form_ == Form::list) return static_cast<std::size_t>(std::lower_bound(at_.begin(), at_.end(), place) - at_.begin());
  return form_ == Form::indexed && row_at_.empty() ? 0 : place;
}

PlaceSums PlaceSums::merged() const {
  std::vector<std::uint32_t> order(at_.size());
  std::iota(order.begin(), order.end(), 0U);
  tbb::parallel_sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) { return at_[a] < at_[b]; });
  PlaceSums list(places_, width_);
  for (const std::uint32_t entry : order) {
    if (list.at_.empty() || list.at_.back() != at_[entry]) {
      list.at_.push_back(at_[entry]);
      list.entries_.resize(list.entries_.size() + width_);
    }
    columns::add(part(entries_, entry), &list.entries_[list.entries_.size() - width_]);
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
  *this = merged();
  if (at_.size() > most / 2) keep_all();
}

void PlaceSums::keep_all() {
  if (form_ == Form::list) {
    all_ = all();
    at_ = std::vector<std::uint32_t>();
    entries_ = LargeVector<std::int64_t>();
  } else if (form_ == Form::indexed) {
    spread_rows();
  }
  form_ = Form::all;
}

// Copies rows to where all sums stand. Each block of rows is freed when its rows are copied, so that hardly more memory is taken
// than for all sums.
void PlaceSums::spread_rows() {
  std::vector<std::uint32_t> place_of_row(rows_.size());
  for (std::size_t place = 0; place < row_at_.size(); ++place) {
    if (has(place)) place_of_row[row_at_[place] - 1] = static_cast<std::uint32_t>(place);
  }
  row_at_ = std::vector<std::uint32_t>();
  all_.reserve(size());
  prefer_large_pages(all_.data(), size() * sizeof(std::int64_t));
  all_.resize(size());
  rows_.drain([&](std::size_t row, std::span<const std::int64_t> values) {
    std::copy(values.begin(), values.end(), &all_[place_of_row[row] * width_]);
  });
}

PlaceSums::Finder::Finder(const PlaceSums& sums) : sums_(sums) {
  if (sums.form_ != Form::list) return;
  PlaceSums ordered = sums.merged();
  at_ = std::move(ordered.at_);
  entries_ = std::move(ordered.entries_);
}

std::span<const std::int64_t> PlaceSums::Finder::at(std::size_t place) const {
  if (sums_.form_ == Form::list) {
    const auto found = std::lower_bound(at_.begin(), at_.end(), place);
    if (found == at_.end() || *found != place) return {};
    return sums_.part(entries_, static_cast<std::size_t>(found - at_.begin()));
  }
  if (sums_.form_ == Form::indexed && (sums_.row_at_.empty() || !sums_.has(place))) return {};
  return sums_.values_at(place);
}

}  // namespace sunfleck
