// Tests the line at the end of a stopped run: it names the pass that fell short, its bound, and the figure with that error.
#include "regression/program.h"

namespace sunfleck::regression {
namespace {

class Stop : public ProgramTest {
 protected:
  [[nodiscard]] std::string line(const std::string& scene, const Arguments& work) const {
    return simulate(scene_file(scene), Arguments{"--device", "cpu", "--images", "none", "--quiet"} + work, 1).err;
  }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
};

TEST_F(Stop, WithoutASunNamesTheIndirectPass) {
  const std::string said = line("maize_overcast.toml", {"--error", "0.001", "--max-rays", "400000"});
  EXPECT_TRUE(has(said, ", indirect error 0.")) << said;
  EXPECT_TRUE(has(said, " of 0.001 (PAR absorbed by ")) << said;
  EXPECT_FALSE(has(said, " direct error")) << said;
  EXPECT_FALSE(has(said, "error 0 of")) << said;
  const nlohmann::json told = summary();
  EXPECT_TRUE(told["direct"]["judged"].is_null());
  EXPECT_TRUE(has(told["indirect"]["judged"].get<std::string>(), "PAR absorbed by ")) << told["indirect"];
}

TEST_F(Stop, NamesThePassThatFellShort) {
  const std::string said =
      line("maize_sparse.toml", {"--direct-error", "0.2", "--indirect-error", "1e-4", "--max-rays", "2e6"});
  EXPECT_TRUE(has(said, ", indirect error 0.")) << said;
  EXPECT_FALSE(has(said, " direct error")) << said;
  const std::string other =
      line("maize_sparse.toml", {"--direct-error", "1e-4", "--indirect-error", "0.5", "--max-rays", "2e6"});
  EXPECT_TRUE(has(other, ", direct error 0.")) << other;
  EXPECT_TRUE(has(other, "(beam on ")) << other;
  EXPECT_FALSE(has(other, "indirect error")) << other;
}

TEST_F(Stop, NamesBothPassesAndTheOrgan) {
  const std::string said = line("maize_sparse.toml", {"--error", "1e-4", "--max-rays", "2e6"});
  EXPECT_TRUE(has(said, ", direct error 0.")) << said;
  EXPECT_TRUE(has(said, ", indirect error 0.")) << said;
  std::string scene = content(scene_file("two_squares.toml"));
  scene += "\n[accuracy]\nof = \"organ\"\n";
  folder_.write("two_squares.obj", content(scene_file("two_squares.obj")));
  folder_.write("organs.toml", scene);
  const Outcome of_organ =
      simulate("organs.toml", {"--device", "cpu", "--images", "none", "--quiet", "--error", "1e-5", "--max-rays", "2e5"}, 1);
  EXPECT_TRUE(has(of_organ.err, " of plant 1)")) << of_organ.err;
}

}  // namespace
}  // namespace sunfleck::regression
