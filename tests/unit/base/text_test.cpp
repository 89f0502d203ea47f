#include "base/text.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

TEST(Text, CountsInThePluralUnlessThereIsOne) {
  EXPECT_EQ(counted(0, "triangle"), "0 triangles");
  EXPECT_EQ(counted(1, "triangle"), "1 triangle");
  EXPECT_EQ(counted(186000, "triangle"), "186000 triangles");
}

TEST(Text, QuotesNamesForAShellWhereTheyNeedIt) {
  EXPECT_EQ(in_shell("scenes/stand_2.toml"), "scenes/stand_2.toml");
  EXPECT_EQ(in_shell("my stand.toml"), "'my stand.toml'");
  EXPECT_EQ(in_shell("Bob's.toml"), R"('Bob'\''s.toml')");
  EXPECT_EQ(in_shell(""), "''");
}

}  // namespace
}  // namespace sunfleck
