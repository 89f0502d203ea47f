// Tests bad usage: each mistake gives one line on standard error, before any work starts.

#include "regression/program.h"

namespace sunfleck::regression {
namespace {

struct Mistake {
  Arguments more;     // appended to `run SCENE`
  std::string names;  // text that the message must contain
};

class Usage : public ProgramTest {
 protected:
  // Expects an error; `arguments` begin with a command that takes -o.
  void expect_refused(Arguments arguments, const std::string& names, int status = 2) const {
    arguments.insert(arguments.begin() + 1, {"-o", "out"});
    SCOPED_TRACE(::testing::PrintToString(arguments));
    expect_one_error(run(arguments), status, names);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
  const std::string scene_ = scene_file("two_squares.toml").string();
};

TEST_F(Usage, OfOptions) {
  const std::vector<Mistake> mistakes{{{"--bogus"}, "--bogus"},
                                      {{"--eror", "0.1"}, "--eror (unknown option or argument); did you mean --error?"},
                                      {{"--sed=2"}, "did you mean --seed?"},
                                      {{"extra"}, "extra"},
                                      {{"--size", "3x"}, "--size 3x"},
                                      {{"--size", "640x480x3"}, "--size 640x480x3"},
                                      {{"--size", "99999999999x99999999999"}, "--size"},
                                      {{"--passes", "4"}, "--passes 4"},
                                      {{"--passes", "8.5"}, "--passes 8.5"},
                                      {{"--grid", "0"}, "--grid 0"},
                                      {{"--grid", "nan"}, "--grid nan"},
                                      {{"--grid", "-1"}, "--grid -1"},
                                      {{"--grid", "1e-9"}, "--grid 1e-09"},
                                      {{"--error", "nan"}, "--error nan"},
                                      {{"--error", "1"}, "--error 1"},
                                      {{"--direct-error", "0"}, "--direct-error 0"},
                                      {{"--indirect-error", "x"}, "--indirect-error x"},
                                      {{"--max-rays", "0"}, "--max-rays 0"},
                                      {{"--max-rays", "-3"}, "--max-rays -3"},
                                      {{"--max-seconds", "inf"}, "--max-seconds inf"},
                                      {{"--seed", "-1"}, "--seed -1"},
                                      {{"--seed", "18446744073709551616"}, "--seed"},
                                      {{"--threads", "-1"}, "--threads -1"},
                                      {{"--samples", "0"}, "--samples 0"},
                                      {{"--size", "8193x64"}, "--size 8193x64"},
                                      {{"--samples", "257"}, "--samples 257"},
                                      {{"--repeat", "2"}, "--repeat 2"},
                                      {{"--repeat", "3"}, "--repeat 3"},
                                      {{"--repeat", "11"}, "--repeat 11"},
                                      {{"--view", "below"}, "--view below"},
                                      {{"--chart", "pie"}, "--chart pie"},
                                      {{"--field", "sky"}, "rank_sky"},
                                      {{"--field", "indirect", "--chart", "hue"}, "hue_indirect"},
                                      {{"--images", "map_sky"}, "map_sky"},
                                      {{"--export", "xls"}, "--export xls"},
                                      {{"--images", "photo"}, "--images photo"},
                                      {{"--images", "none,all"}, "--images none,all"},
                                      {{"--band", "UV"}, "--band UV"},
                                      {{"--device", ""}, "--device"},
                                      {{"--seed", "1", "--seed", "2"}, "--seed"},
                                      {{"--size"}, "--size"}};
  for (const Mistake& mistake : mistakes) expect_refused(Arguments{"run", scene_} + mistake.more, mistake.names);
}

TEST_F(Usage, OfCommandsAndFiles) {
  expect_one_error(run({}), 2, "command");
  expect_one_error(run({"ran", scene_}), 2, "ran");
  expect_one_error(run({"--quiet", "run", scene_}), 2, "--quiet");
  expect_one_error(run({"run"}), 2, "scene");
  expect_refused({"run", "absent.toml"}, "absent.toml");
  expect_refused({"run", folder_.path().string()}, folder_.path().string());
  expect_refused({"run", ""}, "scene");
  expect_one_error(run({"info", "absent.toml", "--json"}), 2, "absent.toml");
  expect_one_error(run({"info", "--jsn"}), 2, "--jsn");
}

TEST_F(Usage, OfDevices) {
  expect_refused({"run", scene_, "--device", "nonexistent"}, "\"nonexistent\"", 3);
  expect_refused({"run", scene_, "--device", "99"}, "99", 3);
}

TEST_F(Usage, OfPlacesForResults) {
  folder_.write("file", "not a folder");
  folder_.write("file.glb", "");
  expect_one_error(run({"run", scene_, "--device", "cpu", "-o", "file"}), 1, "file");
  expect_one_error(run({"run", scene_, "--device", "cpu", "-o", "file/below"}), 1, "file/below");
  expect_one_error(run({"run", scene_, "--device", "cpu", "-o", "/proc/sunfleck"}), 1, "/proc/sunfleck");
  expect_one_error(run({"maize", "--rows", "1", "--per-row", "1", "-o", "file.glb/stand.glb"}), 1, "file.glb/stand.glb");
  EXPECT_EQ(content(folder_ / "file"), "not a folder");
}

TEST_F(Usage, OfTheStand) {
  expect_one_error(run({"maize", "--rows", "1", "--per-row", "1", "-o", "stand.obj"}), 2, "stand.obj");
  expect_one_error(run({"maize", "--rows", "0"}), 2, "--rows 0");
  expect_one_error(run({"maize", "--rows", "200", "--per-row", "200"}), 2, "--rows 200");
  expect_one_error(run({"maize", "--spacing", "0.6"}), 2, "--spacing");
  expect_one_error(run({"maize", "--spacing", "0.6,nan"}), 2, "--spacing nan");
  expect_one_error(run({"maize", "--seed", "-1"}), 2, "--seed -1");
}

TEST_F(Usage, HelpAndVersionAreNoErrors) {
  for (const Arguments& arguments :
       {Arguments{"--help"}, {"run", "--help"}, {"maize", "-h"}, {"convert", "--help"}, {"info", "--help"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("Usage: sunfleck"), std::string::npos) << outcome.out;
  }
  for (const Arguments& arguments : {Arguments{"--version"}, {"run", "--version"}, {"info", "--version"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out.rfind("sunfleck ", 0), 0U) << outcome.out;
  }
}

}  // namespace
}  // namespace sunfleck::regression
