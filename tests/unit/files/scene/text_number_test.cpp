#include "files/scene/text_number.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

TEST(TextNumber, KnowsLengthsAndAngles) {
  EXPECT_EQ(number_in_text("50 cm", "give metres"), 0.5);
  EXPECT_EQ(number_in_text("5mm", "give metres"), 0.005);
  EXPECT_EQ(number_in_text(" 2 m ", "give metres"), 2.0);
  EXPECT_EQ(number_in_text("48.85N", "give degrees north"), 48.85);
  EXPECT_EQ(number_in_text("4,5 W", "give degrees east"), -4.5);
  EXPECT_EQ(number_in_text("30 \u00b0", "give degrees"), 30.0);
  EXPECT_EQ(number_in_text("\u22123", "give metres"), -3.0);
  EXPECT_EQ(number_in_text("+3", ""), 3.0);
  EXPECT_EQ(number_in_text("10 %", "give a share"), 0.1);
}

TEST(TextNumber, LeavesOtherTextsAlone) {
  for (const char* text : {"", " ", "noon", "2 x 3", "50 ft", "N", "-", "1,2,3", "48 51 24 N"}) {
    EXPECT_FALSE(number_in_text(text, "give metres or degrees")) << text;
  }
  EXPECT_FALSE(number_in_text("48.85N", "give metres"));
  EXPECT_FALSE(number_in_text("5 cm", "give degrees"));
}

TEST(TextNumber, AdvisesTheNumber) {
  EXPECT_EQ(cure_of_text("50 cm", "give metres"), "write it without quotes and unit: 0.5");
  EXPECT_EQ(cure_of_text("50 ft", "give metres"), "write the number alone, without quotes and unit (give metres)");
  const char* const scale = "give 0.01 for a file in cm";
  EXPECT_EQ(cure_of_text("cm", scale), "write the metres that a unit of the file has, without quotes: 0.01");
  EXPECT_EQ(cure_of_text("inches", scale), "write the metres that a unit of the file has, without quotes: 0.0254");
  EXPECT_EQ(cure_of_text("1 cm", scale), "write it without quotes and unit: 0.01");
  EXPECT_EQ(cure_of_text("small", scale), "give a number, without quotes (give 0.01 for a file in cm)");
  EXPECT_EQ(cure_of_text("noon", "give degrees"), "give a number, without quotes (give degrees)");
}

}  // namespace
}  // namespace sunfleck
