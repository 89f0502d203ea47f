#include "programs/cli/options.h"

#include "base/error.h"
#include "base/file.h"
#include "base/suggestions.h"
#include "base/text_reader.h"
#include "base/version.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/results/exports/exports.h"
#include "physics/canopy/maize.h"
#include "programs/cli/option_groups.h"
#include "simulate/result_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>

namespace sunfleck {
namespace {

constexpr int usual_window_width = 1280;
constexpr int usual_window_height = 800;

void read_size(const std::string& size, PictureOptions& options) {
  const std::size_t cross = std::min(size.find('x'), size.size());
  const auto width = parse_integer(std::string_view(size).substr(0, cross));
  const auto height = parse_integer(std::string_view(size).substr(std::min(cross + 1, size.size())));
  const auto fits = [](const std::optional<std::int64_t>& side) { return side && *side >= 64 && *side <= 8192; };
  if (!fits(width) || !fits(height)) {
    throw_input(fmt::format("--size {}", printable(size)), "must be WIDTHxHEIGHT, each 64..8192",
                "give 1600x1200, for example");
  }
  options.width = static_cast<int>(*width);
  options.height = static_cast<int>(*height);
}

template <class Choice>
Choice choice_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Choice>(std::find(names.begin(), names.end(), name) - names.begin());
}

Picture read_picture(const OptionWords& words) {
  return {choice_of<ChartKind>(chart_names(), words.chart), choice_of<LightField>(field_names(), words.field)};
}

void read_pictures(const OptionWords& words, PictureOptions& options) {
  read_size(words.size, options);
  options.view = choice_of<ViewKind>(view_names(), words.view);
  if (options.repeat && *options.repeat % 2 == 0) {
    throw_input(fmt::format("--repeat {}", *options.repeat), "must be odd: the plot is in the middle of its copies",
                fmt::format("give {}", *options.repeat + 1));
  }
}

void read_errors(const OptionWords& words, RunOptions& options) {
  if (!options.direct_error) options.direct_error = words.both_errors;
  if (!options.indirect_error) options.indirect_error = words.both_errors;
}

void check_images(const RunOptions& options) {
  if (!holds(options.images, "none") || (options.images.size() == 1 && !options.extra_picture)) return;
  throw_input(fmt::format("--images {}", fmt::join(options.images, ",")),
              "none cannot be combined with other pictures, --chart or --field", "remove either none or the others");
}

// Adds the table that CARIBU's users expect.
void add_caribu_table(RunOptions& options) {
  const std::string table = export_name(ExportKind::caribu);
  if (is_can_file(options.scene) && !holds(options.exports, table)) options.exports.push_back(table);
}

// Warns of each of the options that was given, but changes nothing.
void warn_without_effect(const CLI::App& command, std::initializer_list<const char*> names, const std::string& why,
                         RunOptions& options) {
  for (const char* name : names) {
    if (command.count(name) > 0) options.without_effect.push_back(fmt::format("{} has no effect: {}", name, why));
  }
}

bool draws_any(const RunOptions& options, const std::function<bool(const Picture&)>& is_meant) {
  if (options.extra_picture && is_meant(*options.extra_picture)) return true;
  const std::vector<Picture> pictures = all_pictures();
  return std::any_of(pictures.begin(), pictures.end(), [&](const Picture& picture) {
    return is_meant(picture) && (holds(options.images, "all") || holds(options.images, stem_of(picture)));
  });
}

constexpr const char* no_upper_end = "the scale of a hue chart has no upper end to choose; give --chart map, for example";

void warn_of_pictures_not_drawn(const CLI::App& command, RunOptions& options) {
  if (!draws_any(options, [](const Picture&) { return true; })) {
    warn_without_effect(command, {"--view", "--range", "--size", "--samples", "--repeat"},
                        "no picture of the stand is among the --images", options);
  } else if (!draws_any(options, [](const Picture& picture) { return has_top(picture.chart); })) {
    warn_without_effect(command, {"--range"}, no_upper_end, options);
  }
  if (holds(options.images, "none")) warn_without_effect(command, {"--band"}, "--images none draws no picture", options);
  if (!holds(options.images, "all") && !holds(options.images, "profile")) {
    warn_without_effect(command, {"--compare"}, "profile.png is not among the --images", options);
  }
}

RunOptions finished(RunOptions options, const OptionWords& words, const CLI::App& command) {
  add_caribu_table(options);
  read_errors(words, options);
  read_pictures(words, options.pictures);
  if (command.count("--chart") + command.count("--field") > 0) options.extra_picture = read_picture(words);
  check_images(options);
  warn_of_pictures_not_drawn(command, options);
  options.triangle_light = shows_triangles(options);
  return options;
}

DayOptions finished(DayOptions options, const OptionWords& words, const CLI::App& command) {
  read_errors(words, options.run);
  check_images(options.run);
  if (holds(options.run.exports, "none") && holds(options.run.exports, "nc"))
    throw_input("--export nc,none", "none cannot be combined with nc", "remove one of them");
  if (holds(options.run.images, "none"))
    warn_without_effect(command, {"--band"}, "--images none draws no picture", options.run);
  if (options.to_date.empty() && options.run.images == std::vector<std::string>{"season"}) {
    options.run.without_effect.emplace_back("--images season draws nothing for a single date; give --to-date, or --images day");
  }
  return options;
}

// Sorts the files that `info` was given into one scene or meshes. CARIBU's files make a scene of a mesh.
void sort_files(InfoOptions& options) {
  std::vector<std::filesystem::path>& files = options.meshes;
  const bool all_meshes = std::all_of(files.begin(), files.end(), is_mesh_file);
  if (all_meshes && options.run.stand.first_given().empty()) return;
  if (files.size() > 1) {
    throw_input(fmt::format("info: {} files", files.size()), "only meshes can be described together",
                "give one scene at a time");
  }
  options.run.scene = files.front();
  files.clear();
}

InfoOptions finished(InfoOptions options, const OptionWords& words, const CLI::App& command) {
  if (!options.meshes.empty()) sort_files(options);
  const std::string no_run = options.meshes.empty() ? "no scene is given" : "meshes are described without a run";
  if (options.run.scene.empty()) {
    warn_without_effect(command, {"--error", "--direct-error", "--indirect-error", "--grid", "--passes", "--memory"}, no_run,
                        options.run);
  }
  read_errors(words, options.run);
  add_caribu_table(options.run);
  options.run.triangle_light = shows_triangles(options.run);
  return options;
}

RenderOptions finished(RenderOptions options, const OptionWords& words, const CLI::App& command) {
  read_errors(words, options.run);
  read_pictures(words, options.run.pictures);
  options.picture = read_picture(words);
  options.run.triangle_light = true;
  options.chart_given = command.count("--chart") > 0;
  if (options.file.extension() == ".exr") {
    warn_without_effect(command, {"--range"}, "an .exr file contains values, not colours", options.run);
  } else if (!has_top(options.picture.chart)) {
    warn_without_effect(command, {"--range"}, no_upper_end, options.run);
  }
  for (const char* name : {"--error", "--direct-error", "--indirect-error", "--grid", "--passes", "--max-seconds", "--max-rays",
                           "--memory", "--seed", "--allow-outside", "--optics", "--light", "--domain", "--scale"}) {
    if (options.simulating.empty() && command.count(name) > 0) options.simulating = name;
  }
  return options;
}

ViewOptions finished(ViewOptions options, const OptionWords& words, const CLI::App& command) {
  read_errors(words, options.run);
  read_pictures(words, options.run.pictures);
  if (command.count("--size") == 0) {
    options.run.pictures.width = usual_window_width;
    options.run.pictures.height = usual_window_height;
  }
  options.picture = read_picture(words);
  return options;
}

void check_stand(const MaizeOptions& options) {
  const std::uint64_t plants = static_cast<std::uint64_t>(options.rows) * static_cast<std::uint64_t>(options.per_row);
  if (plants <= most_maize_plants) return;
  throw_input(fmt::format("--rows {} --per-row {}", options.rows, options.per_row),
              fmt::format("{} plants; at most {} are allowed", plants, most_maize_plants),
              "give fewer; a periodic plot repeats them without end");
}

// Adds the names of all options of a command and of the groups in it.
void add_option_names(const CLI::App& command, std::vector<std::string>& names) {
  for (const CLI::Option* option : command.get_options([](const CLI::Option*) { return true; })) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const CLI::App* group : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (group->get_name().empty()) add_option_names(*group, names);
  }
}

