#include "app/result_folder.h"

#include "app/colouring.h"
#include "app/fields.h"
#include "app/interrupt.h"
#include "app/report.h"
#include "app/scene_source.h"
#include "app/simulation.h"
#include "base/error.h"
#include "base/log.h"
#include "io/exports.h"
#include "io/file.h"
#include "io/gnuplot.h"
#include "io/image_writer.h"
#include "io/plane_plot.h"
#include "io/plane_writer.h"
#include "io/profile_plot.h"
#include "io/result_store.h"
#include "io/run_store.h"
#include "io/sensor_writer.h"
#include "io/step_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace sunfleck {
namespace {

constexpr const char* summary_file = "summary.json";
constexpr const char* profile_file = "profile.csv";
constexpr const char* profile_plot_file = "profile.png";
constexpr const char* organs_file = "organs.csv";
constexpr const char* sensors_file = "sensors.csv";

std::string file_of(const Picture& picture) {
  return stem_of(picture) + ".png";
}

bool asks_for(const RunOptions& options, const std::string& image) {
  return std::find(options.images.begin(), options.images.end(), image) != options.images.end();
}

// True for a file that some run writes under a name of its own choosing: those of the receivers.
bool is_plane_file(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return file.filename().string().rfind("plane_", 0) == 0 && (extension == ".csv" || extension == ".png");
}

// Those that the command line names one by one.
std::vector<Picture> named_pictures(const RunOptions& options) {
  std::vector<Picture> named;
  for (const Picture& picture : all_pictures()) {
    const bool listed = std::find(options.images.begin(), options.images.end(), stem_of(picture)) != options.images.end();
    if (listed || options.extra_picture == picture) named.push_back(picture);
  }
  return named;
}

// Those named, and of those that `all` stands for the ones that have something to show: none of a light that the scene does
// not have, no total where all is direct.
std::vector<Picture> wanted_pictures(const RunOptions& options, const RadiationModel& model, const RadiationResult& result) {
  std::vector<Picture> wanted = named_pictures(options);
  if (std::find(options.images.begin(), options.images.end(), "all") == options.images.end()) return wanted;
  const bool indirect = result.indirect.packets + result.indirect.sky_rays > 0;
  for (const Picture& picture : usual_pictures()) {
    const bool there = picture.field == LightField::direct ? model.has_beam() : indirect;
    if (there && std::find(wanted.begin(), wanted.end(), picture) == wanted.end()) wanted.push_back(picture);
  }
  return wanted;
}

// Elements coloured as in the rank chart of all light: the mean of both faces.
std::vector<ElementColour> element_colours(const Drawing& drawing, std::size_t band) {
  const RadiationModel& model = drawing.scene.model;
  const FieldValues values = field_values(model, drawing.layout, drawing.result, band, LightField::total);
  const std::vector<Colour> surfaces =
      colour_field(ChartKind::rank, values, surface_colours(model, drawing.layout), "").colours;
  std::vector<ElementColour> colours(model.canopy.size());
  for (std::size_t e = 0; e < colours.size(); ++e) {
    for (std::size_t c = 0; c < 3; ++c) colours[e].linear[c] = 0.5 * (surfaces[2 * e][c] + surfaces[2 * e + 1][c]);
    colours[e].srgb = to_srgb(colours[e].linear);
  }
  return colours;
}

void write_export_files(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
                        const Drawing& drawing, Losses& losses) {
  if (options.exports.empty()) return;
  const std::size_t band = picture_band(drawing.scene.model, options.pictures.band);
  const std::vector<ElementColour> colours = element_colours(drawing, band);
  for (const ExportKind kind : export_kinds) {
    const bool asked = std::find(options.exports.begin(), options.exports.end(), export_name(kind)) != options.exports.end();
    if (!asked) continue;
    losses.attempt(export_file(kind),
                   [&] { write_exports(std::span(&kind, 1), folder, record, drawing.scene.model, drawing.result, colours); });
  }
}

void write_tables(const std::filesystem::path& folder, const RunRecord& record, const RadiationModel& model,
                  const RadiationResult& result, Losses& losses) {
  const auto write = [&](const std::string& name, const auto& text) {
    losses.attempt(name, [&] { write_file(folder / name, text()); });
  };
  write(profile_file, [&] { return profile_csv(record, model, result); });
  write(organs_file, [&] { return organs_csv(record, model, result); });
  if (!result.sensors.empty()) write(sensors_file, [&] { return sensors_csv(record, model, result); });
  for (std::size_t plane = 0; plane < result.planes.size(); ++plane) {
    const std::string stem = plane_stem(result.planes[plane].height_m);
    write(stem + ".csv", [&] { return plane_csv(record, model, result, plane); });
    if (model.has_beam()) write(stem + "_flecks.csv", [&] { return plane_flecks_csv(record, model, result, plane); });
  }
}

// A plot that gnuplot could not draw is said once; then no other is tried.
class Plots {
 public:
  Plots(const std::filesystem::path& folder, Losses& losses) : folder_(folder), losses_(losses) {}
  void draw(const std::string& script, const std::string& file) {
    if (given_up_) return;
    std::optional<std::string> problem;
    losses_.attempt(file, [&] { problem = draw_plot(script, folder_ / file); });
    if (problem) warn(*problem);
    given_up_ = problem.has_value();
  }

