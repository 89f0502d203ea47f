// Tests that rows keep their numbers in blocks that are used again.

#include "base/row_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace sunfleck::test {
namespace {

constexpr std::size_t width = 200;
constexpr std::size_t many = 30000;  // 46 MB, in more than 16 blocks

void fill(RowBlocks& rows, std::size_t count, std::int64_t by) {
  while (rows.size() < count) {
    const std::span<std::int64_t> row = rows.append();
    ASSERT_TRUE(std::all_of(row.begin(), row.end(), [](std::int64_t value) { return value == 0; }));
    std::fill(row.begin(), row.end(), by * static_cast<std::int64_t>(rows.size()));
  }
}

void expect_filled(const RowBlocks& rows, std::size_t count, std::int64_t by) {
  ASSERT_EQ(rows.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    ASSERT_EQ(rows[k].size(), width);
    ASSERT_EQ(rows[k].front(), by * static_cast<std::int64_t>(k + 1));
    ASSERT_EQ(rows[k].back(), by * static_cast<std::int64_t>(k + 1));
  }
}

TEST(RowBlocks, KeepTheirPlace) {
  RowBlocks rows(width, many, nullptr);
  rows.append()[0] = 7;
  const std::int64_t* const first = rows[0].data();
  for (std::size_t k = 1; k < many; ++k) rows.append();
  EXPECT_EQ(rows[0].data(), first);
  EXPECT_EQ(rows[0][0], 7);
  EXPECT_EQ(rows.bytes(), many * width * sizeof(std::int64_t));
}

TEST(RowBlocks, BeginWithZerosInMemoryThatWasUsedBefore) {
  const auto spare = std::make_shared<SpareBlocks>();
  const std::int64_t* used = nullptr;
  {
    RowBlocks rows(width, many, spare);
    fill(rows, many / 2, 3);
    used = rows[0].data();
  }
  RowBlocks rows(width, many, spare);
  fill(rows, many, -5);
  expect_filled(rows, many, -5);
  const auto is_used = [&](std::size_t k) { return rows[k].data() == used; };
  bool found = false;
  for (std::size_t k = 0; k < many / 2; ++k) found = found || is_used(k);
  EXPECT_TRUE(found);
}

TEST(RowBlocks, AreCopiedWithTheirNumbers) {
  const auto spare = std::make_shared<SpareBlocks>();
  RowBlocks rows(width, many, spare);
  fill(rows, 1000, 2);
  RowBlocks copy = rows;
  RowBlocks assigned;
  assigned = copy;
  copy[3][0] = 0;
  expect_filled(rows, 1000, 2);
  expect_filled(assigned, 1000, 2);
  fill(assigned, 2000, 2);
  expect_filled(assigned, 2000, 2);
}

TEST(RowBlocks, OfAnySizeFitIntoBlocks) {
  for (const std::size_t columns : {std::size_t{8}, std::size_t{2000}, std::size_t{300000}}) {  // 300,000: longer than a page
    RowBlocks rows(columns, 10, nullptr);
    for (std::size_t k = 0; k < 10; ++k) rows.append().back() = static_cast<std::int64_t>(k);
    for (std::size_t k = 0; k < 10; ++k) ASSERT_EQ(rows[k].back(), static_cast<std::int64_t>(k));
  }
}

TEST(SpareBlocks, GoToTheSystemOnceClosed) {
  const auto spare = std::make_shared<SpareBlocks>();
  RowBlocks rows(width, many, spare);
  fill(rows, 100, 1);
  spare->close();
  fill(rows, 1000, 1);
  expect_filled(rows, 1000, 1);
  rows = RowBlocks();
  EXPECT_EQ(spare->take(std::size_t{1} << 21U), nullptr);
}

}  // namespace
}  // namespace sunfleck::test
