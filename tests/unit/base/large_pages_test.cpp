// Tests arrays in large pages.

#include "base/large_pages.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace sunfleck {
namespace {

using Allocator = LargePageAllocator<std::int64_t>;

TEST(LargePages, HoldLongArraysFromTheirBeginning) {
  constexpr std::size_t least = Allocator::least_bytes / sizeof(std::int64_t);
  const LargeVector<std::int64_t> values(least, 5);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % Allocator::page_bytes, 0U);
}

TEST(LargePages, KeepValuesWhileArraysGrowAndShrink) {
  LargeVector<std::int64_t> values;
  constexpr std::int64_t count = 6'000'000;  // grows from small arrays to large ones
  for (std::int64_t k = 0; k < count; ++k) values.push_back(k);
  for (std::int64_t k = 0; k < count; ++k) ASSERT_EQ(values[static_cast<std::size_t>(k)], k);
  values.resize(10);
  values.shrink_to_fit();
  EXPECT_EQ(values.back(), 9);
  const LargeVector<std::int64_t> copy = values;
  EXPECT_EQ(copy, values);
}

}  // namespace
}  // namespace sunfleck
