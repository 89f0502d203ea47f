#include "app/options.h"

#include "base/error.h"
#include "io/exports.h"
#include "io/file.h"
#include "version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace sunfleck {
namespace {

constexpr std::array commands_to_come{"view", "validate", "tradeoff", "convert"};

constexpr std::uint64_t most_plants = 10000;  // as in a scene file

// A bound given on the command line.
const CLI::Validator relative_error(
    [](const std::string& text) {
      double value = 0.0;
      const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && value < 1.0;
      return good ? std::string() : fmt::format("{} (must lie between 0 and 1)", text);
    },
    "0..1");

const CLI::Validator positive(
    [](const std::string& text) {
      double value = 0.0;
      const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value);
      return good ? std::string() : fmt::format("{} (must be a positive number)", text);
    },
    ">0");

const CLI::Validator not_empty(
    [](const std::string& text) { return text.empty() ? "\"\" (must not be empty)" : std::string(); }, "");

// Decimal digits, or a number like 1e6 that is whole and held exactly by a double.
std::optional<std::uint64_t> whole_number_of(const std::string& text) {
  const char* const end = text.data() + text.size();
  std::uint64_t whole = 0;
  const auto [whole_end, whole_error] = std::from_chars(text.data(), end, whole);
  if (whole_error == std::errc() && whole_end == end) return whole;
  double value = 0.0;
  const auto [value_end, value_error] = std::from_chars(text.data(), end, value);
  const bool exact = value >= 0.0 && value <= 9007199254740992.0 && value == std::floor(value);
  if (value_error != std::errc() || value_end != end || !exact) return std::nullopt;
  return static_cast<std::uint64_t>(value);
}

// Rewrites the number in digits: CLI11 alone would wrap -1 round and read 010 as octal.
CLI::Validator whole_number(std::uint64_t lo, std::uint64_t hi) {
  const std::string range = fmt::format("{}..{}", lo, hi);
  return {[=](std::string& text) {
            const std::optional<std::uint64_t> value = whole_number_of(text);
            if (!value || *value < lo || *value > hi) return fmt::format("{} (must be a whole number in {})", text, range);
            text = std::to_string(*value);
            return std::string();
          },
          range};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  const std::string list = fmt::format("{}", fmt::join(words, ", "));
  return {[=](const std::string& text) {
            const bool known = std::find(words.begin(), words.end(), text) != words.end();
            return known ? std::string() : fmt::format("{} (must be of: {})", text, list);
          },
          ""};
}

constexpr std::uint64_t most_seed = std::numeric_limits<std::uint64_t>::max();

void add_version(CLI::App& command) {
  command.set_version_flag("--version", "sunfleck " + version());
}

// What the command line has in words.
struct Words {
  std::optional<double> both_errors;
  std::string size = "1600x1200";
  std::string chart = "rank", field = "total", view = "camera";
};

std::string list_of(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

// What only a simulation needs.
void add_simulation(CLI::App& command, RunOptions& options, Words& words) {
  CLI::Option_group& group = *command.add_option_group("Simulation");
  group.add_option("--error", words.both_errors, "Relative error bound of both passes")->check(relative_error);
  group.add_option("--direct-error", options.direct_error, "Relative error bound of the direct pass")->check(relative_error);
  group.add_option("--indirect-error", options.indirect_error, "Relative error bound of the indirect pass")
      ->check(relative_error);
  group.add_option("--grid", options.grid_m, "Fixed work: spacing of all rays of the run together, m")->check(positive);
  group.add_option("--passes", options.passes, "Fixed work: exactly so many replicates")->transform(whole_number(8, 65536));
  group.add_option("--max-seconds", options.max_seconds, "Stop after so many seconds; results are kept")->check(positive);
  group.add_option("--max-rays", options.max_rays, "Stop before more rays than these; results are kept")
      ->transform(whole_number(1, std::uint64_t{1} << 62U));
  group.add_option("--seed", options.seed, "Seed of the random numbers")
      ->transform(whole_number(0, most_seed))
      ->capture_default_str();
  group.add_flag("--allow-outside", options.allow_outside, "Accept mesh files outside the scene's folder");
}

void add_device(CLI::App& command, RunOptions& options) {
  command.add_option("--device", options.device, "auto, gpu, lavapipe, cpu, a number or a part of a name")
      ->check(not_empty)
      ->capture_default_str();
  command.add_option("--threads", options.threads, "Threads of the CPU path and of software Vulkan (0: all cores)")
      ->transform(whole_number(0, 4096))
      ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "Say nothing but warnings and errors");
}

