#include "base/each_number.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck {
namespace {

struct Pair {
  int first = 0;
  double second = 0.0;

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.first, self.second);
  }
};

TEST(EachNumber, VisitsTheNumbersOfListsAndStructsInOrder) {
  const std::vector<std::vector<Pair>> values{{{1, 2.0}, {3, 4.0}}, {}, {{5, 6.0}}};
  const float last = 7.0F;
  std::vector<double> seen;
  EachNumber([&](auto number) { seen.push_back(static_cast<double>(number)); })(values, last);
  EXPECT_EQ(seen, (std::vector<double>{1, 2, 3, 4, 5, 6, 7}));
}

TEST(EachNumber, MayChangeThem) {
  std::vector<Pair> values{{1, 2.0}, {3, 4.0}};
  EachNumber([](auto& number) { number *= 2; })(values);
  EXPECT_EQ(values[1].first, 6);
  EXPECT_EQ(values[0].second, 4.0);
}

}  // namespace
}  // namespace sunfleck
