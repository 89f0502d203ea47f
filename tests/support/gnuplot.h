#pragma once
// Support for tests that draw with the real gnuplot and examine the pictures. Without the program they are skipped and say so,
// or fail if SUNFLECK_REQUIRE_DEVICE=1 is set.

#include "files/results/plots/plots.h"
#include "support/content.h"
#include "support/picture.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace sunfleck::test {

class GnuplotTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto warning = draw_plot("set terminal pngcairo\nplot x\n", folder_ / "probe.png");
    if (!warning) return;
    const char* required = std::getenv("SUNFLECK_REQUIRE_DEVICE");
    if (required != nullptr && std::string(required) == "1") FAIL() << *warning;
    GTEST_SKIP() << *warning;
  }

  // Draws twice with a script of share/plots, expects the same bytes, and reads them.
  [[nodiscard]] Picture draw(const char* script, const PlotVariables& variables) const {
    const std::filesystem::path first = folder_ / "first.png", second = folder_ / "second.png";
    EXPECT_EQ(draw_table(script, variables, first).value_or(""), "");
    EXPECT_EQ(draw_table(script, variables, second).value_or(""), "");
    EXPECT_EQ(content(first), content(second));
    return read_picture(first);
  }

  TempFolder folder_;
};

}  // namespace sunfleck::test