void add_pictures(CLI::App& command, PictureOptions& options, Words& words) {
  constexpr std::uint64_t most_repeat = 9;
  CLI::Option_group& group = *command.add_option_group("Pictures");
  group.add_option("--field", words.field, "Light that is shown: " + list_of(field_names()))
      ->check(one_of(field_names()))
      ->capture_default_str();
  group.add_option("--band", options.band, "Band of the pictures (default: the scene's first)")->check(not_empty);
  group
      .add_option("--chart", words.chart,
                  "Classes of equal count, of equal width, hue mapping or a continuous map: " + list_of(chart_names()))
      ->check(one_of(chart_names()))
      ->capture_default_str();
  group.add_option("--view", words.view, "The scene's camera, from above, from the south, upwards: " + list_of(view_names()))
      ->check(one_of(view_names()))
      ->capture_default_str();
  group.add_option("--size", words.size, "Size of the pictures in pixels, WxH")->capture_default_str();
  group.add_option("--samples", options.samples, "Samples a pixel")->transform(whole_number(1, 256))->capture_default_str();
  group.add_option("--repeat", options.repeat, "Show a periodic plot amidst its neighbours: so many along each side, odd")
      ->transform(whole_number(1, most_repeat))
      ->capture_default_str();
}

std::vector<std::string> image_words() {
  std::vector<std::string> words;
  for (const Picture& picture : all_pictures()) words.push_back(stem_of(picture));
  words.insert(words.end(), {"profile", "planes", "all", "none"});
  return words;
}

std::vector<std::string> export_words() {
  std::vector<std::string> words;
  for (const ExportKind kind : export_kinds) words.emplace_back(export_name(kind));
  return words;
}

void add_run(CLI::App& app, RunOptions& options, Words& words) {
  CLI::App& run = *app.add_subcommand("run", "Simulate a scene: result tables and pictures");
  add_version(run);
  run.add_option("scene", options.scene, "Scene file (TOML)")->required()->check(not_empty);
  run.add_option("-o,--output", options.output, "Result folder (default: results/<scene>)")->check(not_empty);
  run.add_option("--export", options.exports, "Values of every triangle for other programs: " + list_of(export_words()))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of(export_words()));
  run.add_option("--measured", options.measured, "Field data (CSV: height_m, sunfleck_ratio), drawn in profile.png")
      ->check(not_empty);
  run.add_option("--compare", options.compare, "Folder of an earlier result, drawn beside this one in profile.png")
      ->allow_extra_args(false)
      ->check(not_empty);
  run.add_option("--images", options.images,
                 "Pictures: CHART_FIELD, ...; profile, planes; all (these two, and rank and hue of direct, indirect and total) "
                 "or none")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of(image_words()))
      ->capture_default_str();
  run.add_flag("--json", options.json, "Print the summary on standard output, nothing else");
  add_device(run, options);
  add_simulation(run, options, words);
  add_pictures(run, options.pictures, words);
}

void add_day(CLI::App& app, DayOptions& options, Words& words) {
  CLI::App& day = *app.add_subcommand("day", "The course of a day or several (--max-seconds: of all, --max-rays: of a step)");
  add_version(day);
  day.add_option("scene", options.run.scene, "Scene file (TOML) with a place and weather")->required()->check(not_empty);
  day.add_option("-o,--output", options.run.output, "Result folder (default: results/<scene>)")->check(not_empty);
  day.add_option("--from", options.from, "First step's start, local time HH:MM (default: sunrise)")->check(not_empty);
  day.add_option("--to", options.to, "Last step's end (default: sunset); a shorter last step ends there too")->check(not_empty);
  day.add_option("--step", options.step_min, "Minutes; a step has the light of its middle (default: 60)")
      ->transform(whole_number(1, 1440));
  day.add_option("--date", options.date, "YYYY-MM-DD (default: the date in the scene's [sun])")->check(not_empty);
  day.add_option("--to-date", options.to_date, "Last of several dates, each with the same hours")->check(not_empty);
  day.add_flag("--resume", options.resume, "Go on with a day that was stopped; its finished steps are kept");
  day.add_option("--export", options.run.exports, "nc: day.nc, which is written always")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"nc"}));
  day.add_option("--images", options.run.images, "day (the course of the day), none or all (default)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"day", "all", "none"}));
  day.add_option("--band", options.run.pictures.band, "Band of the picture (default: the scene's first)")->check(not_empty);
  day.add_flag("--json", options.run.json, "Print the summary on standard output, nothing else");
  add_device(day, options.run);
  add_simulation(day, options.run, words);
}

