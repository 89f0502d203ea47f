#include "app/commands.h"

#include "app/interrupt.h"
#include "app/ranks.h"
#include "app/result_folder.h"
#include "app/scene_source.h"
#include "app/simulation.h"
#include "base/log.h"
#include "canopy/maize.h"
#include "io/mesh_writer.h"

#include <fmt/format.h>

namespace sunfleck {

namespace {

int help_with_run(const RunOptions& options, Ranks& ranks) {
  return ranks.help([&](const auto& serve) {
    const Scene scene = read_scene(options.scene, {options.allow_outside});
    const SceneTree tree(scene.model);
    set_software_threads(options.threads);
    const CpuThreads threads(options.threads);
    Engine engine({options.device, options.device_turn}, tree.bvh, traced_scene(scene.model), tree.layout.words());
    const SolveSettings settings = solve_settings(options, scene);
    serve({scene, tree.layout, engine, settings, {}});
  });
}

}  // namespace

int run(const RunOptions& asked) {
  start_log(asked.quiet || asked.json ? Verbosity::quiet : Verbosity::normal);
  exit_on_interrupts();
  Stopwatch total;
  Stopwatch watch;
  Ranks ranks;
  const RunOptions options = ranks.own_options(asked);
  if (ranks.helps()) return help_with_run(options, ranks);
  const std::filesystem::path folder = result_folder(options);
  FolderLock lock(folder);

  const Scene scene = load_scene(options.scene, options.stand, {options.allow_outside});
  for (const std::string& warning : scene.warnings) warn(warning);
  const RadiationModel& model = scene.model;
  SolveSettings settings = solve_settings(options, scene);
  check_pictures(options, model);
  check_grid(options, scene);
  const Companions companions = read_companions(options, model);
  RunKeeper keeper(folder, options, scene, settings);
  const RunKeeper::Found found = options.resume ? keeper.find(model, make_counter_layout(model)) : RunKeeper::Found::nothing;
  if (found == RunKeeper::Found::finished) return tell_finished(folder, options, "run");
  settings.go_on_from = keeper.state();
  RunRecord::Seconds seconds;
  seconds.load = watch.lap();

  const SceneTree tree(model);
  seconds.bvh = watch.lap();

  set_software_threads(options.threads);
  const CpuThreads threads(options.threads);
  Engine engine({options.device, options.device_turn}, tree.bvh, traced_scene(model), tree.layout.words());
  RunRecord record = make_record(options, scene, settings, engine);
  record.ranks = ranks.count();
  ranks.gather(scene, tree.layout, settings);
  watch_for_interrupts();
  prepare_folder(folder, lock, found == RunKeeper::Found::begun ? EarlierRun::goes_on : EarlierRun::goes);
  if (options.resume) say(keeper.resume_line());
  say(device_line(record.device));
  seconds.device = watch.lap();

  RadiationResult result = simulate(model, tree.layout, engine, settings, SimulationAids{&keeper, &ranks});
  ranks.release();
  check_validation(engine);
  seconds.direct = result.direct.seconds;
  seconds.indirect = result.indirect.seconds;
  watch.lap();

  record.complete = is_done(result.stop);
  Losses losses;
  if (!write_results(folder, options, record, {scene, tree.layout, result, engine}, companions, losses)) {
    result.stop = StopReason::interrupted;
    record.complete = false;
  }
  check_validation(engine);
  record.not_written = losses.names();
  record.complete = record.complete && record.not_written.empty();
  const std::string hint = keeper.holds_state() ? "; --resume continues the run" : "";
  warn_if_short(settings, model, result, hint);
  seconds.write = watch.lap();
  seconds.total = total.lap();
  record.seconds = seconds;
  publish(folder, options, record, model, result, losses);
  if (record.complete && losses.names().empty()) keeper.finish();
  losses.complain(hint);
  return exit_status(result.stop);
}

int write_maize(const MaizeOptions& options) {
  start_log(Verbosity::normal);
  exit_on_interrupts();
  const Mesh mesh = make_maize({options.rows, options.per_row, options.spacing_m[0], options.spacing_m[1], options.seed});
  // From here on a signal does not end the program at once, so that a file once begun is finished.
  watch_for_interrupts();
  write_gltf(mesh, options.output);
  fmt::print("{}: {} triangles, {} organs\n", options.output.string(), mesh.triangles.size(), mesh.organs.size());
  return exit_done;
}

}  // namespace sunfleck
