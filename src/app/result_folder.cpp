#include "app/result_folder.h"

#include "app/colouring.h"
#include "app/fields.h"
#include "app/interrupt.h"
#include "app/report.h"
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
#include "io/sensor_writer.h"
#include "io/step_store.h"

#include <fmt/format.h>

#include <algorithm>
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
                        const Drawing& drawing) {
  std::vector<ExportKind> kinds;
  for (const std::string& name : options.exports) {
    if (const auto kind = export_kind(name); kind && std::find(kinds.begin(), kinds.end(), *kind) == kinds.end()) {
      kinds.push_back(*kind);
    }
  }
  if (kinds.empty()) return;
  const std::size_t band = picture_band(drawing.scene.model, options.pictures.band);
  write_exports(kinds, folder, record, drawing.scene.model, drawing.result, element_colours(drawing, band));
}

void write_tables(const std::filesystem::path& folder, const RunRecord& record, const RadiationModel& model,
                  const RadiationResult& result) {
  write_file(folder / profile_file, profile_csv(record, model, result));
  write_file(folder / organs_file, organs_csv(record, model, result));
  if (!result.sensors.empty()) write_file(folder / sensors_file, sensors_csv(record, model, result));
  for (std::size_t plane = 0; plane < result.planes.size(); ++plane) {
    const std::string stem = plane_stem(result.planes[plane].height_m);
    write_file(folder / (stem + ".csv"), plane_csv(record, model, result, plane));
    if (model.has_beam()) write_file(folder / (stem + "_flecks.csv"), plane_flecks_csv(record, model, result, plane));
  }
}

// A plot that gnuplot could not draw is said once; then no other is tried.
class Plots {
 public:
  explicit Plots(const std::filesystem::path& folder) : folder_(folder) {}
  void draw(const std::string& script, const std::string& file) {
    if (given_up_) return;
    const std::optional<std::string> problem = draw_plot(script, folder_ / file);
    if (problem) warn(*problem);
    given_up_ = problem.has_value();
  }

 private:
  const std::filesystem::path& folder_;
  bool given_up_ = false;
};

void write_plots(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
                 const Drawing& drawing, const Companions& companions) {
  const RadiationModel& model = drawing.scene.model;
  const RadiationResult& result = drawing.result;
  const std::size_t band = picture_band(model, options.pictures.band);
  const ProfileTable own = profile_table(record.title, record.accuracy.confidence, model, result);
  if (companions.measured && model.has_beam()) {
    say(agreement_line(companions.measured->name, agreement(own, *companions.measured)));
  }
  Plots plots(folder);
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
bool write_pictures(const std::filesystem::path& folder, const RunOptions& options, const Drawing& drawing) {
  const std::vector<Picture> wanted = wanted_pictures(options, drawing.scene.model, drawing.result);
  return wanted.empty() ||
         draw_charts(drawing, options.pictures, wanted, interrupted,
                     [&](const Picture& picture, const Image& image) { write_png(image, folder / file_of(picture)); });
}

}  // namespace

std::filesystem::path result_folder(const RunOptions& options) {
  return options.output.empty() ? std::filesystem::path("results") / options.scene.stem() : options.output;
}

void prepare_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const auto refuse = [&](const std::filesystem::path& path) {
    throw_failure(printable(path.string()), error.message(), "give a folder that can be written with -o");
  };
  if (error) refuse(folder);
  const bool of_earlier_run = std::filesystem::exists(folder / summary_file, error);
  write_file(folder / summary_file, "{\"complete\": false}\n");
  if (!of_earlier_run) return;
  remove_day_steps(folder);
  std::vector<std::filesystem::path> names{profile_file, profile_plot_file, organs_file, sensors_file, result_store_file,
                                           "day.csv",    "organs_day.csv",  "day.nc",    "day.png"};
  for (const ExportKind kind : export_kinds) names.emplace_back(export_file(kind));
  for (const Picture& picture : all_pictures()) names.emplace_back(file_of(picture));
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (is_plane_file(entry.path())) names.push_back(entry.path().filename());
  }
  for (const std::filesystem::path& name : names) {
    std::filesystem::remove(folder / name, error);
    if (error) refuse(folder / name);
  }
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

Written write_results(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
                      const Drawing& drawing, const Companions& companions) {
  Written written = Written::all;
  write_tables(folder, record, drawing.scene.model, drawing.result);
  try {
    write_export_files(folder, options, record, drawing);
  } catch (const Error& error) {
    warn(error.what());
    written = Written::some;
  }
  write_result_store(folder / result_store_file, record, drawing.scene, drawing.result);
  write_plots(folder, options, record, drawing, companions);
  return write_pictures(folder, options, drawing) ? written : Written::interrupted;
}

void publish(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
             const RadiationModel& model, const RadiationResult& result) {
  const std::string summary = summary_json(record, model, result);
  write_file(folder / summary_file, summary);
  if (options.json) {
    fmt::print("{}", summary);
  } else if (!options.quiet) {
    fmt::print("{}{}\n", balance_report(record, model, result), folder.string());
  }
}

}  // namespace sunfleck
