#include "base/text_reader.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck {
namespace {

TEST(ParseNumber, TooSmallIsZeroAndTooLargeIsNoNumber) {
  EXPECT_EQ(parse_number("2.5"), 2.5);
  EXPECT_EQ(parse_number("1.5e-400"), 0.0);
  EXPECT_EQ(parse_number("-1.5e-400"), 0.0);
  EXPECT_EQ(parse_number("1.5e400"), std::nullopt);
  EXPECT_EQ(parse_number("-1.5e400"), std::nullopt);
  EXPECT_EQ(parse_number("2,5"), std::nullopt);
}

TEST(SplitCells, StripsBlanksAndQuotes) {
  std::vector<std::string_view> cells;
  split_cells(" a, \" b \",,\"c", cells);
  EXPECT_EQ(cells, (std::vector<std::string_view>{"a", "b", "", "\"c"}));
  split_cells("1,5;2", cells, ';');
  EXPECT_EQ(cells, (std::vector<std::string_view>{"1,5", "2"}));
}

}  // namespace
}  // namespace sunfleck