 private:
  const std::filesystem::path& folder_;
  Losses& losses_;
  bool given_up_ = false;
};

void write_plots(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
                 const Drawing& drawing, const Companions& companions, Losses& losses) {
  const RadiationModel& model = drawing.scene.model;
  const RadiationResult& result = drawing.result;
  const std::size_t band = picture_band(model, options.pictures.band);
  const ProfileTable own = profile_table(record.title, record.accuracy.confidence, model, result);
  if (companions.measured && model.has_beam()) {
    say(agreement_line(companions.measured->name, agreement(own, *companions.measured)));
  }
  Plots plots(folder, losses);
  if (asks_for(options, "all") || asks_for(options, "profile")) {
    std::vector<ProfileCurve> curves{{record.title, own}};
    for (const ProfileTable& other : companions.results) curves.push_back({other.title, other});
    plots.draw(profile_plot(record.title, curves, model.bands[band].name, companions.measured), profile_plot_file);
  }
  if (!asks_for(options, "all") && !asks_for(options, "planes")) return;
  for (std::size_t plane = 0; plane < result.planes.size() && !interrupted(); ++plane) {
    plots.draw(plane_plot(record.title, model, result, plane, band), plane_stem(result.planes[plane].height_m) + ".png");
  }
}

// False if interrupted before all were drawn.
bool write_pictures(const std::filesystem::path& folder, const RunOptions& options, const Drawing& drawing, Losses& losses) {
  const std::vector<Picture> wanted = wanted_pictures(options, drawing.scene.model, drawing.result);
  if (wanted.empty()) return true;
  bool finished = true;
  losses.attempt("the pictures", [&] {
    finished = draw_charts(drawing, options.pictures, wanted, interrupted, [&](const Picture& picture, const Image& image) {
      losses.attempt(file_of(picture), [&] { write_png(image, folder / file_of(picture)); });
    });
  });
  return finished;
}

// The names of all files but the summary that some run writes into its folder.
bool is_file_of_runs(const std::string& name) {
  std::vector<std::string> names{profile_file,   profile_plot_file, organs_file,      sensors_file, result_store_file,
                                 run_state_file, "day.csv",         "organs_day.csv", "day.nc",     "day.png"};
  for (const ExportKind kind : export_kinds) names.emplace_back(export_file(kind));
  for (const Picture& picture : all_pictures()) names.emplace_back(file_of(picture));
  return is_plane_file(name) || std::find(names.begin(), names.end(), name) != names.end();
}

template <class Wanted>
std::vector<std::string> names_in(const std::filesystem::path& folder, const Wanted& wanted) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::string name = entry.path().filename().string();
    if (wanted(name)) found.push_back(std::move(name));
  }
  return found;
}

