// Compares the main scene with its reviewed tables in reference/. SUNFLECK_UPDATE_REFERENCES=1 rewrites them; review the change
// and explain it in the commit.

#include "regression/program.h"
#include "support/table.h"

#include <cmath>

namespace sunfleck::regression {
namespace {

// On one kind of machine the bytes are the same. Elsewhere a sine may differ in its last place, which may change the ninth
// digit of a cell, by at most 1e-8 of its value.
constexpr double tolerance = 1e-8;

class Reference : public ProgramTest, public ::testing::WithParamInterface<std::string> {};

void compare(const Table& got, const Table& reference) {
  EXPECT_EQ(got.header(), reference.header());
  ASSERT_EQ(got.size(), reference.size());
  for (std::size_t row = 0; row < got.size(); ++row) {
    for (const std::string& column : reference.columns()) {
      if (got.cell(row, column) == reference.cell(row, column)) continue;
      if (column == "organ" || column == "role") {
        ADD_FAILURE() << "row " << row << ": " << got.cell(row, column) << ", not " << reference.cell(row, column);
        continue;
      }
      const double expected = reference.number(row, column);
      EXPECT_NEAR(got.number(row, column), expected, tolerance * std::abs(expected)) << column << ", row " << row;
    }
  }
}

TEST_P(Reference, IsGivenAgain) {
  const std::filesystem::path reference =
      std::filesystem::path(SUNFLECK_SOURCE_DIR) / "tests/regression/reference" / ("maize_sparse_" + GetParam());
  simulate(scene_file("maize_sparse.toml"), {"--device", "cpu", "--grid", "0.004", "--seed", "1", "--images", "none"});
  if (is_set("SUNFLECK_UPDATE_REFERENCES")) {
    std::filesystem::create_directories(reference.parent_path());
    std::filesystem::copy_file(folder_ / "out" / GetParam(), reference, std::filesystem::copy_options::overwrite_existing);
    GTEST_SKIP() << "rewritten: " << reference;
  }
  ASSERT_TRUE(std::filesystem::exists(reference)) << reference << " is missing; set SUNFLECK_UPDATE_REFERENCES=1 to write it";
  compare(Table(file(GetParam())), Table(content(reference)));
  if (HasFailure()) {
    const std::filesystem::path kept = std::filesystem::path(::testing::TempDir()) / ("maize_sparse_" + GetParam());
    std::filesystem::copy_file(folder_ / "out" / GetParam(), kept, std::filesystem::copy_options::overwrite_existing);
    ADD_FAILURE() << "compare " << kept << " with " << reference;
  }
}

INSTANTIATE_TEST_SUITE_P(MaizeSparse, Reference, ::testing::Values("profile.csv", "organs.csv"),
                         [](const ::testing::TestParamInfo<std::string>& table) {
                           return table.param.substr(0, table.param.find('.'));
                         });

}  // namespace
}  // namespace sunfleck::regression
