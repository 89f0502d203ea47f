#include "programs/cli/option_groups.h"

#include "base/version.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/formats/mesh/organ_split.h"
#include "files/results/exports/exports.h"
#include "physics/canopy/maize.h"
#include "programs/cli/option_checks.h"
#include "simulate/day_blocks.h"
#include "simulate/result_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

namespace sunfleck {
namespace {

constexpr std::uint64_t most_seed = std::numeric_limits<std::uint64_t>::max();

std::string list_of(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

CLI::App& add_command(CLI::App& app, const char* name, const std::string& meaning) {
  CLI::App& command = *app.add_subcommand(name, meaning);
  add_version(command);
  return command;
}

// Add a text that may not be empty, such as the name of a file: an argument that must be given, or an option.
template <class Value>
void add_argument(CLI::App& command, const char* name, Value& value, const std::string& meaning) {
  command.add_option(name, value, meaning)->required()->check(not_empty());
}
template <class Value>
void add_word(CLI::App& command, const char* name, Value& value, const std::string& meaning) {
  command.add_option(name, value, meaning)->check(not_empty());
}

// Adds a whole number in lo..hi whose value so far is the default that the help shows.
template <class Number>
void add_number(CLI::App& command, const char* name, Number& value, const char* meaning, std::uint64_t lo, std::uint64_t hi) {
  command.add_option(name, value, meaning)->transform(whole_number(lo, hi))->capture_default_str();
}

// Adds a word that must be one of a list, which the help shows with the default.
void add_choice(CLI::App& command, const char* name, std::string& value, const std::string& meaning,
                const std::vector<std::string>& words) {
  command.add_option(name, value, meaning + list_of(words))->check(one_of(words))->capture_default_str();
}

// Makes an option take one word: values separated by commas.
CLI::Option* listed(CLI::Option* option) {
  return option->delimiter(',')->allow_extra_args(false)->transform(without_blanks());
}

void add_bounds(CLI::Option_group& group, RunOptions& options, OptionWords& words) {
  group.add_option("--error", words.both_errors, "Relative error bound of both passes")->check(relative_error());
  group.add_option("--direct-error", options.direct_error, "Relative error bound of the direct pass")->check(relative_error());
  group.add_option("--indirect-error", options.indirect_error, "Relative error bound of the indirect pass")
      ->check(relative_error());
}

void add_fixed_work(CLI::Option_group& group, RunOptions& options) {
  group.add_option("--grid", options.grid_m, "Fixed work: grid spacing of all rays of the run, m")->check(positive());
  group.add_option("--passes", options.passes, "Fixed work: exactly this many replicates")->transform(whole_number(8, 65536));
}

void add_memory(CLI::Option_group& group, RunOptions& options,
                const char* use = "replicates in progress, e.g. 500MB or 2GB (default: a quarter of the free memory)") {
  group.add_option("--memory", options.memory_bytes, fmt::format("Memory for {}", use))->transform(memory_size());
}

// Adds the options that only a simulation needs.
CLI::Option_group& add_simulation(CLI::App& command, RunOptions& options, OptionWords& words) {
  CLI::Option_group& group = *command.add_option_group("Simulation");
  add_bounds(group, options, words);
  add_fixed_work(group, options);
  group.add_option("--max-seconds", options.max_seconds, "Stop after this many seconds; results are kept")->check(positive());
  group
      .add_option("--max-rays", options.max_rays,
                  "Stop before exceeding this many rays and packets, after eight small replicates at least; results are kept")
      ->transform(whole_number(1, std::uint64_t{1} << 62U));
  add_number(group, "--seed", options.seed, "Random seed", 0, most_seed);
  group.add_flag("--allow-outside", options.allow_outside, "Accept files outside the scene's folder");
  return group;
}

void add_stand(CLI::App& command, StandFiles& stand) {
  CLI::Option_group& group = *command.add_option_group("A mesh with CARIBU's files instead of a scene");
  listed(
      group.add_option(
          "--optics", stand.optics,
          "Optical properties (.opt), one file per band: par.opt,nir.opt give the bands PAR and NIR; NAME=FILE names a band"))
      ->check(not_empty());
  add_word(group, "--light", stand.light, "Light (.light): one direction is the sun, several are a sky");
  add_word(group, "--domain", stand.domain, "Plot (.8) that repeats without end (default: an isolated stand)");
  group.add_option("--scale", stand.scale, "Metres per unit of the mesh and the domain: 0.01 for centimetres (default: 1)")
      ->check(positive());
}

template <class Options>
void add_device(CLI::App& command, Options& options) {
  command
      .add_option("--device", options.device,
                  "auto (a GPU if there is one, else cpu), gpu, lavapipe, cpu, a device number or part of a device name")
      ->transform(device_kind())
      ->check(not_empty())
      ->capture_default_str();
  add_number(command, "--threads", options.threads, "Threads for the CPU path and software Vulkan (0: all cores)", 0, 4096);
  command.add_flag("--quiet", options.quiet, "Print only warnings and errors");
}

void add_pictures(CLI::App& command, PictureOptions& options, OptionWords& words) {
  constexpr std::uint64_t most_repeat = 9;
  CLI::Option_group& group = *command.add_option_group("Pictures");
  add_choice(group, "--field", words.field, "Light to show: ", field_names());
  add_word(group, "--band", options.band, "Waveband to show (default: the scene's first)");
  add_choice(group, "--chart", words.chart,
             "Five classes (equal leaf area, width or ratio), hue mapping or a continuous map: ", chart_names());
  add_choice(group, "--view", words.view, "The scene's camera, from above, from the south or upwards: ", view_names());
  group
      .add_option(
          "--range", options.top_w_m2,
          "Upper end of the scale of rank-interval, rank-log and map, and of the soil in rank charts, W m-2 (default: close to "
          "the largest value)")
      ->check(positive());
  group.add_option("--size", words.size, "Picture size in pixels, WxH")->capture_default_str();
  add_number(group, "--samples", options.samples, "Samples per pixel", 1, 256);
  group
      .add_option("--repeat", options.repeat,
                  "Show N x N copies of a periodic plot, N odd (default: 1; enough for a horizon in a view upwards)")
      ->transform(whole_number(1, most_repeat));
}

std::vector<std::string> export_words() {
  std::vector<std::string> words;
  for (const ExportKind kind : export_kinds) words.emplace_back(export_name(kind));
  return words;
}

}  // namespace

void add_version(CLI::App& command) {
  command.set_version_flag("--version", "sunfleck " + version());
}

void add_run(CLI::App& app, RunOptions& options, OptionWords& words) {
  CLI::App& run = add_command(app, "run", "Simulate a scene and write result tables and pictures (also under mpirun)");
  add_argument(run, "scene", options.scene, "Scene file (TOML), or a .can with CARIBU's files");
  add_word(run, "-o,--output", options.output, "Result folder (default: results/<scene>)");
  listed(run.add_option("--export", options.exports,
                        "Per-triangle values for other programs, separated by commas: " + list_of(export_words()) +
                            " (always for a .can)"))
      ->check(one_of(export_words()));
  add_word(run, "--measured", options.measured, "Field data (CSV: height_m, sunfleck_ratio), drawn in profile.png");
  run.add_option("--compare", options.compare, "Folder of an earlier result to draw beside this one in profile.png")
      ->allow_extra_args(false)
      ->check(not_empty());
  listed(run.add_option(
             "--images", options.images,
             "Pictures, separated by commas: CHART_FIELD, ...; profile; planes; all (profile, planes, and rank and hue of "
             "direct, indirect and total) or none"))
      ->check(one_of(image_words()))
      ->capture_default_str();
  run.add_flag(
      "--resume", options.resume,
      "Resume a stopped or killed run from its last saved replicate, or start it; with --max-seconds, give it from the "
      "first run on, so that the work does not depend on the machine's speed");
  run.add_flag("--json", options.json, "Print only the summary (JSON) on standard output");
  add_stand(run, options.stand);
  add_device(run, options);
  add_memory(add_simulation(run, options, words), options);
  add_pictures(run, options.pictures, words);
}

void add_day(CLI::App& app, DayOptions& options, OptionWords& words) {
  CLI::App& day = add_command(
      app, "day",
      "Simulate one or more days in steps (--max-seconds applies to all of them, --max-rays to each step; also under mpirun)");
  add_argument(day, "scene", options.run.scene, "Scene file (TOML) with time and place, and weather or direct_normal light");
  add_word(day, "-o,--output", options.run.output, "Result folder (default: results/<scene>)");
  add_word(day, "--from", options.from, "Start of the first step, local time HH:MM (default: sunrise)");
  add_word(day, "--to", options.to, "End of the last step, which may be shorter (default: sunset)");
  day.add_option(
         "--together", options.steps_together,
         fmt::format(
             "Simulate up to N consecutive steps of a date together: they share packets, which takes less time but memory for "
             "each step; --max-rays then holds for all of them (default: as many as --memory holds, up to {}, or 1 with "
             "--max-rays)",
             usual_steps_together))
      ->transform(whole_number(1, most_steps_together));
  day.add_option("--step", options.step_min, "Step length in minutes; each step has the sun of its midpoint (default: 60)")
      ->transform(whole_number(1, 1440));
  add_word(day, "--date", options.date, "YYYY-MM-DD (default: the date in the scene's [sun])");
  add_word(day, "--to-date", options.to_date, "Last of several dates, all with the same hours");
  day.add_flag("--resume", options.run.resume, "Resume a stopped or killed day from its last saved replicate, or start it");
  listed(
      day.add_option("--export", options.run.exports,
                     "nc: write plane_H_day.nc, and day.nc for several dates too; none: write no day.nc, which saves the time "
                     "of estimating the light of triangles"))
      ->check(one_of({"nc", "none"}));
  listed(day.add_option("--images", options.run.images,
                        "day (the course), season (by kind of organ, of several dates), planes, none or all (default)"))
      ->check(one_of({"day", "season", "planes", "all", "none"}));
  add_word(day, "--band", options.run.pictures.band, "Waveband of the picture (default: the scene's first)");
  day.add_flag("--json", options.run.json, "Print only the summary (JSON) on standard output");
  add_device(day, options.run);
  add_memory(add_simulation(day, options.run, words), options.run,
             "steps simulated together and replicates in progress, half for each (default: half of the free memory)");
}

void add_render(CLI::App& app, RenderOptions& options, OptionWords& words) {
  CLI::App& render = add_command(app, "render", "Draw one picture of a scene or of a finished run's folder");
  add_argument(render, "scene", options.run.scene,
               "Scene file (TOML), or a .can with CARIBU's files, or the folder of a finished run");
  add_word(render, "-o,--output", options.file,
           "Picture file: .png, or .exr for the values themselves (default: CHART_FIELD.png in the folder of a finished "
           "run, in place of the one there; for a scene SCENE_CHART_FIELD.png here)");
  add_stand(render, options.run.stand);
  add_device(render, options.run);
  add_memory(add_simulation(render, options.run, words), options.run);
  add_pictures(render, options.run.pictures, words);
}

void add_view(CLI::App& app, ViewOptions& options, OptionWords& words) {
  CLI::App& view = add_command(app, "view", "Open a scene or a mesh in a window: move the sun and watch the light change");
  add_argument(view, "scene", options.run.scene,
               "Scene file (TOML), or a .can with CARIBU's files, or a mesh in the scene that `new` would write for it");
  add_word(view, "-o,--output", options.run.output, "Folder for saved pictures and results (default: results/<scene>_view)");
  view.add_flag("--json", options.run.json, "Print one line of JSON per event on standard output");
  add_stand(view, options.run.stand);
  add_device(view, options.run);
  add_memory(add_simulation(view, options.run, words), options.run);
  add_pictures(view, options.run.pictures, words);
}

void add_validate(CLI::App& app, ValidateOptions& options) {
  CLI::App& validate = add_command(app, "validate", "Run the cases with known answers on this device");
  add_word(validate, "-o,--output", options.output, "Result folder (default: results/validate)");
  listed(validate.add_option("--cases", options.cases,
                             "Run only groups of cases whose names contain one of these words, separated by commas"))
      ->check(not_empty());
  validate.add_flag("--json", options.json, "Print only the table, as JSON, on standard output");
  add_device(validate, options);
}

void add_tradeoff(CLI::App& app, TradeoffOptions& options) {
  constexpr std::uint64_t most_seeds = 1000;
  CLI::App& tradeoff = add_command(app, "tradeoff", "Measure speed against accuracy for a scene and write a table and a plot");
  add_argument(tradeoff, "scene", options.run.scene, "Scene file (TOML), or a .can with CARIBU's files");
  add_word(tradeoff, "-o,--output", options.run.output, "Result folder (default: results/<scene>_tradeoff)");
  tradeoff.add_option("--for", options.requested_error, "Relative error for which a setting is recommended")
      ->check(relative_error())
      ->capture_default_str();
  tradeoff.add_option("--of", options.quantity, "Quantity to which that error applies: canopy, layer, organ, triangle")
      ->check(one_of({"canopy", "layer", "organ", "triangle"}))
      ->capture_default_str();
  add_number(tradeoff, "--seeds", options.seeds, "Number of runs per setting", 4, most_seeds);
  tradeoff.add_option("--rays", options.finest_rays, "Rays of the finest grid; packets and the reference scale with it")
      ->check(number(1e3, 1e9))
      ->capture_default_str();
  tradeoff
      .add_option("--grid", options.run.grid_m, "A grid spacing of your own, m: it is measured too, and marked in the plot")
      ->check(positive());
  listed(tradeoff.add_option("--meshes", options.meshes,
                             "Measure coarser meshes as well: shares of the triangles to keep, separated by commas"))
      ->check(relative_error());
  add_number(tradeoff, "--seed", options.run.seed, "Seed of the first run", 0, most_seed);
  tradeoff.add_option("--max-seconds", options.run.max_seconds, "Stop after this many seconds; results are kept")
      ->check(positive());
  tradeoff.add_flag("--allow-outside", options.run.allow_outside, "Accept files outside the scene's folder");
  tradeoff.add_flag("--json", options.run.json, "Print only the slopes and the recommendation (JSON) on standard output");
  add_stand(tradeoff, options.run.stand);
  add_device(tradeoff, options.run);
}

void add_maize(CLI::App& app, MaizeOptions& options) {
  CLI::App& maize = add_command(app, "maize", "Write a parametric maize stand as glTF");
  maize.add_option("-o,--output", options.output, "Output file, .glb or .gltf")->check(not_empty())->capture_default_str();
  add_number(maize, "--rows", options.rows, "Number of rows, which run along X", 1, most_maize_plants);
  add_number(maize, "--per-row", options.per_row, "Number of plants per row", 1, most_maize_plants);
  maize.add_option("--spacing", options.spacing_m, "Plant spacing along the row and between rows, m")
      ->expected(2)
      ->delimiter(',')
      ->check(positive())
      ->capture_default_str();
  add_number(maize, "--seed", options.seed, "Seed of the variation between plants", 0, most_seed);
}

void add_convert(CLI::App& app, ConvertOptions& options) {
  CLI::App& convert =
      add_command(app, "convert", "Convert a mesh with CARIBU's files to a scene, or a mesh or scene to another mesh format");
  add_argument(convert, "in", options.input, fmt::format("Mesh ({}) or scene file (.toml)", readable_meshes));
  add_argument(convert, "out", options.output,
               "Scene file (.toml), with --optics and --light; or mesh (.glb, .gltf, .obj, .ply, .can)");
  add_stand(convert, options.stand);
  convert.add_flag("--z-up", options.z_up, "The input's axes are x east, y north, z up, as a .can's always are");
  convert
      .add_option(
          "--split", options.split,
          "Organs of a mesh: names (as the file names them), materials (one for each material of an organ) or parts (one "
          "for each connected piece)")
      ->check(one_of(organ_split_names()));
  convert.add_flag("--allow-outside", options.allow_outside, "Accept files outside the folder of the scene or glTF");
}

void add_new(CLI::App& app, NewOptions& options) {
  CLI::App& command = add_command(app, "new", "Write a commented scene for meshes, which runs as it is");
  add_argument(command, "meshes", options.meshes, "Mesh files, placed side by side; see also sunfleck info MESH");
  add_word(command, "-o,--output", options.output, "Scene file, .toml (default: standard output)");
  command.add_flag("--force", options.force, "Replace the scene file if it exists");
  command.add_flag("--allow-outside", options.allow_outside, "Accept buffers outside the folder of a glTF");
}

void add_info(CLI::App& app, InfoOptions& options, OptionWords& words) {
  CLI::App& info =
      add_command(app, "info", "Describe meshes; or show the devices, the contents of a scene and the memory its run needs");
  add_word(info, "files", options.meshes,
           "Meshes; or a scene file (TOML), or a .can with CARIBU's files; or nothing: only the devices");
  add_stand(info, options.run.stand);
  add_device(info, options.run);
  CLI::Option_group& group = *info.add_option_group("The run whose memory is forecast");
  add_bounds(group, options.run, words);
  add_fixed_work(group, options.run);
  add_memory(group, options.run);
  info.add_flag("--allow-outside", options.run.allow_outside, "Accept files outside the scene's folder");
  info.add_flag("--json", options.run.json, "Print JSON");
}

}  // namespace sunfleck
