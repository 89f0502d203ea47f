#include "base/shared_vector.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck {
namespace {

TEST(SharedVector, CopiesShareTheirElementsUntilOneChanges) {
  const SharedVector<int> first{1, 2, 3};
  SharedVector<int> second = first;
  EXPECT_EQ(std::as_const(second).data(), first.data());
  second[1] = 5;
  EXPECT_NE(std::as_const(second).data(), first.data());
  EXPECT_EQ(first.get(), (std::vector{1, 2, 3}));
  EXPECT_EQ(second.get(), (std::vector{1, 5, 3}));
}

TEST(SharedVector, OfOneOwnerChangesInPlace) {
  SharedVector<int> values{1, 2};
  values.reserve(8);
  const int* const place = std::as_const(values).data();
  values.push_back(3);
  values.back() = 4;
  EXPECT_EQ(std::as_const(values).data(), place);
  EXPECT_EQ(values, (SharedVector<int>{1, 2, 4}));
}

TEST(SharedVector, IsEmptyAtFirst) {
  SharedVector<int> values;
  EXPECT_TRUE(values.empty());
  EXPECT_EQ(values.size(), 0U);
}

}  // namespace
}  // namespace sunfleck
