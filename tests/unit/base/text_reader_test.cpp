#include "base/text_reader.h"

#include <gtest/gtest.h>

#include <clocale>
#include <vector>

namespace sunfleck {
namespace {

void expect_limits() {
  EXPECT_EQ(parse_number("2.5"), 2.5);
  EXPECT_EQ(parse_number("1.5e-400"), 0.0);
  EXPECT_EQ(parse_number("-1.5e-400"), 0.0);
  EXPECT_EQ(parse_number("1.5e400"), std::nullopt);
  EXPECT_EQ(parse_number("-1.5e400"), std::nullopt);
  EXPECT_EQ(parse_number("2,5"), std::nullopt);
}

TEST(ParseNumber, TooSmallIsZeroAndTooLargeIsNoNumber) {
  expect_limits();
}

TEST(ParseNumber, DoesNotDependOnTheLocale) {
  const char* set = nullptr;
  for (const char* with_comma : {"de_DE.UTF-8", "fr_FR.UTF-8", "es_ES.UTF-8", "it_IT.UTF-8", "nl_NL.UTF-8"})
    if (set == nullptr) set = std::setlocale(LC_NUMERIC, with_comma);
  if (set == nullptr) GTEST_SKIP() << "no locale with a decimal comma is installed";
  expect_limits();
  std::setlocale(LC_NUMERIC, "C");
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
