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

TEST(SplitCells, KeepsSeparatorsInQuotes) {
  using Cells = std::vector<std::string_view>;
  std::vector<std::string_view> cells;
  const auto split = [&](std::string_view line, char separator = ',') {
    split_cells(line, cells, separator);
    return cells;
  };
  EXPECT_EQ(split("a, \"b, c\" ,\"\",d"), (Cells{"a", "b, c", "", "d"}));
  EXPECT_EQ(split("\"the \"\"old\"\", one\",2"), (Cells{"the \"\"old\"\", one", "2"}));
  EXPECT_EQ(split("\"a\" b,c"), (Cells{"\"a\" b", "c"}));
  EXPECT_EQ(split("5\" pipe, 6\" pipe"), (Cells{"5\" pipe", "6\" pipe"}));
  EXPECT_EQ(split("\"a,b"), (Cells{"\"a", "b"}));
  EXPECT_EQ(split("\t\"a\tb\"\tc", '\t'), (Cells{"", "a\tb", "c"}));
}

}  // namespace
}  // namespace sunfleck
