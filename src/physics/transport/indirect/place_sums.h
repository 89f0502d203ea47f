#pragma once
// Integer sums for very many places, of which only a few may be reached: in a stand of ten million triangles most sides meet none
// of a replicate's packets.

#include "base/large_pages.h"
#include "base/prefetch.h"
#include "base/row_blocks.h"
#include "base/spare_vectors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace sunfleck {

// Memory of sums by side of a triangle, and by cell of the soil's map.
struct PlaceBytes {
  [[nodiscard]] double all() const { return sides + cells; }
  [[nodiscard]] PlaceBytes times(double factor) const { return {factor * sides, factor * cells}; }

  double sides = 0.0, cells = 0.0;
};

// Where sums get memory that others have given back; both may be null.
struct PlaceMemory {
  std::shared_ptr<SpareBlocks> rows;
  SpareVectors<std::int64_t>* all = nullptr;
};

// Narrow sums keep what was added as a list while that takes at most a quarter of the memory of all sums, and all sums from
// then on. Wide ones, of many columns, keep a row for each place that was reached, with an index of them. The sums are the same
// in each form.
class PlaceSums {
 public:
  // The least width of wide sums.
  static constexpr std::size_t least_indexed_width = 8;

  PlaceSums() = default;  // no place

  // Holds `width` sums, all 0, for each of `places` places. There are fewer than 2^32 places.
  PlaceSums(std::size_t places, std::size_t width);

  // How much sums hold: all of them, or rows or entries in another form.
  struct Extent {
    bool all = false;
    std::size_t entries = 0;
  };
  // Does the same, ready for as much as other sums of the same width held in the end. Rows return to where they come from.
  PlaceSums(std::size_t places, std::size_t width, const Extent& like, const PlaceMemory& memory);
  [[nodiscard]] Extent extent() const { return {form_ == Form::all, form_ == Form::list ? at_.size() : rows_.size()}; }

  // Returns the number of sums, places times width.
  [[nodiscard]] std::size_t size() const { return places_ * width_; }

  // Returns the memory taken, in bytes.
  [[nodiscard]] std::size_t bytes() const;

  // Returns the memory of sums that would take `list_bytes` as a list, or `all_bytes` if all are kept.
  [[nodiscard]] static PlaceBytes likely_bytes(const PlaceBytes& list_bytes, const PlaceBytes& all_bytes);

  // Adds `values` to the sums of the place, one for each from number `first` on. Narrow sums take all of them.
  void add(std::size_t place, std::span<const std::int64_t> values, std::size_t first = 0);

  // Asks for the memory of the sums of a place.
  void prefetch(std::size_t place) const {
    if (form_ == Form::all) {
      sunfleck::prefetch(all_[place * width_]);
    } else if (has_rows() && has(place)) {
      prefetch_row(values_at(place));
    }
  }

  // Adds the sums of `other`, which has as many, or none.
  void add(const PlaceSums& other);

  // Returns whether sums have rows. Several threads may then add to different places at a time, if these have rows.
  [[nodiscard]] bool has_rows() const { return form_ == Form::indexed && !row_at_.empty(); }
  // Gives a row to each place that has one in `other`, which has as many sums. Both have rows.
  void append_rows_of(const PlaceSums& other);

  // Gives the memory of all sums back, if there is any, and leaves no place behind.
  void give_back(SpareVectors<std::int64_t>& spare);

  // Adds all sums of a device, [place * width + k].
  void add_all(std::span<const std::int64_t> sums);

  // Return all sums, [place * width + k]; `take_all` leaves no place behind.
  [[nodiscard]] std::vector<std::int64_t> all() const;
  [[nodiscard]] std::vector<std::int64_t> take_all();

  // Calls take(place, values), whose values add up to the sums: of a list once or several times for a place in any order, else
  // once in ascending order, and perhaps not at all for one whose sums are 0.
  template <class Take>
  void for_each(const Take& take) const {
    for_each(take, [](std::size_t) {});
  }
  // Does the same, and first calls come(place) for each place, in the same order but some steps ahead, so that memory can be
  // asked for.
  template <class Take, class Come>
  void for_each(const Take& take, const Come& come) const {
    take_steps(0, form_ == Form::list ? at_.size() : step_of(places_), take, come);
  }
  // Does the same with the places from one number to another, each once in ascending order; a list must be in order.
  template <class Take, class Come>
  void for_each(std::size_t first, std::size_t end, const Take& take, const Come& come) const {
    take_steps(step_of(first), step_of(end), take, come);
  }

