// Tests that rows keep their numbers in blocks that are used again.

#include "base/row_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr std::size_t width = 200;
constexpr std::size_t many = 30000;  // 48 MB, in more than 16 blocks

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

TEST(RowBlocks, LeaveNoRowsBehind) {
  RowBlocks rows(width, many, nullptr);
  fill(rows, 100, 1);
  const RowBlocks moved = std::move(rows);
  expect_filled(moved, 100, 1);
  EXPECT_EQ(rows.size(), 0U);  // NOLINT(bugprone-use-after-move): a moved-from object has no rows
  fill(rows, 200, 4);
  expect_filled(rows, 200, 4);
}

TEST(RowBlocks, AreDrainedInTheirOrder) {
  constexpr std::size_t several_blocks = 9000;
  RowBlocks rows(width, many, nullptr);
  fill(rows, several_blocks, 3);
  std::size_t taken = 0;
  rows.drain([&](std::size_t row, std::span<const std::int64_t> values) {
    ASSERT_EQ(row, taken++);
    ASSERT_EQ(values.size(), width);
    ASSERT_EQ(values.back(), 3 * static_cast<std::int64_t>(row + 1));
  });
  EXPECT_EQ(taken, several_blocks);
  expect_filled(rows, 0, 3);
  fill(rows, 100, 4);
  expect_filled(rows, 100, 4);
}

TEST(SpareBlocks, ServeSeveralThreads) {
  const auto spare = std::make_shared<SpareBlocks>();
  std::vector<std::thread> threads;
  for (std::int64_t by = 1; by <= 4; ++by) {
    threads.emplace_back([&spare, by] {
      for (int round = 0; round < 20; ++round) {
        RowBlocks rows(width, 1000, spare);
        fill(rows, 200, by);
        expect_filled(rows, 200, by);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(SpareBlocks, ServeThoseWhoAskForAsManyBytes) {
  SpareBlocks spare;
  void* const block = std::malloc(4096);
  spare.give_back(block, 4096);
  EXPECT_EQ(spare.take(8192), nullptr);
  EXPECT_EQ(spare.take(4096), block);
  EXPECT_EQ(spare.take(4096), nullptr);
  spare.give_back(block, 4096);
  spare.close();
  EXPECT_EQ(spare.take(4096), nullptr);
}

TEST(SpareBlocks, GoToTheSystemOnceClosed) {
  const auto spare = std::make_shared<SpareBlocks>();
  RowBlocks rows(width, many, spare);
  fill(rows, 100, 1);
  spare->close();
  fill(rows, 1000, 1);
  expect_filled(rows, 1000, 1);
}

}  // namespace
}  // namespace sunfleck::test
