#include "base/suggestions.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

TEST(NearestWord, IsAtMostTwoEditsAway) {
  const std::vector<std::string> words = {"size", "periodic", "up", "at", "rgb"};
  EXPECT_EQ(nearest_word("siez", words), "size");
  EXPECT_EQ(nearest_word("seize", words), "size");
  EXPECT_EQ(nearest_word("periodical", words), "periodic");
  EXPECT_EQ(nearest_word("rbg", words), "rgb");
  EXPECT_EQ(nearest_word("a", words), "at");
  EXPECT_EQ(nearest_word("xy", words), std::nullopt);
  EXPECT_EQ(nearest_word("units", words), std::nullopt);
  EXPECT_EQ(nearest_word("", words), std::nullopt);
  EXPECT_EQ(nearest_word("RGB", words), "rgb");
  EXPECT_EQ(nearest_word("par", {"NIR", "PAR"}), "PAR");
  EXPECT_EQ(nearest_word("NIR", {"PAR"}), std::nullopt);
}

}  // namespace
}  // namespace sunfleck
