// Tests that the memory of vectors serves again.

#include "base/spare_vectors.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace sunfleck::test {
namespace {

using Values = std::vector<std::int64_t>;

TEST(SpareVectors, ServeThoseWhoAskForAsMany) {
  SpareVectors<std::int64_t> spare;
  Values values = spare.zeros(1000);
  EXPECT_EQ(values, Values(1000));
  values.assign(1000, 7);
  const std::int64_t* const memory = values.data();
  spare.give_back(std::move(values));
  EXPECT_NE(spare.zeros(999).data(), memory);
  const Values again = spare.zeros(1000);
  EXPECT_EQ(again.data(), memory);
  EXPECT_EQ(again, Values(1000));
}

TEST(SpareVectors, KeepNoMoreThanWereLent) {
  SpareVectors<std::int64_t> spare;
  spare.give_back(Values(1000));
  EXPECT_EQ(spare.bytes(), 0U);
  Values lent = spare.zeros(1000);
  spare.give_back(std::move(lent));
  spare.give_back(Values(1000));
  EXPECT_EQ(spare.bytes(), 1000 * sizeof(std::int64_t));
  Values shorter = spare.zeros(10);
  spare.give_back(Values(1000));  // none of that size is lent
  spare.give_back(std::move(shorter));
  EXPECT_EQ(spare.bytes(), 1010 * sizeof(std::int64_t));
  spare.free();
  EXPECT_EQ(spare.bytes(), 0U);
}

}  // namespace
}  // namespace sunfleck::test
