// Tests triangles that coincide with others: `info` names them, `run` warns of them, and the tables show them dark and without
// a sunlit share.

#include "regression/program.h"
#include "support/table.h"

namespace sunfleck::regression {
namespace {

using nlohmann::json;

// The sun is overhead, and nothing shades the leaves.
const std::string copies_scene = R"(title = "Leaves of two skins"
[plot]
size = [1.0, 1.0]
[sun]
elevation = 90.0
azimuth = 0.0
[[band]]
name = "PAR"
direct = 100.0
[soil]
reflectance = 0.2
[optics.leaf]
reflectance = 0.1
transmittance = 0.1
[output]
layers = 2
[[geometry]]
file = "leaves.obj"
optics = "leaf"
)";

// Leaf 1 coincides with no other.
const std::string corners = R"(v 0.1 0.5 0.1
v 0.1 0.5 0.5
v 0.5 0.5 0.1
v 0.6 0.5 0.6
v 0.6 0.5 0.9
v 0.9 0.5 0.6
v 0.9 0.5 0.9
)";
const std::string originals = "o plant1_leaf1\nf 1 2 3\no plant1_leaf2\nf 4 5 6\n";
// Leaf 3 lies on leaf 1, with its other side up; half of leaf 4 lies on leaf 2.
const std::string copied_leaves = "o plant1_leaf3\nf 3 2 1\no plant2_leaf4\nf 6 4 5\nf 5 7 6\n";
constexpr double first_m2 = 0.08;
constexpr double second_m2 = 0.045;

class Copies : public ProgramTest {
 protected:
  Copies() {
    folder_.write("scene.toml", copies_scene);
    folder_.write("leaves.obj", corners + originals + copied_leaves);
  }
  // Allows twice the half-width of the 95 % interval, about four standard errors.
  static void expect_wholly_sunlit(const Table& organs, std::size_t row) {
    const double half_width = organs.number(row, "sunlit_fraction_error");
    EXPECT_LT(half_width, 0.05);
    EXPECT_NEAR(organs.number(row, "sunlit_fraction"), 1.0, 2.0 * half_width) << row;
  }

  const Arguments work_{"--device", "cpu", "--images", "none", "--grid", "0.01"};
};

TEST_F(Copies, AreNamedByInfo) {
  const Outcome lines = run({"info", "scene.toml", "--device", "cpu"});
  EXPECT_EQ(lines.status, 0) << lines.err;
  EXPECT_NE(lines.out.find("2 triangles coincide with earlier ones and receive no light:\n"
                           "  1 of leaf of plant 1 with leaf of plant 1\n"
                           "  1 of leaf of plant 2 with leaf of plant 1\n"),
            std::string::npos)
      << lines.out;
  const Outcome fields = run({"info", "scene.toml", "--device", "cpu", "--json"});
  const json info = json::parse(fields.out, nullptr, false);
  EXPECT_EQ(info["coincident_triangles"], 2);
  const json expected = json::parse(R"([
      {"plant": 1, "organ": "leaf", "rank": 3, "triangles": 1, "coincide_with": {"plant": 1, "organ": "leaf", "rank": 1}},
      {"plant": 2, "organ": "leaf", "rank": 4, "triangles": 1, "coincide_with": {"plant": 1, "organ": "leaf", "rank": 2}}])");
  EXPECT_EQ(info["coincident_organs"], expected) << info["coincident_organs"];
}

TEST_F(Copies, AreWarnedOfOnce) {
  const Outcome outcome = simulate("scene.toml", work_);
  const std::size_t warning = outcome.err.find("warning: scene.toml: 2 triangles coincide with earlier ones, ");
  ASSERT_NE(warning, std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("triangle 2 of leaf of plant 1 with triangle 0 of leaf of plant 1"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.find("coincide", warning + 60), std::string::npos) << outcome.err;
}

// The earlier triangle receives all the light, the later one none. The area of the later one counts in the leaf area but in no
// sunlit share.
TEST_F(Copies, AreDarkAndHaveNoSunlitShare) {
  simulate("scene.toml", work_);
  const Table organs(file("organs.csv"));
  const auto row_of = [&](double rank) {
    for (std::size_t row = 0; row < organs.size(); ++row) {
      if (organs.number(row, "rank") == rank) return row;
    }
    ADD_FAILURE() << "no leaf " << rank;
    return std::size_t{0};
  };
  for (const double rank : {1.0, 2.0}) {
    expect_wholly_sunlit(organs, row_of(rank));
    EXPECT_NEAR(organs.number(row_of(rank), "PAR_direct"), 100.0, 2.0) << rank;
  }
  const std::size_t copy = row_of(3.0);
  EXPECT_NEAR(organs.number(copy, "area_m2"), first_m2, 1e-6);
  EXPECT_EQ(organs.cell(copy, "sunlit_fraction"), "");
  EXPECT_EQ(organs.cell(copy, "sunlit_fraction_error"), "");
  for (const char* column : {"PAR_direct", "PAR_indirect", "PAR_absorbed"})
    EXPECT_EQ(organs.number(copy, column), 0.0) << column;
  const std::size_t half = row_of(4.0);
  EXPECT_NEAR(organs.number(half, "area_m2"), 2.0 * second_m2, 1e-6);
  expect_wholly_sunlit(organs, half);  // its share is that of the half without a copy
  EXPECT_NEAR(organs.number(half, "PAR_direct"), 50.0, 1.0) << "over both halves";
  EXPECT_NEAR(summary()["leaf_area_index"].get<double>(), 2.0 * first_m2 + 3.0 * second_m2, 1e-6);
  EXPECT_NEAR(summary()["sunlit_leaf_fraction"].get<double>(), 1.0,
              2.0 * summary()["sunlit_leaf_fraction_error"].get<double>());
}

TEST_F(Copies, ChangeNoOtherLeaf) {
  simulate("scene.toml", work_);
  const Table with(file("organs.csv"));
  folder_.write("leaves.obj", corners + originals);
  const Outcome outcome = simulate("scene.toml", work_);
  EXPECT_EQ(outcome.err.find("coincide"), std::string::npos) << outcome.err;
  const Table without(file("organs.csv"));
  ASSERT_EQ(without.cell(0, "rank"), "1");
  for (const char* column : {"area_m2", "sunlit_fraction", "sunlit_fraction_error", "PAR_direct"}) {
    EXPECT_EQ(with.cell(0, column), without.cell(0, column)) << column;
  }
}

}  // namespace
}  // namespace sunfleck::regression
