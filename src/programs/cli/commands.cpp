#include "programs/cli/commands.h"

#include "base/text.h"
#include "files/formats/mesh/mesh_writer.h"
#include "physics/canopy/maize.h"
#include "programs/cli/terminal.h"
#include "simulate/checkpoint.h"
#include "simulate/cluster/launch.h"
#include "simulate/interrupt.h"
#include "simulate/ranks.h"
#include "simulate/result_folder.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace sunfleck {
namespace {

// Does the part of a rank other than 0 in a run.
int help_with_run(const RunOptions& options, Ranks& ranks) {
  const bool served = ranks.serve([&](const auto& make_replicates) {
    Simulation simulation(load_scene(options), options);
    const SolveSettings settings = solve_settings(options, simulation.scene(), options.threads);
    make_replicates({simulation, settings, task_text("run", options, options, settings), {}});
  });
  return served ? exit_done : exit_failed;
}

// Returns what an interrupted run did not come to, such as ", without sensors and pictures"; empty if it lacks neither.
std::string lacking_text(const SimulatedScene& simulated) {
  const bool sensors = !simulated.scene->model.sensors.empty() && simulated.result.sensors.empty();
  const bool pictures = simulated.record.pictures_interrupted;
  if (!sensors && !pictures) return "";
  return fmt::format(", without {}{}{}", sensors ? "sensors" : "", sensors && pictures ? " and " : "",
                     pictures ? "pictures" : "");
}

}  // namespace

int run(const RunOptions& asked) {
  start_at_terminal(asked);
  Stopwatch watch;
  Ranks ranks;
  RunOptions options = asked;
  ranks.take_seat(options);
  if (ranks.is_worker()) return help_with_run(options, ranks);
  const std::filesystem::path folder = result_folder(options, options.scene);
  FolderLock lock(folder);

  Scene scene = load_scene_with_warnings(options);
  SolveSettings settings = solve_settings(options, scene, options.threads);
  check_pictures(options, scene.model);
  check_folder(folder, scene, ResultOf::run);
  check_grid(options, scene);
  const ProfileOverlays overlays = read_overlays(options, scene.model);
  Checkpoint checkpoint(folder, options.exports, scene, settings);
  const auto found = options.resume ? checkpoint.find(scene.model, settings) : Checkpoint::Found::nothing;
  if (found == Checkpoint::Found::finished) return report_finished(folder, options, "run");
  settings.resume_from = checkpoint.state();
  const double load_s = watch.lap();

  Simulation simulation(std::move(scene), options);
  ranks.gather(simulation, settings, task_text("run", options, options, settings));
  watch_for_interrupts();
  prepare_folder(folder, lock, ResultOf::run,
                 found == Checkpoint::Found::begun ? OldResults::keep_checkpoint : OldResults::remove_all);
  if (options.resume) say(checkpoint.resume_line());
  say(device_line(simulation.device()));

  SimulatedScene simulated = simulate_at_terminal(simulation, settings, &checkpoint, &ranks);
  simulated.record.seconds.load = load_s;
  simulated.record.seconds.total += load_s;
  const UnwrittenFiles unwritten = write_whole_result(folder, options, simulated, simulated.record, {.overlays = overlays});
  if (simulated.record.pictures_interrupted) simulated.result.stop = StopReason::interrupted;
  simulation.check_validation();

  const std::string cure = checkpoint.holds_state() ? "; --resume continues the run" : "";
  warn_if_short(simulated, settings, "the results are kept and marked incomplete" + lacking_text(simulated) + cure);
  warn_of_coarse_triangles(simulated, options.exports);
  print_result(folder, options, simulated);
  if (simulated.record.complete && unwritten.names().empty()) checkpoint.finish();
  unwritten.throw_if_any(cure);
  return exit_status(simulated.result.stop);
}

bool is_left_to_rank_0(const Command& command) {
  return is_worker_rank() && !std::holds_alternative<RunOptions>(command) && !std::holds_alternative<DayOptions>(command);
}

int write_maize(const MaizeOptions& options) {
  start_log(Verbosity::normal);
  exit_on_interrupts();
  const Mesh mesh = make_maize({options.rows, options.per_row, options.spacing_m[0], options.spacing_m[1], options.seed});
  // From here on a signal does not end the program at once, so that an unfinished file is completed.
  watch_for_interrupts();
  write_gltf(mesh, options.output);
  fmt::print("{}: {}, {}\n", options.output.string(), counted(mesh.triangles.size(), "triangle"),
             counted(mesh.organs.size(), "organ"));
  return exit_done;
}

}  // namespace sunfleck
