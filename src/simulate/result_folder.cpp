#include "simulate/result_folder.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "files/results/exports/exports.h"
#include "files/results/stores/result_store.h"
#include "files/results/stores/run_store.h"
#include "files/results/stores/step_store.h"
#include "files/results/tables/plane_writer.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"
#include "physics/transport/model/receivers.h"
#include "pictures/charts/colouring.h"
#include "pictures/charts/fields.h"
#include "pictures/drawing/image_writer.h"
#include "simulate/day_folder.h"
#include "simulate/interrupt.h"
#include "simulate/scene_source.h"
#include "simulate/table_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sunfleck {
namespace {

constexpr const char* profile_file = "profile.csv";
constexpr const char* profile_plot_file = "profile.png";

const char* name_of(ResultOf result) {
  return result == ResultOf::run ? "run" : "day";
}

std::string file_of(const Picture& picture) {
  return stem_of(picture) + ".png";
}

// Returns whether a run or a day writes a receiver's map or plot under this name: "plane_", its height, and perhaps a word.
bool is_plane_file(const std::filesystem::path& file) {
  constexpr std::string_view begin = "plane_";
  const std::string name = file.filename().string(), extension = file.extension().string();
  const bool has_height = name.starts_with(begin) && name[begin.size()] >= '0' && name[begin.size()] <= '9';
  return has_height && (extension == ".csv" || extension == ".png" || extension == ".nc");
}

// Returns the pictures that are requested one by one.
std::vector<Picture> named_pictures(const ResultRequest& request) {
  std::vector<Picture> named;
  for (const Picture& picture : all_pictures()) {
    if (holds(request.images, stem_of(picture)) || request.extra_picture == picture) named.push_back(picture);
  }
  return named;
}

// Returns the pictures requested by name, and the usual pictures if `all` is requested.
std::vector<Picture> wanted_pictures(const ResultRequest& request, const RadiationModel& model, const RadiationResult& result) {
  std::vector<Picture> wanted = named_pictures(request);
  if (!holds(request.images, "all")) return wanted;
  const bool indirect = result.indirect.packets + result.indirect.sky_rays > 0;
  for (const Picture& picture : usual_pictures(model.has_beam(), indirect)) {
    if (std::find(wanted.begin(), wanted.end(), picture) == wanted.end()) wanted.push_back(picture);
  }
  return wanted;
}

// Returns the colours of elements in the rank chart of total light.
std::vector<ElementColour> element_colours(const Drawing& drawing, std::size_t band) {
  const RadiationModel& model = drawing.scene.model;
  const FieldValues sides = field_values(model, drawing.layout, drawing.result, band, LightField::total);
  const FieldValues values = leaf_values(model, sides, LightField::total);
  const std::vector<Colour> surfaces = colour_field(ChartKind::rank, values, surface_colours(model, drawing.layout), "",
                                                    {.lit_from_w_m2 = lit_from_w_m2(model, band, LightField::total)})
                                           .colours;
  std::vector<ElementColour> colours(model.canopy.size());
  for (std::size_t e = 0; e < colours.size(); ++e) {
    colours[e].linear = surfaces[2 * e];
    colours[e].srgb = to_srgb(colours[e].linear);
  }
  return colours;
}

void write_export_files(const std::filesystem::path& folder, const ResultRequest& request, const RunRecord& record,
                        const Drawing& drawing, UnwrittenFiles& unwritten) {
  if (request.exports.empty()) return;
  const std::size_t band = picture_band(drawing.scene.model, request.pictures.band);
  const std::vector<ElementColour> colours = element_colours(drawing, band);
  for (const ExportKind kind : export_kinds) {
    if (!holds(request.exports, export_name(kind))) continue;
    unwritten.attempt(export_file(kind),
                      [&] { write_export(kind, folder, record, drawing.scene.model, drawing.result, colours); });
  }
}

void write_tables(const std::filesystem::path& folder, const RunRecord& record, const RadiationModel& model,
                  const RadiationResult& result, UnwrittenFiles& unwritten) {
  const auto write = [&](const std::string& name, const auto& text) {
    unwritten.attempt(name, [&] { write_file(folder / name, text()); });
  };
  for (const ResultTable& table : result_tables) {
    if (!table.is_of(result) || (table.make == plants_table && result.plants.empty())) continue;
    write(table.file, [&] { return csv_text(record, table.make(model, result)); });
  }
  for (std::size_t plane = 0; plane < result.planes.size(); ++plane) {
    const std::string stem = plane_stem(result.planes[plane].height_m);
    write(stem + ".csv", [&] { return plane_csv(record, model, result, plane); });
    if (model.has_beam()) write(stem + "_flecks.csv", [&] { return plane_flecks_csv(record, model, result, plane); });
  }
}

PlotVariables profile_variables(const std::filesystem::path& folder, const ResultRequest& request, const std::string& title,
                                const std::string& band, const ProfileOverlays& overlays, const std::string& agreement) {
  std::vector<std::filesystem::path> tables{folder / profile_file};
  for (const std::filesystem::path& other : request.compare) tables.push_back(other / profile_file);
  std::vector<std::string> titles{title};
  for (const ProfileTable& other : overlays.results) titles.push_back(other.title);
  PlotVariables variables;
  variables.set_files("tables", tables);
  variables.set_texts("titles", titles);
  variables.set_text("band", band);
  if (!overlays.measured) return variables;
  std::vector<std::vector<double>> points;
  for (const MeasuredRatio& point : overlays.measured->points) points.push_back({point.sunfleck_ratio, point.height_m});
  variables.set_text("measured", overlays.measured->name);
  variables.set_table("measured", "sunfleck_ratio,height_m", points);
  variables.set_text("agreement", agreement);
  return variables;
}

PlotVariables plane_variables(const std::filesystem::path& folder, const std::string& title, const RadiationModel& model,
                              const std::string& stem, const Waveband& band) {
  PlotVariables variables;
  variables.set_file("table", folder / (stem + ".csv"));
  if (model.has_beam()) variables.set_file("flecks", folder / (stem + "_flecks.csv"));
  variables.set_text("title", title);
  variables.set_text("band", band.name);
  variables.set("beam", band.direct_w_m2);
  return variables;
}

// Draws the plots of the tables that write_tables has written.
void write_plots(const std::filesystem::path& folder, const ResultRequest& request, const RunRecord& record,
                 const Drawing& drawing, const DrawingHooks& hooks, UnwrittenFiles& unwritten) {
  const ProfileOverlays& overlays = hooks.overlays;
  const RadiationModel& model = drawing.scene.model;
  const RadiationResult& result = drawing.result;
  const Waveband& band = model.bands[picture_band(model, request.pictures.band)];
  std::string figures;
  if (overlays.measured && model.has_beam()) {
    const ProfileTable own = profile_table(record.title, record.accuracy.confidence, model, result);
    const Agreement found = agreement(own, *overlays.measured);
    say(agreement_line(overlays.measured->name, found));
    figures = agreement_figures(found);
  }
  TablePlots plots(folder, unwritten);
  if (holds(request.images, "all") || holds(request.images, "profile"))
    plots.draw("profile.gp", profile_variables(folder, request, record.title, band.name, overlays, figures), profile_plot_file);
  if (!holds(request.images, "all") && !holds(request.images, "planes")) return;
  for (std::size_t plane = 0; plane < result.planes.size() && !hooks.stop(); ++plane) {
    const std::string stem = plane_stem(result.planes[plane].height_m);
    plots.draw("plane.gp", plane_variables(folder, record.title, model, stem, band), stem + ".png");
  }
}

// Draws the pictures; returns false if stopped before all were drawn.
bool write_pictures(const std::filesystem::path& folder, const ResultRequest& request, const Drawing& drawing,
                    const StopQuestion& stop, UnwrittenFiles& unwritten) {
  const std::vector<Picture> wanted = wanted_pictures(request, drawing.scene.model, drawing.result);
  if (wanted.empty()) return true;
  bool finished = true;
  std::vector<std::optional<std::string>> pngs(wanted.size());  // compressed by several threads, written in order
  unwritten.attempt("the pictures", [&] {
    finished = draw_charts(drawing, request.pictures, wanted, stop,
                           [&](std::size_t k, const Image& image) { pngs[k] = encoded_png(image); });
  });
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (pngs[k]) unwritten.attempt(file_of(wanted[k]), [&] { write_encoded_png(*pngs[k], folder / file_of(wanted[k])); });
  }
  return finished;
}

