#pragma once
// Integer sums for very many places, of which only a few may be reached: in a stand of ten million triangles most sides meet none
// of a replicate's packets.

#include "base/prefetch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace sunfleck {

// Keeps what was added as a list while that takes at most a quarter of the memory of all sums, and all sums from then on. The
// sums are the same either way.
class PlaceSums {
 public:
  PlaceSums() = default;  // no place

  // Holds `width` sums, all 0, for each of `places` places. There are fewer than 2^32 places.
  PlaceSums(std::size_t places, std::size_t width) : places_(places), width_(width) {}

  // Does the same, in the form of all sums if those of `like` have it.
  PlaceSums(std::size_t places, std::size_t width, const PlaceSums& like) : PlaceSums(places, width) {
    if (like.is_list()) return;
    all_ = true;
    values_.resize(size());
  }

  // Returns the number of sums, places times width.
  [[nodiscard]] std::size_t size() const { return places_ * width_; }

  // Returns the memory taken, in bytes.
  [[nodiscard]] std::size_t bytes() const;

  // Returns the memory that sums take which would be a list of `list_bytes`, or all of `all_bytes`.
  [[nodiscard]] static double likely_bytes(double list_bytes, double all_bytes);

  // Adds `values`, one for each sum of the place.
  void add(std::size_t place, std::span<const std::int64_t> values);

  // Adds the sums of `other`, which has as many, or none.
  void add(const PlaceSums& other);

  // Return all sums, [place * width + k]; `take_all` leaves no place behind.
  [[nodiscard]] std::vector<std::int64_t> all() const;
  [[nodiscard]] std::vector<std::int64_t> take_all();

  // Calls take(place, values), whose values add up to the sums: once or several times for a place, in any order, and perhaps not
  // at all for one whose sums are 0.
  template <class Take>
  void for_each(const Take& take) const {
    for_each(take, [](std::size_t) {});
  }
  // Does the same, and first calls come(place) for each place, in the same order but some steps ahead, so that memory can be asked for.
  template <class Take, class Come>
  void for_each(const Take& take, const Come& come) const {
    const std::size_t entries = all_ ? places_ : at_.size();
    for (std::size_t entry = 0; entry < entries; ++entry) {
      if (!all_ && entry + prefetch_ahead < entries) come(at_[entry + prefetch_ahead]);
      const std::span<const std::int64_t> values(&values_[entry * width_], width_);
      if (std::all_of(values.begin(), values.end(), [](std::int64_t value) { return value == 0; })) continue;
      take(all_ ? entry : at_[entry], values);
    }
  }

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
    std::vector<std::int64_t> values_;
  };

  // Passes all sums to `archive` in their order, one by one; those of a const object are written, others are filled.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    if constexpr (std::is_const_v<Self>) {
      const PlaceSums ordered = self.is_list() ? self.merged() : PlaceSums();
      const PlaceSums& sums = self.is_list() ? ordered : self;
      std::size_t entry = 0;
      for (std::size_t place = 0; place < self.places_; ++place) {
        const bool listed = self.is_list() && entry < sums.at_.size() && sums.at_[entry] == place;
        for (std::size_t k = 0; k < self.width_; ++k) {
          std::int64_t value = 0;
          if (!self.is_list()) value = sums.values_[place * self.width_ + k];
          if (listed) value = sums.values_[entry * self.width_ + k];
          archive(value);
        }
        entry += listed ? 1 : 0;
      }
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
  [[nodiscard]] bool is_list() const { return !all_; }
  void prefetch(std::size_t place) const {
    if (all_) sunfleck::prefetch(values_[place * width_]);
  }
  [[nodiscard]] PlaceSums merged() const;  // a list of ascending places
  void keep_within_limit();

  std::size_t places_ = 0, width_ = 0;
  bool all_ = false;                  // the form: all sums, or a list
  std::vector<std::uint32_t> at_;     // [entry], place; empty in the form of all sums
  std::vector<std::int64_t> values_;  // [entry * width + k] or [place * width + k]
};

}  // namespace sunfleck
