#pragma once
// Divides a picture into squares of pixels, whose rays have much in common.

#include "base/rounding.h"
#include "devices/tracers/bundle_walk.h"
#include "shared/view_layout.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace sunfleck {

// Divides rows of a picture into blocks of neighbouring pixels whose samples make one bundle, or more where a pixel alone has
// more.
class PixelBlocks {
 public:
  PixelBlocks(const shared::ViewBlock& view, std::uint32_t rows)
      : picture_columns_(view.width), picture_rows_(rows), samples_(view.samples) {
    while (samples_in_block() > rays_per_bundle && columns_ * rows_ > 1) (rows_ < columns_ ? columns_ : rows_) /= 2;
    across_ = block_count(picture_columns_, columns_);
  }

  [[nodiscard]] std::uint32_t count() const { return across_ * block_count(picture_rows_, rows_); }
  [[nodiscard]] std::uint32_t samples_in_block() const { return columns_ * rows_ * samples_; }

  // Calls visit(numbers of samples) for each bundle of a block.
  template <class Visit>
  void for_bundles(std::uint32_t block, const Visit& visit) const {
    std::array<std::uint32_t, rays_per_bundle> numbers;
    std::size_t count = 0;
    const std::uint32_t column = block % across_ * columns_;
    const std::uint32_t row = block / across_ * rows_;
    for (std::uint32_t r = row; r < std::min(row + rows_, picture_rows_); ++r) {
      const std::uint32_t first = (r * picture_columns_ + column) * samples_;
      const std::uint32_t end = first + std::min(columns_, picture_columns_ - column) * samples_;
      for (std::uint32_t number = first; number < end; ++number) {
        numbers[count++] = number;
        if (count == numbers.size()) visit(std::span<const std::uint32_t>(numbers));
        count %= numbers.size();
      }
    }
    if (count > 0) visit(std::span<const std::uint32_t>(numbers).first(count));
  }

 private:
  std::uint32_t picture_columns_, picture_rows_, samples_;
  std::uint32_t columns_ = 4, rows_ = 4;  // of a block
  std::uint32_t across_ = 0;              // blocks side by side
};

}  // namespace sunfleck
