#include "app/options.h"

#include "base/error.h"
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

constexpr std::array commands_to_come{"day", "render", "view", "validate", "tradeoff", "convert"};

constexpr std::uint64_t most_plants = 10000;  // as in a scene file

constexpr std::int64_t most_samples = std::int64_t{1} << 28U;  // of a picture: some 4 GiB

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

void add_run(CLI::App& app, RunOptions& options, std::optional<double>& both, std::string& size) {
  CLI::App& run = *app.add_subcommand("run", "Simulate a scene: result tables and pictures");
  add_version(run);
  run.add_option("scene", options.scene, "Scene file (TOML)")->required()->check(not_empty);
  run.add_option("-o,--output", options.output, "Result folder (default: results/<scene>)")->check(not_empty);
  run.add_option("--device", options.device, "auto, gpu, lavapipe, cpu, a number or a part of a name")
      ->check(not_empty)
      ->capture_default_str();
  run.add_option("--error", both, "Relative error bound of both passes")->check(relative_error);
  run.add_option("--direct-error", options.direct_error, "Relative error bound of the direct pass")->check(relative_error);
  run.add_option("--indirect-error", options.indirect_error, "Relative error bound of the indirect pass")
      ->check(relative_error);
  run.add_option("--grid", options.grid_m, "Fixed work: spacing of all rays of the run together, m")->check(positive);
  run.add_option("--passes", options.passes, "Fixed work: exactly so many replicates")->transform(whole_number(8, 65536));
  run.add_option("--max-seconds", options.max_seconds, "Stop after so many seconds; results are kept")->check(positive);
  run.add_option("--max-rays", options.max_rays, "Stop before more rays than these; results are kept")
      ->transform(whole_number(1, std::uint64_t{1} << 62U));
  run.add_option("--seed", options.seed, "Seed of the random numbers")
      ->transform(whole_number(0, most_seed))
      ->capture_default_str();
  run.add_option("--threads", options.threads, "Threads of the CPU path and of software Vulkan (0: all cores)")
      ->transform(whole_number(0, 4096))
      ->capture_default_str();
  run.add_option("--export", options.exports, "Further files: csv")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"csv"}));
  run.add_option("--images", options.images, "Pictures: rank_direct, rank_indirect, rank_total, all or none")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"rank_direct", "rank_indirect", "rank_total", "all", "none"}))
      ->capture_default_str();
  run.add_option("--band", options.band, "Band of the pictures (default: the scene's first)");
  run.add_option("--size", size, "Size of the pictures in pixels, WxH")->capture_default_str();
  run.add_option("--samples", options.samples, "Samples a pixel")->transform(whole_number(1, 256))->capture_default_str();
  run.add_flag("--allow-outside", options.allow_outside, "Accept mesh files outside the scene's folder");
  run.add_flag("--quiet", options.quiet, "Say nothing but warnings and errors");
  run.add_flag("--json", options.json, "Print the summary on standard output, nothing else");
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

void read_size(const std::string& size, RunOptions& options) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(size.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 || height < 64 || width > 8192 ||
      height > 8192) {
    throw_input(fmt::format("--size {}", printable(size)), "must be WIDTHxHEIGHT, each 64..8192",
                "give 1600x1200, for example");
  }
  const std::int64_t samples = std::int64_t{width} * height * options.samples;
  if (samples > most_samples) {
    throw_input(fmt::format("--size {} --samples {}", size, options.samples),
                fmt::format("{} samples, at most {} are possible", samples, most_samples),
                "give a smaller size or fewer samples");
  }
  options.width = width;
  options.height = height;
}

void check_images(const RunOptions& options) {
  const bool none = std::find(options.images.begin(), options.images.end(), "none") != options.images.end();
  if (!none || options.images.size() == 1) return;
  throw_input(fmt::format("--images {}", fmt::join(options.images, ",")), "none stands alone", "leave none out, or the others");
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
    throw_input(first, fmt::format("not in version {} yet", version()), "use run, maize or info");
  }
  const auto chosen = app.get_subcommands();
  if (chosen.empty() && (first.empty() || first[0] != '-')) {
    throw_input(first.empty() ? "command line" : first, first.empty() ? "no command" : "no command of this program",
                "use run, maize or info; see sunfleck --help");
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
  MaizeOptions maize;
  InfoOptions info;
  std::optional<double> both;
  std::string size = "1600x1200";
  add_run(app, run, both, size);
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
  read_size(size, run);
  check_images(run);
  if (!run.direct_error) run.direct_error = both;
  if (!run.indirect_error) run.indirect_error = both;
  return run;
}

}  // namespace sunfleck
