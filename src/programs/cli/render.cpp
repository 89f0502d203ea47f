#include "programs/cli/render.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/threads.h"
#include "files/results/stores/result_store.h"
#include "pictures/charts/pictures.h"
#include "pictures/drawing/exr_writer.h"
#include "pictures/drawing/image_writer.h"
#include "programs/cli/terminal.h"
#include "simulate/interrupt.h"
#include "simulate/scene_source.h"
#include "simulate/simulation.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

bool is_exr(const fs::path& file) {
  return file.extension() == ".exr";
}

// Returns the picture's file, which is checked before any work starts.
fs::path picture_file(const RenderOptions& options, bool finished_run) {
  fs::path file = options.file;
  const fs::path name = stem_of(options.picture) + ".png";
  if (file.empty()) file = finished_run ? options.run.scene / name : fs::path(scene_stem(options.run.scene) + "_") += name;
  if (file.extension() != ".png" && !is_exr(file)) {
    throw_input(fmt::format("-o {}", printable(file.string())), "the name must end in .png or .exr",
                "give a picture.png, or a values.exr for the values themselves");
  }
  if (is_exr(file) && options.chart_given) {
    throw_input("--chart", "an .exr file contains values, not colours", "leave it out, or name a .png");
  }
  expect_folder_of(file);
  return file;
}

// A scene, with its result if there is one already.
struct Source {
  Scene scene;
  std::optional<RadiationResult> result;
};

Source read_source(const RenderOptions& options, bool finished_run) {
  const fs::path& place = options.run.scene;
  if (!finished_run) return {load_scene_with_warnings(options.run), std::nullopt};
  if (!options.simulating.empty()) {
    throw_input(options.simulating, fmt::format("the run in {} is finished", printable(place.string())),
                "leave it out, or give the scene");
  }
  const fs::path store = place / result_store_file;
  std::error_code error;
  if (!fs::exists(store, error)) {
    throw_input(printable(place.string()), fmt::format("no folder of a finished run: it has no {}", result_store_file),
                "give a scene, or run it first");
  }
  StoredResult stored = read_result_store(store);
  if (!stored.complete) warn("the run stopped before it was finished, so its picture is noisier than intended");
  return {std::move(stored.scene), std::move(stored.result)};
}

// Draws the picture. Returns false if stopped.
bool write_picture(const Drawing& drawing, const RenderOptions& options, const fs::path& file) {
  if (!is_exr(file)) {
    return draw_charts(drawing, options.run.pictures, std::span(&options.picture, 1), interrupted,
                       [&](std::size_t, const Image& image) { write_png(image, file); });
  }
  const std::optional<ExrImage> image = draw_values(drawing, options.run.pictures, options.picture.field, interrupted);
  if (image) write_exr(*image, file);
  return image.has_value();
}

}  // namespace

int render(const RenderOptions& options) {
  start_at_terminal(options.run);
  std::error_code error;
  const bool finished_run = fs::is_directory(options.run.scene, error);
  const fs::path file = picture_file(options, finished_run);
  Source source = read_source(options, finished_run);
  check_view(source.scene.model, options.run.pictures);
  check_field(source.scene.model, options.picture);
  if (!source.result) check_grid(options.run, source.scene);

  Simulation simulation(std::move(source.scene), options.run);
  watch_for_interrupts();
  const SolveSettings settings = solve_settings(options.run, simulation.scene(), options.run.threads);
  SimulatedScene simulated;
  int status = exit_done;
  if (source.result) {
    simulated = simulation.simulated(settings, std::move(*source.result));
  } else {
    say(device_line(simulation.device()));
    simulated = simulate_at_terminal(simulation, settings);
    const bool interrupted = simulated.result.stop == StopReason::interrupted;
    warn_if_short(simulated, settings, interrupted ? "no picture is drawn" : "the picture shows the light so far");
    status = exit_status(simulated.result.stop);
  }
  const CpuThreads threads(options.run.threads);
  if (status == exit_interrupted || !write_picture(simulated.drawing(), options, file)) return exit_interrupted;
  simulation.check_validation();
  if (!options.run.quiet) fmt::print("{}\n", file.string());
  return status;
}

}  // namespace sunfleck
