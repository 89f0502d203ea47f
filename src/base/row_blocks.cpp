#include "base/row_blocks.h"

#include "base/large_pages.h"

#include <algorithm>
#include <new>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::size_t page_bytes = large_page_bytes;
constexpr std::size_t least_block_bytes = std::size_t{1} << 14U;
constexpr std::size_t blocks_of_all = 16;
// A block takes two mappings of the process, of which systems allow some 65,000.
constexpr std::size_t most_block_bytes = 4 * page_bytes;

void* fetch(std::size_t bytes) {
  if (bytes >= page_bytes) return fetch_large_pages(bytes);
  void* const block = std::malloc(bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

std::size_t bytes_of_block(std::size_t row_bytes, std::size_t most_rows) {
  const std::size_t wanted = std::clamp(row_bytes * most_rows / blocks_of_all, least_block_bytes, most_block_bytes);
  const std::size_t bytes = std::max(wanted, row_bytes);
  return bytes < page_bytes ? bytes : rounded_up(bytes, page_bytes);
}

}  // namespace

void* SpareBlocks::take(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  for (Spare** at = &first_; *at != nullptr; at = &(*at)->next) {
    if ((*at)->bytes == bytes) return std::exchange(*at, (*at)->next);
  }
  return nullptr;
}

void SpareBlocks::give_back(void* block, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (closed_) return std::free(block);
  first_ = new (block) Spare{first_, bytes};
}

void SpareBlocks::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  while (first_ != nullptr) std::free(std::exchange(first_, first_->next));
}

RowBlocks::RowBlocks(std::size_t width, std::size_t most, std::shared_ptr<SpareBlocks> spare)
    : width_(width), block_bytes_(bytes_of_block(width * sizeof(std::int64_t), most)), spare_(std::move(spare)) {
  if (spare_ == nullptr) spare_ = std::make_shared<SpareBlocks>();
  rows_each_ = static_cast<std::uint32_t>(block_bytes_ / (width * sizeof(std::int64_t)));
}

RowBlocks::RowBlocks(const RowBlocks& other)
    : width_(other.width_), block_bytes_(other.block_bytes_), rows_each_(other.rows_each_), spare_(other.spare_) {
  for (std::size_t row = 0; row < other.size(); ++row) {
    const std::span<const std::int64_t> values = other[row];
    std::copy(values.begin(), values.end(), append_any().begin());
  }
}

RowBlocks::RowBlocks(RowBlocks&& other) noexcept
    : width_(other.width_),
      size_(std::exchange(other.size_, 0)),
      block_bytes_(other.block_bytes_),
      rows_each_(other.rows_each_),
      spare_(other.spare_),  // NOLINT(performance-move-constructor-init): the other may be filled again
      blocks_(std::exchange(other.blocks_, {})) {}

RowBlocks& RowBlocks::operator=(RowBlocks other) noexcept {
  std::swap(width_, other.width_);
  std::swap(size_, other.size_);
  std::swap(block_bytes_, other.block_bytes_);
  std::swap(rows_each_, other.rows_each_);
  std::swap(spare_, other.spare_);
  std::swap(blocks_, other.blocks_);
  return *this;
}

std::span<std::int64_t> RowBlocks::append() {
  const std::span<std::int64_t> row = append_any();
  std::fill(row.begin(), row.end(), 0);
  return row;
}

// Appends a row with any content.
std::span<std::int64_t> RowBlocks::append_any() {
  if (size_ == blocks_.size() * rows_each_) {
    void* const spare = spare_->take(block_bytes_);
    Block block(static_cast<std::int64_t*>(spare != nullptr ? spare : fetch(block_bytes_)), {spare_, block_bytes_});
    blocks_.push_back(std::move(block));
  }
  return (*this)[size_++];
}

void RowBlocks::GiveBack::operator()(std::int64_t* block) const {
  spare->give_back(block, bytes);
}

}  // namespace sunfleck