void add_render(CLI::App& app, RenderOptions& options, Words& words) {
  CLI::App& render = *app.add_subcommand("render", "Draw one picture of a scene, or of a finished run's folder");
  add_version(render);
  render.add_option("scene", options.run.scene, "Scene file (TOML), or the folder of a finished run")
      ->required()
      ->check(not_empty);
  render.add_option("-o,--output", options.file, "Picture, .png, or .exr for the values themselves")->check(not_empty);
  add_device(render, options.run);
  add_simulation(render, options.run, words);
  add_pictures(render, options.run.pictures, words);
}

void add_maize(CLI::App& app, MaizeOptions& options) {
  CLI::App& maize = *app.add_subcommand("maize", "Write a parametric maize stand as glTF");
  add_version(maize);
  maize.add_option("-o,--output", options.output, "File, .glb or .gltf")->check(not_empty)->capture_default_str();
  maize.add_option("--rows", options.rows, "Lines of plants, along X")
      ->transform(whole_number(1, most_plants))
      ->capture_default_str();
  maize.add_option("--per-row", options.per_row, "Plants in each")
      ->transform(whole_number(1, most_plants))
      ->capture_default_str();
  maize.add_option("--spacing", options.spacing_m, "Along the row and between rows, m")
      ->expected(2)
      ->delimiter(',')
      ->check(positive)
      ->capture_default_str();
  maize.add_option("--seed", options.seed, "Seed of the plants' differences")
      ->transform(whole_number(0, most_seed))
      ->capture_default_str();
}

void add_info(CLI::App& app, InfoOptions& options) {
  CLI::App& info = *app.add_subcommand("info", "Show the devices, and what a scene holds");
  add_version(info);
  info.add_option("scene", options.scene, "Scene file (TOML)")->check(not_empty);
  info.add_flag("--allow-outside", options.allow_outside, "Accept mesh files outside the scene's folder");
  info.add_flag("--json", options.json, "Print JSON");
}

void read_size(const std::string& size, PictureOptions& options) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(size.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 || height < 64 || width > 8192 ||
      height > 8192) {
    throw_input(fmt::format("--size {}", printable(size)), "must be WIDTHxHEIGHT, each 64..8192",
                "give 1600x1200, for example");
  }
  options.width = width;
  options.height = height;
}

template <class Choice>
Choice choice_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Choice>(std::find(names.begin(), names.end(), name) - names.begin());
}

Picture read_picture(const Words& words) {
  return {choice_of<ChartKind>(chart_names(), words.chart), choice_of<LightField>(field_names(), words.field)};
}

void read_pictures(const Words& words, PictureOptions& options) {
  read_size(words.size, options);
  options.view = choice_of<ViewKind>(view_names(), words.view);
  if (options.repeat % 2 == 0) {
    throw_input(fmt::format("--repeat {}", options.repeat), "must be odd: the plot stands in the middle of its copies",
                fmt::format("give {}", options.repeat + 1));
  }
}

void read_errors(const Words& words, RunOptions& options) {
  if (!options.direct_error) options.direct_error = words.both_errors;
  if (!options.indirect_error) options.indirect_error = words.both_errors;
}

void check_images(const RunOptions& options) {
  const bool none = std::find(options.images.begin(), options.images.end(), "none") != options.images.end();
  if (!none || (options.images.size() == 1 && !options.extra_picture)) return;
  throw_input(fmt::format("--images {}", fmt::join(options.images, ",")),
              "none stands alone, without other pictures, --chart and --field", "leave none out, or the others");
}