  // Brings a list into order: one entry for each place, in ascending order, however its values were added.
  void put_in_order();

  [[nodiscard]] std::size_t places() const { return places_; }

  // Finds the sums of single places, as they are when it is made. The sums must outlive it and not change meanwhile.
  class Finder {
   public:
    explicit Finder(const PlaceSums& sums);

    // Returns the sums of a place; empty if there are none, or perhaps if all are 0.
    [[nodiscard]] std::span<const std::int64_t> at(std::size_t place) const;

    // Asks for the memory of the sums of a place.
    void prefetch(std::size_t place) const { sums_.prefetch(place); }

   private:
    const PlaceSums& sums_;
    std::vector<std::uint32_t> at_;  // a list's places in ascending order, and their sums
    LargeVector<std::int64_t> entries_;
  };

  // Passes all sums to `archive` in their order, one by one; those of a const object are written, others are filled.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    if constexpr (std::is_const_v<Self>) {
      self.form_ == Form::list ? write(self.merged(), archive) : write(self, archive);
    } else {
      std::vector<std::int64_t> values(self.width_);
      self = PlaceSums(self.places_, self.width_);
      for (std::size_t place = 0; place < self.places_; ++place) {
        bool any = false;
        for (std::int64_t& value : values) {
          archive(value);
          any = any || value != 0;
        }
        if (any) self.add(place, values);
      }
    }
  }

 private:
  enum class Form { list, indexed, all };

  // Passes sums to `archive` whose places for_each takes once in ascending order.
  template <class Archive>
  static void write(const PlaceSums& sums, Archive& archive) {
    std::size_t passed = 0;
    const auto pass_zeros_up_to = [&](std::size_t end) {
      std::int64_t none = 0;
      for (; passed < end; ++passed) archive(none);
    };
    sums.for_each([&](std::size_t place, std::span<const std::int64_t> values) {
      pass_zeros_up_to(place * sums.width_);
      for (std::int64_t value : values) archive(value);
      passed += sums.width_;
    });
    pass_zeros_up_to(sums.size());
  }

  // for_each takes the entries of a list or the places of the other forms in turn, each in a step.
  template <class Take, class Come>
  void take_steps(std::size_t first, std::size_t end, const Take& take, const Come& come) const {
    for (std::size_t step = first; step < end; ++step) {
      if (const std::size_t ahead = step + prefetch_ahead; form_ != Form::all && ahead < end && has(ahead)) {
        come(place_of(ahead));
        prefetch_row(values_at(ahead));
      }
      if (!has(step)) continue;
      const std::span<const std::int64_t> values = values_at(step);
      if (std::all_of(values.begin(), values.end(), [](std::int64_t value) { return value == 0; })) continue;
      take(place_of(step), values);
    }
  }
  // Returns the first step of the places from a number on.
  [[nodiscard]] std::size_t step_of(std::size_t place) const;
  // Return whether there is anything at a step, its place, and its values.
  [[nodiscard]] bool has(std::size_t step) const { return form_ != Form::indexed || row_at_[step] != 0; }
  [[nodiscard]] std::size_t place_of(std::size_t step) const { return form_ == Form::list ? at_[step] : step; }
  [[nodiscard]] std::span<const std::int64_t> values_at(std::size_t step) const {
    if (form_ == Form::indexed) return rows_[row_at_[step] - 1];
    return form_ == Form::list ? part(entries_, step) : part(all_, step);
  }
  template <class Values>
  [[nodiscard]] std::span<const std::int64_t> part(const Values& values, std::size_t number) const {
    return std::span(values).subspan(number * width_, width_);
  }

  void append(std::size_t place, std::span<const std::int64_t> values);
  void append_row(std::size_t place);
  [[nodiscard]] PlaceSums merged() const;  // a list of ascending places
  void keep_list_within_limit();
  void keep_all();
  void spread_rows();
  [[nodiscard]] std::size_t most_entries_of_list() const;

  std::size_t places_ = 0, width_ = 0;
  Form form_ = Form::list;
  std::vector<std::uint32_t> at_;      // [entry of the list], place
  LargeVector<std::int64_t> entries_;  // [entry * width + k]
  RowBlocks rows_;                     // [row][k], in the indexed form
  std::vector<std::uint32_t> row_at_;  // [place], number of its row from 1, or 0; empty before the first row
  std::vector<std::int64_t> all_;      // [place * width + k], in the form of all sums
};

}  // namespace sunfleck
