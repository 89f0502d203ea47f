#include "app/repeated_simulation.h"

#include "app/result_folder.h"
#include "base/error.h"

#include <utility>

namespace sunfleck {

TracingKit::TracingKit(const RadiationModel& model, const std::string& device)
    : tree(model), engine({device}, tree.bvh, traced_scene(model), tree.layout.words()) {}

void SimulatedScene::write(const RunOptions& options) const {
  const std::filesystem::path folder = result_folder(options);
  FolderLock lock(folder);
  check_pictures(options, scene->model);
  prepare_folder(folder, lock);
  RunRecord written = record;
  Losses losses;
  Stopwatch watch;
  const bool all = write_results(folder, options, written, {*scene, kit->tree.layout, result, kit->engine}, {}, losses);
  written.not_written = losses.names();
  written.complete = written.complete && all && written.not_written.empty();
  written.seconds.write = watch.lap();
  written.seconds.total += written.seconds.write;
  publish(folder, options, written, scene->model, result, losses);
  losses.complain();
}

RepeatedSimulation::RepeatedSimulation(Scene scene, const std::string& device, int threads)
    : scene_(std::make_shared<Scene>(std::move(scene))), threads_(threads) {
  set_software_threads(threads);
  const CpuThreads limit(threads);
  Stopwatch watch;
  kit_ = std::make_shared<TracingKit>(scene_->model, device);
  seconds_.bvh = watch.lap();
}

void RepeatedSimulation::relight(const SceneText& light, const SceneAccess& access) {
  // Results at hand hold on to the scene they are of.
  std::shared_ptr<Scene> scene = scene_.use_count() == 1 ? scene_ : std::make_shared<Scene>(*scene_);
  sunfleck::relight(*scene, light, access);
  scene_ = std::move(scene);
}

SimulatedScene RepeatedSimulation::run(const RunOptions& options, const Monitor& monitor) {
  const SolveSettings settings = solve_settings(options, *scene_);
  check_grid(options, *scene_);
  const CpuThreads limit(threads_);
  Stopwatch watch;
  RunOptions recorded = options;
  recorded.threads = threads_;
  SimulatedScene simulated{scene_, kit_, make_record(recorded, *scene_, settings, kit_->engine), {}};
  simulated.result = simulate(scene_->model, kit_->tree.layout, kit_->engine, settings, monitor);
  check_validation(kit_->engine);
  simulated.record.complete = is_done(simulated.result.stop);
  seconds_.direct = simulated.result.direct.seconds;
  seconds_.indirect = simulated.result.indirect.seconds;
  seconds_.total = seconds_.bvh + watch.lap();
  simulated.record.seconds = std::exchange(seconds_, {});
  return simulated;
}

std::size_t RepeatedSimulation::tree_bytes() const {
  const Bvh& bvh = kit_->tree.bvh;
  return bvh.nodes.size() * sizeof(BvhNode) + bvh.triangles.size() * sizeof(BvhTriangle);
}

}  // namespace sunfleck