// Returns whether a run or a day writes a file of this name, other than the summary.
bool is_file_of_runs(const std::string& name) {
  std::vector<std::string> names{profile_plot_file, result_store_file, run_state_file};
  for (const ResultTable& table : result_tables) names.emplace_back(table.file);
  for (const ExportKind kind : export_kinds) names.emplace_back(export_file(kind));
  for (const Picture& picture : all_pictures()) names.emplace_back(file_of(picture));
  return is_plane_file(name) || is_file_of_days(name) || std::find(names.begin(), names.end(), name) != names.end();
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

std::vector<std::string> image_words() {
  std::vector<std::string> words;
  for (const Picture& picture : all_pictures()) words.push_back(stem_of(picture));
  words.insert(words.end(), {"profile", "planes", "all", "none"});
  return words;
}

std::filesystem::path result_folder(const ResultRequest& request, const std::filesystem::path& scene) {
  return request.output.empty() ? std::filesystem::path("results") / scene_stem(scene) : request.output;
}

void check_folder(const std::filesystem::path& folder, const Scene& scene, ResultOf result) {
  std::error_code error;
  const bool is_run = result == ResultOf::run;
  if (is_run ? holds_unfinished_day(folder) : std::filesystem::exists(folder / run_state_file, error)) {
    const ResultOf other = is_run ? ResultOf::day : ResultOf::run;
    throw_input(printable(folder.string()),
                fmt::format("it holds an unfinished {0}, which a {1} would replace", name_of(other), name_of(result)),
                fmt::format("finish it with `sunfleck {} --resume`, or give another folder with -o", name_of(other)));
  }
  const std::filesystem::path results = std::filesystem::weakly_canonical(folder, error);
  for (const SourceFile& file : scene.files) {
    const std::string name = file.path.filename().string();
    if (!is_file_of_runs(name) || std::filesystem::weakly_canonical(file.path, error).parent_path() != results) continue;
    throw_input(printable(file.path.string()), "the result would replace this file of the scene",
                "give another folder with -o, or rename the file");
  }
}

std::optional<nlohmann::json> summary_in(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(folder / summary_file, error)) return std::nullopt;
  nlohmann::json summary = nlohmann::json::parse(read_file(folder / summary_file), nullptr, false);
  if (!summary.is_object()) return std::nullopt;
  return summary;
}