void remove_files(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::error_code error;
    std::filesystem::remove(folder / name, error);
    if (error) throw_failure(printable((folder / name).string()), error.message(), "give a folder that can be written with -o");
  }
}

}  // namespace

std::filesystem::path result_folder(const RunOptions& options) {
  return options.output.empty() ? std::filesystem::path("results") / scene_stem(options.scene) : options.output;
}

void prepare_folder(const std::filesystem::path& folder, FolderLock& lock, EarlierRun earlier) {
  lock.make_folder();
  std::error_code error;
  const bool of_earlier_run = std::filesystem::exists(folder / summary_file, error);
  const auto goes = [earlier](const std::string& name) {
    return is_file_of_runs(name) && (earlier == EarlierRun::goes || name != run_state_file);
  };
  std::vector<std::string> going;
  if (of_earlier_run) going = names_in(folder, goes);
  for (const std::string& name : going) check_writable(folder / name);
  reopen_folder(folder);
  if (of_earlier_run) remove_day_steps(folder);
  remove_files(folder, going);
}

void reopen_folder(const std::filesystem::path& folder) {
  write_file(folder / summary_file, "{\"complete\": false}\n");
  // What was being written when an earlier run was killed.
  remove_files(folder, names_in(folder, [](const std::string& name) {
                 const std::string of = std::filesystem::path(name).stem().stem().string();  // NAME.NUMBER.tmp
                 return is_left_aside(name, of) && (of == summary_file || is_file_of_runs(of));
               }));
}

Companions read_companions(const RunOptions& options, const RadiationModel& model) {
  Companions companions;
  if (!options.measured.empty()) {
    if (!model.has_beam()) {
      throw_input("--measured", "the scene has no direct light to compare sunfleck ratios with", "leave it out, or add [sun]");
    }
    companions.measured = read_measured(options.measured);
  }
  for (const std::filesystem::path& folder : options.compare)
    companions.results.push_back(read_profile_csv(folder / profile_file));
  return companions;
}

void check_pictures(const RunOptions& options, const RadiationModel& model) {
  check_view(model, options.pictures);
  for (const Picture& picture : named_pictures(options)) check_field(model, picture);
}

bool write_results(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
                   const Drawing& drawing, const Companions& companions, Losses& losses) {
  write_tables(folder, record, drawing.scene.model, drawing.result, losses);
  write_export_files(folder, options, record, drawing, losses);
  losses.attempt(result_store_file,
                 [&] { write_result_store(folder / result_store_file, record, drawing.scene, drawing.result); });
  write_plots(folder, options, record, drawing, companions, losses);
  return write_pictures(folder, options, drawing, losses);
}

int tell_finished(const std::filesystem::path& folder, const RunOptions& options, std::string_view work) {
  const std::string summary = read_file(folder / summary_file);
  const nlohmann::json finished = nlohmann::json::parse(summary, nullptr, false);
  const bool complete = finished.is_object() && finished.contains("complete") && finished["complete"] == true;
  if (options.json) {
    fmt::print("{}", summary);
  } else {
    say(fmt::format("{}: this {} is finished, nothing to resume", printable(folder.string()), work));
  }
  return complete ? exit_done : exit_short_of_bound;
}

void publish(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
             const RadiationModel& model, const RadiationResult& result, Losses& losses) {
  const std::string summary = summary_json(record, model, result);
  losses.attempt(summary_file, [&] { write_file(folder / summary_file, summary); });
  if (options.json) {
    fmt::print("{}", summary);
  } else if (!options.quiet) {
    fmt::print("{}{}\n", balance_report(record, model, result), folder.string());
  }
}

}  // namespace sunfleck
