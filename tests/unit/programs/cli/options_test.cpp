#include "programs/cli/options.h"

#include "base/version.h"
#include "support/error_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {
namespace {

Command parse(std::initializer_list<const char*> words) {
  std::vector<const char*> argv{"sunfleck"};
  argv.insert(argv.end(), words);
  return parse_command_line(static_cast<int>(argv.size()), argv.data());
}

RunOptions parse_run(std::initializer_list<const char*> words) {
  return std::get<RunOptions>(parse(words));
}

std::string refusal(std::initializer_list<const char*> words) {
  return refusal_of([&] { static_cast<void>(parse(words)); });
}

TEST(Options, OfARunStandBesideTheirNames) {
  const RunOptions options = parse_run({"run", "a.toml"});
  EXPECT_EQ(options.scene, "a.toml");
  EXPECT_TRUE(options.output.empty());
  EXPECT_EQ(options.device, "auto");
  EXPECT_FALSE(options.direct_error || options.indirect_error || options.grid_m || options.passes || options.max_seconds ||
               options.max_rays);
  EXPECT_EQ(options.seed, 1U);
  EXPECT_EQ(options.threads, 0);
  EXPECT_TRUE(options.exports.empty());
  EXPECT_EQ(options.images, std::vector<std::string>{"all"});
  EXPECT_EQ(options.pictures.width, 1600);
  EXPECT_EQ(options.pictures.height, 1200);
  EXPECT_FALSE(options.allow_outside || options.quiet || options.json);
}

TEST(Options, OfARunAreRead) {
  const RunOptions options =
      parse_run({"run",      "-o",  "out",      "a.toml",  "--device",  "cpu", "--grid",          "0.0015",  "--passes",  "32",
                 "--seed",   "12",  "--size",   "640x480", "--samples", "9",   "--max-seconds",   "2.5",     "--threads", "3",
                 "--export", "csv", "--images", "none",    "--band",    "NIR", "--allow-outside", "--quiet", "--json"});
  EXPECT_EQ(options.scene, "a.toml");
  EXPECT_EQ(options.output, "out");
  EXPECT_EQ(options.device, "cpu");
  EXPECT_EQ(options.grid_m, 0.0015);
  EXPECT_EQ(options.passes, 32);
  EXPECT_EQ(options.seed, 12U);
  EXPECT_EQ(options.pictures.width, 640);
  EXPECT_EQ(options.pictures.height, 480);
  EXPECT_EQ(options.pictures.samples, 9);
  EXPECT_EQ(options.max_seconds, 2.5);
  EXPECT_EQ(options.threads, 3);
  EXPECT_EQ(options.exports, std::vector<std::string>{"csv"});
  EXPECT_EQ(options.images, std::vector<std::string>{"none"});
  EXPECT_EQ(options.pictures.band, "NIR");
  EXPECT_TRUE(options.allow_outside && options.quiet && options.json);
}

TEST(Options, TakeSizesOfMemory) {
  EXPECT_EQ(parse_run({"run", "a.toml", "--memory", "500MB"}).memory_bytes, 500'000'000U);
  EXPECT_EQ(parse_run({"run", "a.toml", "--memory", "2GiB"}).memory_bytes, std::uint64_t{2} << 30U);
  EXPECT_EQ(parse_run({"run", "a.toml", "--memory", "1000000"}).memory_bytes, 1'000'000U);
  EXPECT_EQ(parse_run({"run", "a.toml", "--memory", "0500MB"}).memory_bytes, 500'000'000U);
  EXPECT_EQ(parse_run({"run", "a.toml", "--memory", "0100000000"}).memory_bytes, 100'000'000U);
  for (const char* size : {"1kB", "abc", "1Q", "-1MB", "1.5GB", "0", "", "2PB", "99999999999999999999G"}) {
    EXPECT_EQ(refusal({"run", "a.toml", "--memory", size}),
              fmt::format("command line: --memory {} (must be a whole number with a unit, 1MB to 1000TB, such as 500MB or "
                          "2GB); see sunfleck run --help",
                          size));
  }
}

TEST(Options, ErrorSetsTheBoundsThatNothingElseSets) {
  const RunOptions both = parse_run({"run", "a.toml", "--error", "0.01"});
  EXPECT_EQ(both.direct_error, 0.01);
  EXPECT_EQ(both.indirect_error, 0.01);
  const RunOptions one = parse_run({"run", "a.toml", "--error", "0.01", "--indirect-error", "0.02"});
  EXPECT_EQ(one.direct_error, 0.01);
  EXPECT_EQ(one.indirect_error, 0.02);
  const RunOptions direct = parse_run({"run", "a.toml", "--direct-error", "0.03"});
  EXPECT_EQ(direct.direct_error, 0.03);
  EXPECT_FALSE(direct.indirect_error);
}

TEST(Options, KindsOfDevicesStandInAnyCase) {
  EXPECT_EQ(parse_run({"run", "a.toml", "--device", "CPU"}).device, "cpu");
  EXPECT_EQ(parse_run({"run", "a.toml", "--device", "Lavapipe"}).device, "lavapipe");
  EXPECT_EQ(parse_run({"run", "a.toml", "--device", "GPU"}).device, "gpu");
  EXPECT_EQ(parse_run({"run", "a.toml", "--device", "GeForce"}).device, "GeForce");
}

TEST(Options, WholeNumbersAreDecimal) {
  EXPECT_EQ(parse_run({"run", "a.toml", "--seed", "010"}).seed, 10U);
  EXPECT_EQ(parse_run({"run", "a.toml", "--seed", "18446744073709551615"}).seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(parse_run({"run", "a.toml", "--max-rays", "2.5e6"}).max_rays, 2500000U);
  for (const char* text : {"-1", "18446744073709551616", "0x10", "1.5", "", " 1", "1 ", "nan", "1e300"}) {
    EXPECT_NE(refusal({"run", "a.toml", "--seed", text}).find("--seed"), std::string::npos) << text;
  }
}

TEST(Options, ListsTakeOneWord) {
  EXPECT_EQ(parse_run({"run", "--images", "none", "a.toml"}).scene, "a.toml");
  EXPECT_EQ(parse_run({"run", "--export", "csv", "a.toml"}).scene, "a.toml");
  EXPECT_EQ(parse_run({"run", "a.toml", "--images", "rank_direct,all"}).images.size(), 2U);
  EXPECT_EQ(parse_run({"run", "a.toml", "--export", " vtp, csv "}).exports, (std::vector<std::string>{"vtp", "csv"}));
  EXPECT_EQ(parse_run({"run", "a.toml", "--images", "profile , planes"}).images,
            (std::vector<std::string>{"profile", "planes"}));
  const auto tradeoff = std::get<TradeoffOptions>(parse({"tradeoff", "a.toml", "--meshes", "0.5, 0.25"}));
  EXPECT_EQ(tradeoff.meshes, (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(std::get<ValidateOptions>(parse({"validate", "--cases", "sun, sky"})).cases,
            (std::vector<std::string>{"sun", "sky"}));
  EXPECT_NE(std::get<TextToPrint>(parse({"run", "--help"})).text.find("separated by commas"), std::string::npos);
}

TEST(Options, OfPicturesAreShared) {
  for (const char* command : {"run", "render"}) {
    const Command parsed = parse(
        {command, "a.toml", "--view", "fisheye", "--repeat", "5", "--size", "8192x4096", "--samples", "256", "--band", "NIR"});
    const auto* render = std::get_if<RenderOptions>(&parsed);
    const PictureOptions& options = render != nullptr ? render->run.pictures : std::get<RunOptions>(parsed).pictures;
    EXPECT_EQ(options.view, ViewKind::fisheye);
    EXPECT_EQ(options.repeat, 5);
    EXPECT_EQ(options.width, 8192);
    EXPECT_EQ(options.height, 4096);
    EXPECT_EQ(options.samples, 256);
    EXPECT_EQ(options.band, "NIR");
  }
  EXPECT_EQ(refusal({"run", "a.toml", "--repeat", "2"}),
            "--repeat 2 (must be odd: the plot is in the middle of its copies); give 3");
  EXPECT_NE(refusal({"render", "a.toml", "--view", "below"}).find("--view below"), std::string::npos);
}

TEST(Options, OfARender) {
  const RenderOptions plain = std::get<RenderOptions>(parse({"render", "out"}));
  EXPECT_EQ(plain.run.scene, "out");
  EXPECT_TRUE(plain.file.empty());
  EXPECT_EQ(plain.picture, (Picture{ChartKind::rank, LightField::total}));
  EXPECT_FALSE(plain.chart_given);
  EXPECT_EQ(plain.simulating, "");
  const RenderOptions options = std::get<RenderOptions>(parse(
      {"render", "a.toml", "-o", "a.exr", "--chart", "rank-interval", "--field", "absorbed", "--seed", "3", "--error", "0.1"}));
  EXPECT_EQ(options.file, "a.exr");
  EXPECT_EQ(options.picture, (Picture{ChartKind::rank_interval, LightField::absorbed}));
  EXPECT_TRUE(options.chart_given);
  EXPECT_EQ(options.simulating, "--error");
  EXPECT_EQ(options.run.seed, 3U);
  EXPECT_EQ(options.run.direct_error, 0.1);
  EXPECT_NE(refusal({"render"}).find("scene"), std::string::npos);
  EXPECT_NE(refusal({"render", "out", "--json"}).find("--json"), std::string::npos);
}

TEST(Options, OfMorePicturesOfARun) {
  EXPECT_FALSE(parse_run({"run", "a.toml"}).extra_picture);
  EXPECT_EQ(parse_run({"run", "a.toml", "--field", "sky"}).extra_picture, (Picture{ChartKind::rank, LightField::sky}));
  EXPECT_EQ(parse_run({"run", "a.toml", "--chart", "map"}).extra_picture, (Picture{ChartKind::map, LightField::total}));
  EXPECT_EQ(parse_run({"run", "a.toml", "--images", "hue_sky,rank-interval_absorbed"}).images.size(), 2U);
  EXPECT_NE(refusal({"run", "a.toml", "--images", "none", "--chart", "map"}).find("--images none"), std::string::npos);
}

TEST(Pictures, HaveNamesOfTheirOwn) {
  std::set<std::string> stems;
  for (const Picture& picture : all_pictures()) stems.insert(stem_of(picture));
  EXPECT_EQ(stems.size(), 30U);
  const auto usual = [](bool any_direct, bool any_indirect) {
    std::vector<std::string> names;
    for (const Picture& picture : usual_pictures(any_direct, any_indirect)) names.push_back(stem_of(picture));
    return names;
  };
  EXPECT_EQ(usual(true, true), (std::vector<std::string>{"rank_direct", "rank_indirect", "rank_total", "hue_direct",
                                                         "hue_indirect", "hue_total"}));
  EXPECT_EQ(usual(true, false), (std::vector<std::string>{"rank_direct", "hue_direct"}));
  EXPECT_EQ(usual(false, true), (std::vector<std::string>{"rank_indirect", "rank_total", "hue_indirect", "hue_total"}));
}

TEST(Options, OfTheStand) {
  const MaizeOptions plain = std::get<MaizeOptions>(parse({"maize"}));
  EXPECT_EQ(plain.output, "maize.glb");
  EXPECT_EQ(plain.rows, 4);
  EXPECT_EQ(plain.per_row, 3);
  EXPECT_EQ(plain.spacing_m, (std::vector<double>{0.6, 0.6}));
  const std::vector<double> expected{0.3, 0.75};
  EXPECT_EQ(std::get<MaizeOptions>(parse({"maize", "--spacing", "0.3", "0.75"})).spacing_m, expected);
  EXPECT_EQ(std::get<MaizeOptions>(parse({"maize", "--spacing", "0.3,0.75"})).spacing_m, expected);
  const MaizeOptions options =
      std::get<MaizeOptions>(parse({"maize", "-o", "a.gltf", "--rows", "2", "--per-row", "5", "--seed", "9"}));
  EXPECT_EQ(options.output, "a.gltf");
  EXPECT_EQ(options.rows, 2);
  EXPECT_EQ(options.per_row, 5);
  EXPECT_EQ(options.seed, 9U);
}

TEST(Options, OfInfo) {
  EXPECT_TRUE(std::get<InfoOptions>(parse({"info"})).run.scene.empty());
  const InfoOptions options = std::get<InfoOptions>(parse({"info", "a.toml", "--json", "--allow-outside"}));
  EXPECT_EQ(options.run.scene, "a.toml");
  EXPECT_TRUE(options.run.json && options.run.allow_outside);
  const InfoOptions asked =
      std::get<InfoOptions>(parse({"info", "a.toml", "--error", "0.02", "--memory", "2GB", "--device", "cpu"}));
  EXPECT_EQ(asked.run.indirect_error, 0.02);
  EXPECT_EQ(asked.run.memory_bytes, 2'000'000'000U);
  EXPECT_EQ(asked.run.device, "cpu");
}

TEST(Options, OfInfoAboutMeshes) {
  const InfoOptions meshes = std::get<InfoOptions>(parse({"info", "a.obj", "b.PLY", "c.can", "--json"}));
  EXPECT_EQ(meshes.meshes.size(), 3U);
  EXPECT_TRUE(meshes.run.scene.empty());
  const InfoOptions stand = std::get<InfoOptions>(parse({"info", "a.can", "--optics", "par.opt", "--light", "a.light"}));
  EXPECT_TRUE(stand.meshes.empty());
  EXPECT_EQ(stand.run.scene, "a.can");
  EXPECT_NE(refusal({"info", "a.obj", "a.toml"}).find("one scene at a time"), std::string::npos);
}

TEST(Options, OfANewScene) {
  const NewOptions options = std::get<NewOptions>(parse({"new", "a.obj", "b.ply", "-o", "stand.toml", "--force"}));
  EXPECT_EQ(options.meshes, (std::vector<std::filesystem::path>{"a.obj", "b.ply"}));
  EXPECT_EQ(options.output, "stand.toml");
  EXPECT_TRUE(options.force);
  EXPECT_TRUE(std::get<NewOptions>(parse({"new", "a.obj"})).output.empty());
  EXPECT_NE(refusal({"new"}).find("meshes"), std::string::npos);
}

TEST(Options, HelpAndVersionAreTexts) {
  EXPECT_NE(std::get<TextToPrint>(parse({"--help"})).text.find("run"), std::string::npos);
  EXPECT_NE(std::get<TextToPrint>(parse({"run", "--help"})).text.find("--grid"), std::string::npos);
  EXPECT_EQ(std::get<TextToPrint>(parse({"--version"})).text, "sunfleck " + version() + "\n");
  EXPECT_EQ(std::get<TextToPrint>(parse({"run", "--version"})).text, "sunfleck " + version() + "\n");
}

TEST(Options, OfTheWindow) {
  const auto plain = std::get<ViewOptions>(parse({"view", "a.toml"}));
  EXPECT_EQ(plain.run.pictures.width, 1280);
  EXPECT_EQ(plain.run.pictures.height, 800);
  EXPECT_FALSE(plain.run.json);
  const auto options =
      std::get<ViewOptions>(parse({"view", "a.toml", "--size", "700x500", "--chart", "map", "--field", "scattered", "--range",
                                   "120", "--json", "--error", "0.02", "-o", "out", "--view", "top"}));
  EXPECT_EQ(options.run.pictures.height, 500);
  EXPECT_EQ(options.picture, (Picture{ChartKind::map, LightField::scattered}));
  EXPECT_EQ(options.run.pictures.top_w_m2, 120.0);
  EXPECT_EQ(options.run.pictures.view, ViewKind::top);
  EXPECT_EQ(options.run.direct_error, 0.02);
  EXPECT_EQ(options.run.output, "out");
  EXPECT_TRUE(options.run.json);
}

TEST(Options, OfCaribusFiles) {
  const auto run = std::get<RunOptions>(parse({"run", "a.can.gz", "--optics", "par.opt, NIR=b.opt", "--optics", "c.opt",
                                               "--light", "x.light", "--domain", "x.8", "--scale", "0.01", "--export", "csv"}));
  EXPECT_EQ(run.stand.optics, (std::vector<std::string>{"par.opt", "NIR=b.opt", "c.opt"}));
  EXPECT_EQ(run.stand.light, "x.light");
  EXPECT_EQ(run.stand.domain, "x.8");
  EXPECT_EQ(run.stand.scale, 0.01);
  EXPECT_EQ(run.exports, (std::vector<std::string>{"csv", "caribu"})) << "CARIBU's table is written for a .can";
  EXPECT_EQ(std::get<RunOptions>(parse({"run", "a.can", "--export", "caribu"})).exports, std::vector<std::string>{"caribu"});
  const auto plain = std::get<RunOptions>(parse({"run", "a.toml"}));
  EXPECT_TRUE(plain.exports.empty());
  EXPECT_EQ(plain.stand.first_given(), "");
  EXPECT_EQ(std::get<InfoOptions>(parse({"info", "a.can", "--light", "x.light"})).run.stand.first_given(), "--light");
  EXPECT_EQ(std::get<RenderOptions>(parse({"render", "out", "--domain", "x.8"})).simulating, "--domain");
  EXPECT_EQ(std::get<ViewOptions>(parse({"view", "a.can", "--scale", "2"})).run.stand.first_given(), "--scale");
  EXPECT_NE(refusal({"day", "a.can", "--optics", "a.opt"}).find("--optics (unknown option or argument)"), std::string::npos);
  const auto convert = std::get<ConvertOptions>(parse({"convert", "a.obj", "b.glb", "--z-up"}));
  EXPECT_EQ(convert.input, "a.obj");
  EXPECT_EQ(convert.output, "b.glb");
  EXPECT_TRUE(convert.z_up);
  EXPECT_NE(refusal({"convert", "a.obj"}).find("out"), std::string::npos);
}

TEST(Options, MistakesAreNamed) {
  EXPECT_EQ(refusal({"run", "a.toml", "--passes", "4"}),
            "command line: --passes 4 (must be a whole number in 8..65536); see sunfleck run --help");
  for (const std::string text : {"2%", "0,02", "2"}) {
    EXPECT_EQ(
        refusal({"run", "a.toml", "--error", text.c_str()}),
        "command line: --error " + text +
            " (must be a number between 0 and 1, with a decimal point: give 0.02 for 2 percent); see sunfleck run --help");
  }
  EXPECT_EQ(refusal({"run", "a.toml", "--seed"}), "command line: --seed (its value is missing); see sunfleck run --help");
  EXPECT_EQ(refusal({"run", "a.toml", "--seed", "1", "--seed", "2"}),
            "command line: --seed (given more than once); give it once");
  EXPECT_NE(refusal({"maize", "--spacing", "0.6"}).find("2 required"), std::string::npos);
  EXPECT_EQ(refusal({"run", "a.toml", "--passes", "a); b"}),
            "command line: --passes a); b (must be a whole number in 8..65536); see sunfleck run --help");
  EXPECT_EQ(refusal({"run", "a.toml", "--images", "rank_totl"}),
            "command line: --images rank_totl (unknown); did you mean rank_total?");
  EXPECT_EQ(refusal({"tradeoff", "a.toml", "--rays", "1"}),
            "command line: --rays 1 (must be a number in 1000..1000000000); see sunfleck tradeoff --help");
  EXPECT_EQ(refusal({"run", "a.toml", "--bogus"}),
            "command line: --bogus (unknown option or argument); see sunfleck run --help");
  EXPECT_EQ(refusal({"ran"}), "ran (unknown command); did you mean run?");
  EXPECT_EQ(refusal({"--quiet", "run", "a.toml"}),
            "command line: --quiet (an option before the command); put it behind the command");
  EXPECT_EQ(refusal({"--verison"}), "command line: --verison (unknown option); did you mean --version?");
  EXPECT_EQ(refusal({"--bogus"}), "command line: --bogus (unknown option); see sunfleck --help");
  EXPECT_EQ(refusal({"simulate"}),
            "simulate (unknown command); use run, day, render, view, validate, tradeoff, maize, convert, new or info; see "
            "sunfleck --help");
  EXPECT_EQ(refusal({}),
            "command line (no command); use run, day, render, view, validate, tradeoff, maize, convert, new or info; see "
            "sunfleck --help");
  EXPECT_EQ(refusal({"run", "a.toml", "--size", "3\nx"}),
            "--size 3?x (must be WIDTHxHEIGHT, each 64..8192); give 1600x1200, for example");
  for (const char* size : {"4294967360x4294967360", "64", "64x", "x64", "63x64", "64x8193", "64x64x64"})
    EXPECT_NE(refusal({"run", "a.toml", "--size", size}).find("each 64..8192"), std::string::npos) << size;
}

// Each warning names the option; options that have an effect cause none.
TEST(Options, WithoutEffectAreNamed) {
  const auto names_of = [](const RunOptions& options) {
    std::vector<std::string> names;
    for (const std::string& warning : options.without_effect) names.push_back(warning.substr(0, warning.find(' ')));
    return names;
  };
  const auto of_run = [&](std::initializer_list<const char*> words) { return names_of(parse_run(words)); };
  using Names = std::vector<std::string>;
  EXPECT_EQ(of_run({"run", "a.toml", "--images", "none", "--size", "80x80", "--compare", "b", "--band", "PAR"}),
            (Names{"--size", "--band", "--compare"}));
  EXPECT_EQ(of_run({"run", "a.toml", "--images", "hue_total", "--compare", "b", "--range", "9"}),
            (Names{"--range", "--compare"}));
  EXPECT_EQ(of_run({"run", "a.toml", "--images", "profile,planes", "--compare", "b", "--view", "top"}), Names{"--view"});
  EXPECT_EQ(of_run({"run", "a.toml", "--images", "profile,rank-log_total", "--compare", "b", "--range", "9"}), Names{});
  EXPECT_EQ(of_run({"run", "a.toml", "--images", "planes", "--chart", "map", "--range", "9"}), Names{});
  EXPECT_EQ(of_run({"run", "a.toml", "--range", "9", "--size", "80x80"}), Names{}) << "the soil of rank charts has a scale";

  const auto of_render = [&](std::initializer_list<const char*> words) {
    return names_of(std::get<RenderOptions>(parse(words)).run);
  };
  EXPECT_EQ(of_render({"render", "a.toml", "--chart", "hue", "--range", "9"}), Names{"--range"});
  EXPECT_EQ(of_render({"render", "a.toml", "-o", "a.exr", "--range", "9"}), Names{"--range"});
  EXPECT_EQ(of_render({"render", "a.toml", "--range", "9"}), Names{});

  const auto of_day = [&](std::initializer_list<const char*> words) {
    return names_of(std::get<DayOptions>(parse(words)).run);
  };
  EXPECT_EQ(of_day({"day", "a.toml", "--images", "season"}), Names{"--images"});
  EXPECT_EQ(of_day({"day", "a.toml", "--images", "season", "--to-date", "2002-08-09"}), Names{});
  EXPECT_EQ(of_day({"day", "a.toml", "--images", "none", "--band", "PAR"}), Names{"--band"});

  const auto of_info = [&](std::initializer_list<const char*> words) {
    return names_of(std::get<InfoOptions>(parse(words)).run);
  };
  EXPECT_EQ(of_info({"info", "a.obj", "--error", "0.1"}), Names{"--error"});
  EXPECT_EQ(of_info({"info", "a.toml", "--error", "0.1"}), Names{});
}

}  // namespace
}  // namespace sunfleck