// Returns the nearest option of a command as a question, or `otherwise`.
std::string nearest_option(const std::string& unknown, const CLI::App& command, const std::string& otherwise) {
  std::vector<std::string> known;
  add_option_names(command, known);
  return did_you_mean(unknown.substr(0, unknown.find('=')), known, otherwise);
}

// Rethrows CLI11's message in three parts. Messages of its own checks read `OPTION: what is wrong`, those of ours `OPTION:
// VALUE (why)` with or without what would be right.
[[noreturn]] void throw_usage(const CLI::ParseError& error, const CLI::App& app, int argc, const char* const* argv) {
  const std::string first = argc > 1 ? printable(argv[1]) : "";
  const auto chosen = app.get_subcommands();
  if (chosen.empty() && !first.empty() && first[0] == '-') {
    throw_input("command line: " + first, "unknown option", nearest_option(first, app, "see sunfleck --help"));
  }
  if (chosen.empty()) {
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
      commands.push_back(command->get_name());
    }
    if (const auto nearest = nearest_word(first, commands)) {
      throw_input(first, "unknown command", fmt::format("did you mean {}?", *nearest));
    }
    throw_input(first.empty() ? "command line" : first, first.empty() ? "no command" : "unknown command",
                "use run, day, render, view, validate, tradeoff, maize, convert, new or info; see sunfleck --help");
  }
  const CLI::App& command = *chosen.front();
  const std::string cure = fmt::format("see sunfleck {} --help", command.get_name());
  const std::vector<std::string> unknown = app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !unknown.empty()) {
    const std::string word = printable(unknown.front());
    if (word == first && first[0] == '-')
      throw_input("command line: " + word, "an option before the command", "put it behind the command");
    throw_input("command line: " + word, "unknown option or argument", nearest_option(unknown.front(), command, cure));
  }
  const std::string what = printable(error.what());
  const std::size_t colon = what.find(": ");
  if (colon == std::string::npos) throw_input("command line", what, cure);
  const std::string option = what.substr(0, colon);
  const std::string rest = what.substr(colon + 2);
  if (rest.starts_with("1 required ")) throw_input("command line: " + option, "its value is missing", cure);
  if (rest.starts_with("At Most 1 ")) throw_input("command line: " + option, "given more than once", "give it once");
  if (rest.back() == ')') throw Error(ErrorKind::input, fmt::format("command line: {} {}; {}", option, rest, cure));
  if (rest.find("); ") != std::string::npos) throw Error(ErrorKind::input, fmt::format("command line: {} {}", option, rest));
  throw_input("command line: " + option, rest, cure);
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  CLI::App app("sunfleck: how sunlight spreads in three-dimensional plant canopies", "sunfleck");
  add_version(app);
  app.require_subcommand(1);
  RunOptions run;
  DayOptions day;
  MaizeOptions maize;
  ConvertOptions convert;
  InfoOptions info;
  NewOptions new_scene;
  RenderOptions render;
  ViewOptions view;
  ValidateOptions validate;
  TradeoffOptions tradeoff;
  OptionWords words;
  add_run(app, run, words);
  add_day(app, day, words);
  add_render(app, render, words);
  add_view(app, view, words);
  add_validate(app, validate);
  add_tradeoff(app, tradeoff);
  add_maize(app, maize);
  add_convert(app, convert);
  add_new(app, new_scene);
  add_info(app, info, words);
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
  if (app.got_subcommand("convert")) return convert;
  if (app.got_subcommand("new")) return new_scene;
  if (app.got_subcommand("info")) return finished(info, words, *app.get_subcommand("info"));
  if (app.got_subcommand("validate")) return validate;
  if (app.got_subcommand("tradeoff")) return tradeoff;
  if (app.got_subcommand("day")) return finished(day, words, *app.get_subcommand("day"));
  if (app.got_subcommand("view")) return finished(view, words, *app.get_subcommand("view"));
  if (app.got_subcommand("render")) return finished(render, words, *app.get_subcommand("render"));
  return finished(run, words, *app.get_subcommand("run"));
}

}  // namespace sunfleck
