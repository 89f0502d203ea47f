#pragma once
// Rows of integers in blocks of memory: rows that are appended move no others, and the memory of rows that are no longer needed
// serves for the next ones without a visit to the system, which would clear it first.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace sunfleck {

// Keeps the blocks that were given back for those who ask next. Several threads may use it.
class SpareBlocks {
 public:
  SpareBlocks() = default;
  SpareBlocks(const SpareBlocks&) = delete;
  SpareBlocks& operator=(const SpareBlocks&) = delete;
  ~SpareBlocks() { close(); }

  // Returns a block with any content that was given back with as many bytes, or null.
  [[nodiscard]] void* take(std::size_t bytes);

  // Keeps a block of malloc or aligned_alloc, of 16 bytes at least.
  void give_back(void* block, std::size_t bytes);

  // Returns the blocks to the system, and from now on those that are given back as well.
  void close();

 private:
  // Stands at the beginning of a block that was given back, so that giving back never fails.
  struct Spare {
    Spare* next;
    std::size_t bytes;
  };
  std::mutex mutex_;
  Spare* first_ = nullptr;
  bool closed_ = false;
};

// Rows of equal width. A copy has blocks of its own.
class RowBlocks {
 public:
  RowBlocks() = default;  // no rows

  // Will hold at most `most` rows, in blocks of a sixteenth of their memory or of a few large pages. `spare` may be null.
  RowBlocks(std::size_t width, std::size_t most, std::shared_ptr<SpareBlocks> spare);

  RowBlocks(const RowBlocks& other);
  RowBlocks(RowBlocks&& other) noexcept;  // leaves no rows behind
  RowBlocks& operator=(RowBlocks other) noexcept;
  ~RowBlocks() = default;

  // Appends a row of zeros and returns it.
  std::span<std::int64_t> append();

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<std::int64_t> operator[](std::size_t row) { return {at(row), width_}; }
  [[nodiscard]] std::span<const std::int64_t> operator[](std::size_t row) const { return {at(row), width_}; }

  // Calls take(row, values) for each row in their order, and returns each block to the system as soon as its rows were taken.
  // Leaves no rows behind.
  template <class Take>
  void drain(const Take& take) {
    for (std::size_t row = 0; row < size_; ++row) {
      take(row, std::span<const std::int64_t>((*this)[row]));
      if ((row + 1) % rows_each_ == 0) std::free(blocks_[row / rows_each_].release());
    }
    size_ = 0;
    blocks_.clear();
  }

  // Returns the memory of the rows; their last block may take a little more.
  [[nodiscard]] std::size_t bytes() const { return size_ * width_ * sizeof(std::int64_t); }

 private:
  struct GiveBack {
    std::shared_ptr<SpareBlocks> spare;
    std::size_t bytes = 0;
    void operator()(std::int64_t* block) const;
  };
  using Block = std::unique_ptr<std::int64_t, GiveBack>;

  [[nodiscard]] std::int64_t* at(std::size_t row) const {
    const auto number = static_cast<std::uint32_t>(row);  // divides in a third of the time
    return blocks_[number / rows_each_].get() + number % rows_each_ * width_;
  }
  std::span<std::int64_t> append_any();

  std::size_t width_ = 0, size_ = 0;
  std::size_t block_bytes_ = 0;
  std::uint32_t rows_each_ = 1;  // in a block
  std::shared_ptr<SpareBlocks> spare_;
  std::vector<Block> blocks_;
};

}  // namespace sunfleck