RunOptions finished(RunOptions options, const Words& words, const CLI::App& command) {
  read_errors(words, options);
  read_pictures(words, options.pictures);
  if (command.count("--chart") + command.count("--field") > 0) options.extra_picture = read_picture(words);
  check_images(options);
  return options;
}

DayOptions finished(DayOptions options, const Words& words) {
  read_errors(words, options.run);
  check_images(options.run);
  return options;
}

RenderOptions finished(RenderOptions options, const Words& words, const CLI::App& command) {
  read_errors(words, options.run);
  read_pictures(words, options.run.pictures);
  options.picture = read_picture(words);
  options.chart_given = command.count("--chart") > 0;
  for (const char* name : {"--error", "--direct-error", "--indirect-error", "--grid", "--passes", "--max-seconds", "--max-rays",
                           "--seed", "--allow-outside"}) {
    if (options.simulating.empty() && command.count(name) > 0) options.simulating = name;
  }
  return options;
}

void check_stand(const MaizeOptions& options) {
  const std::uint64_t plants = static_cast<std::uint64_t>(options.rows) * static_cast<std::uint64_t>(options.per_row);
  if (plants <= most_plants) return;
  throw_input(fmt::format("--rows {} --per-row {}", options.rows, options.per_row),
              fmt::format("{} plants, at most {} are possible", plants, most_plants),
              "give fewer; a periodic plot repeats them without end");
}

// CLI11's message in three parts. Its own checks say `OPTION: what is wrong`, ours `OPTION: VALUE (why)`.
[[noreturn]] void throw_usage(const CLI::ParseError& error, const CLI::App& app, int argc, const char* const* argv) {
  const std::string first = argc > 1 ? printable(argv[1]) : "";
  if (std::find(commands_to_come.begin(), commands_to_come.end(), first) != commands_to_come.end()) {
    throw_input(first, fmt::format("not in version {} yet", version()), "use run, day, render, maize or info");
  }
  const auto chosen = app.get_subcommands();
  if (chosen.empty() && (first.empty() || first[0] != '-')) {
    throw_input(first.empty() ? "command line" : first, first.empty() ? "no command" : "no command of this program",
                "use run, day, render, maize or info; see sunfleck --help");
  }
  const std::string cure = fmt::format("see sunfleck {}--help", chosen.empty() ? "" : chosen.front()->get_name() + " ");
  const std::vector<std::string> unknown = app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !unknown.empty()) {
    throw_input("command line: " + printable(unknown.front()), "not known here", cure);
  }
  const std::string what = printable(error.what());
  const std::size_t colon = what.find(": ");
  if (colon == std::string::npos) throw_input("command line", what, cure);
  const std::string option = what.substr(0, colon);
  const std::string rest = what.substr(colon + 2);
  if (rest.back() == ')') throw Error(ErrorKind::input, fmt::format("command line: {} {}; {}", option, rest, cure));
  throw_input("command line: " + option, rest, cure);
}

}  // namespace

std::string version() {
  return SUNFLECK_VERSION;
}

std::string commit() {
  return SUNFLECK_COMMIT;
}

Command parse_command_line(int argc, const char* const* argv) {
  CLI::App app("sunfleck: how sunlight spreads in three-dimensional plant canopies", "sunfleck");
  add_version(app);
  app.require_subcommand(1);
  RunOptions run;
  DayOptions day;
  MaizeOptions maize;
  InfoOptions info;
  RenderOptions render;
  Words words;
  add_run(app, run, words);
  add_day(app, day, words);
  add_render(app, render, words);
  add_maize(app, maize);
  add_info(app, info);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    return TextToPrint{"sunfleck " + version() + "\n"};
  } catch (const CLI::Success&) {  // --help of the program or of a command
    return TextToPrint{app.help()};
  } catch (const CLI::ParseError& error) {
    throw_usage(error, app, argc, argv);
  }
  if (app.got_subcommand("maize")) {
    check_stand(maize);
    return maize;
  }
  if (app.got_subcommand("info")) return info;
  if (app.got_subcommand("day")) return finished(day, words);
  if (app.got_subcommand("render")) return finished(render, words, *app.get_subcommand("render"));
  return finished(run, words, *app.get_subcommand("run"));
}

}  // namespace sunfleck