nlohmann::json command_of(const nlohmann::json& summary) {
  return summary.value("command", nlohmann::json("run"));  // that of a run does not say
}

std::optional<std::string> other_result_in(const std::filesystem::path& folder, ResultOf result) {
  const std::optional<nlohmann::json> summary = summary_in(folder);
  if (!summary || !summary->contains("settings")) return std::nullopt;
  const nlohmann::json command = command_of(*summary);
  if (command == name_of(result)) return std::nullopt;
  return printable(command.dump());
}

std::optional<std::string> lack_of(const std::filesystem::path& folder, std::string_view work, const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(folder / file, error)) return std::nullopt;
  return fmt::format("the {} in {} is finished, and has no {}", work, printable(folder.string()), file);
}

void prepare_folder(const std::filesystem::path& folder, FolderLock& lock, ResultOf result, OldResults old) {
  lock.make_folder();
  std::error_code error;
  const bool of_earlier_run = std::filesystem::exists(folder / summary_file, error);
  if (other_result_in(folder, result))
    warn(fmt::format("{}: this {} replaces the result of another command there", printable(folder.string()), name_of(result)));
  const auto is_stale = [old](const std::string& name) {
    return is_file_of_runs(name) && (old == OldResults::remove_all || name != run_state_file);
  };
  std::vector<std::string> stale;
  if (of_earlier_run) stale = names_in(folder, is_stale);
  for (const std::string& name : stale) check_writable(folder / name);
  reopen_folder(folder);
  if (of_earlier_run) remove_day_steps(folder);
  remove_files(folder, stale);
}

void reopen_folder(const std::filesystem::path& folder) {
  write_file(folder / summary_file, "{\"complete\": false}\n");
  // Removes the files that were being written when an earlier run was killed.
  remove_files(folder, names_in(folder, [](const std::string& name) {
                 const std::string of = std::filesystem::path(name).stem().stem().string();  // NAME.NUMBER.tmp
                 return is_left_aside(name, of) && (of == summary_file || is_file_of_runs(of));
               }));
}

ProfileOverlays read_overlays(const ResultRequest& request, const RadiationModel& model) {
  ProfileOverlays overlays;
  if (!request.measured.empty()) {
    if (!model.has_beam()) {
      throw_input("--measured", "the scene has no direct light to compare sunfleck ratios with", "leave it out, or add [sun]");
    }
    overlays.measured = read_measured(request.measured);
  }
  for (const std::filesystem::path& folder : request.compare)
    overlays.results.push_back(read_profile_csv(folder / profile_file));
  return overlays;
}

void check_pictures(const ResultRequest& request, const RadiationModel& model) {
  check_view(model, request.pictures);
  for (const Picture& picture : named_pictures(request)) check_field(model, picture);
  if (holds(request.images, "planes") && model.planes.empty())
    warn("--images planes draws nothing; give the scene a [[plane]]");
}

bool shows_triangles(const ResultRequest& request) {
  return holds(request.images, "all") || !request.exports.empty() || !named_pictures(request).empty();
}

UnwrittenFiles write_whole_result(const std::filesystem::path& folder, const ResultRequest& request,
                                  const SimulatedScene& simulated, RunRecord& record, const DrawingHooks& hooks) {
  const Scene& scene = *simulated.scene;
  const CpuThreads limit(record.threads);
  Stopwatch watch;
  UnwrittenFiles unwritten;
  write_tables(folder, record, scene.model, simulated.result, unwritten);
  write_export_files(folder, request, record, simulated.drawing(), unwritten);
  unwritten.attempt(result_store_file,
                    [&] { write_result_store(folder / result_store_file, record, scene, simulated.result); });
  write_plots(folder, request, record, simulated.drawing(), hooks, unwritten);
  record.pictures_interrupted = !write_pictures(folder, request, simulated.drawing(), hooks.stop, unwritten);
  record.not_written.insert(record.not_written.end(), unwritten.names().begin(), unwritten.names().end());
  record.complete = record.complete && !record.pictures_interrupted && record.not_written.empty();
  record.seconds.write = watch.lap();
  record.seconds.total += record.seconds.write;
  unwritten.attempt(summary_file,
                    [&] { write_file(folder / summary_file, summary_json(record, scene.model, simulated.result)); });
  return unwritten;
}

}  // namespace sunfleck
