#include "simulate/simulation.h"

#include "base/error.h"
#include "base/file.h"
#include "base/threads.h"
#include "base/version.h"
#include "physics/light/beam_grid.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/receivers/sensors.h"
#include "simulate/checkpoint.h"
#include "simulate/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunfleck {
namespace {

// Larger stands keep the light of single triangles as it was counted: estimating it takes some 400 bytes each.
constexpr std::size_t most_refined_triangles = std::size_t{1} << 21U;

// Returns the number of rays per sensor. Half-widths at a point are about ten times the bound of the totals: a few percent
// where that is 0.3 %.
std::uint32_t sensor_rays(const SolveSettings& settings) {
  const double bound = settings.grid_m || settings.passes ? 0.01 : settings.accuracy.indirect;
  return static_cast<std::uint32_t>(std::clamp(3.0 / bound, 64.0, 16384.0));
}

// Returns the bound on sensors that the scene asks for, if any. A run that is over gives them no more time.
std::optional<SensorBound> sensor_bound(const SolveSettings& settings, const RadiationResult& result, const Stopwatch& watch) {
  if (settings.accuracy.of != ErrorTarget::sensors || settings.grid_m || settings.passes) return std::nullopt;
  SensorBound bound{settings.accuracy.indirect, {}, {}, {}};
  for (const BandResult& band : result.bands) bound.least_w_m2.push_back(least_judged_share * band.incident.value);
  bound.time_is_up = [&settings, &watch, is_over = !is_done(result.stop)] {
    return is_over || (settings.max_seconds && watch.seconds() >= *settings.max_seconds);
  };
  return bound;
}

std::shared_ptr<Tracing> open_tracing(const RadiationModel& model, const DeviceRequest& device, EngineUse use) {
  set_software_threads(device.threads);
  const CpuThreads limit(device.threads);
  return std::make_shared<Tracing>(model, DeviceChoice(device.device, device.device_turn), use);
}

}  // namespace

SolveSettings solve_settings(const WorkRequest& work, const Scene& scene, int threads) {
  SolveSettings settings;
  settings.accuracy = scene.accuracy;
  settings.accuracy.direct = work.direct_error.value_or(scene.accuracy.direct);
  settings.accuracy.indirect = work.indirect_error.value_or(scene.accuracy.indirect);
  settings.seed = work.seed;
  settings.grid_m = work.grid_m;
  settings.passes = work.passes;
  settings.max_rays = work.max_rays;
  settings.max_seconds = work.max_seconds;
  settings.fit_to_time = !work.resume;
  settings.replicates_at_once = cpu_thread_count(threads);
  settings.memory_bytes = static_cast<double>(work.memory_bytes.value_or(available_memory_bytes() / 4));
  const bool of_elements = work.triangle_light || scene.accuracy.of == ErrorTarget::triangle;
  const bool few = scene.model.canopy.size() <= most_refined_triangles;
  settings.element_errors = !of_elements ? ElementErrors::skip : few ? ElementErrors::refine : ElementErrors::keep;
  return settings;
}

void check_grid(const WorkRequest& work, const Scene& scene) {
  if (!work.grid_m) return;
  const double replicates = work.passes.value_or(fixed_grid_replicates);
  const double finest_m = std::sqrt(scene.model.plot.area_m2() / (replicates * static_cast<double>(max_grid_rays)));
  if (*work.grid_m >= finest_m) return;
  throw_input(
      fmt::format("--grid {}", *work.grid_m),
      fmt::format("{} replicates on this plot reach {:.2g} m, with at most {} rays each", replicates, finest_m, max_grid_rays),
      "give a wider grid or more --passes");
}

bool RunHooks::interrupted() const {
  return monitor.is_interrupted() || (ranks != nullptr && ranks->interrupted());
}

ReplicateHelpers* RunHooks::helpers() const {
  return ranks != nullptr ? ranks->helpers() : nullptr;
}

Simulation::Simulation(std::shared_ptr<Scene> scene, std::shared_ptr<Tracing> tracing, int threads)
    : scene_(std::move(scene)), tracing_(std::move(tracing)), threads_(threads) {}

Simulation::Simulation(Scene scene, const DeviceRequest& device, EngineUse use)
    : scene_(std::make_shared<Scene>(std::move(scene))),
      tracing_(open_tracing(scene_->model, device, use)),
      threads_(device.threads) {}

Simulation Simulation::with_model(RadiationModel model) const {
  auto scene = std::make_shared<Scene>();
  scene->title = scene_->title;
  scene->accuracy = scene_->accuracy;
  scene->model = std::move(model);
  return {std::move(scene), tracing_, threads_};
}

void Simulation::relight(const SceneText& light, const SceneAccess& access) {
  std::shared_ptr<Scene> scene = scene_.use_count() == 1 ? scene_ : std::make_shared<Scene>(*scene_);
  sunfleck::relight(*scene, light, access);
  scene_ = std::move(scene);
}

void Simulation::remember_beams(std::size_t most_bytes) {
  beams_ = std::make_unique<RememberedBeams>(tracing_->engine.tracer(), most_bytes);
}

RadiationResult Simulation::solve(const SolveSettings& settings, const Monitor& monitor, ReplicateHelpers* helpers) {
  const CpuThreads limit(threads_);
  const RadiationModel& model = scene_->model;
  Stopwatch watch;
  RadiationResult result = sunfleck::solve(model, layout(), tracer(), settings, monitor, helpers);
  add_sensors(model, settings, monitor, watch, result);
  return result;
}

void Simulation::add_sensors(const RadiationModel& model, const SolveSettings& settings, const Monitor& monitor,
                             const Stopwatch& watch, RadiationResult& result) {
  if (model.sensors.empty() || result.stop == StopReason::interrupted) return;
  const CpuThreads limit(threads_);
  SensorSettings sensors;
  sensors.rays = sensor_rays(settings);
  sensors.seed = settings.seed;
  sensors.confidence = settings.accuracy.confidence;
  sensors.bound = sensor_bound(settings, result, watch);
  if (sensors.bound && monitor.report) {
    sensors.bound->report = [&, of_run = result.direct.rays + result.indirect.sky_rays + result.indirect.packets](
                                double relative_error, std::uint64_t rays) {
      Progress progress{.stage = Progress::Stage::sensors, .rays = of_run + rays, .fraction = 1.0};
      progress.pass = Progress::Pass::sensors;
      progress.relative_error = relative_error;
      progress.bound = sensors.bound->relative;
      monitor.report(progress);
    };
  }
  Stopwatch sensor_watch;
  auto readings = measure_sensors(model, layout(), tracer(), sensors, monitor.interrupted);
  if (!readings) {
    result.stop = StopReason::interrupted;
    return;
  }
  if (is_done(result.stop) && !is_done(readings->stop)) result.stop = readings->stop;
  result.sensors = std::move(readings->points);
  result.sensor_means = std::move(readings->means);
  result.of_sensors = readings->summary;
  result.of_sensors.seconds = sensor_watch.seconds();
}

SharedOutcome Simulation::solve_lights(Lights lights, const SolveSettings& settings, const Monitor& monitor,
                                       ReplicateHelpers* helpers, const WantedSums& sums, const TakeLight& take) {
  const CpuThreads limit(threads_);
  return sunfleck::solve_lights(lights, layout(), tracer(), settings, monitor, helpers, sums, take);
}

SimulatedScene Simulation::run(const SolveSettings& settings, const RunHooks& hooks) {
  Stopwatch watch;
  Monitor monitor = hooks.monitor;
  if (hooks.ranks != nullptr) {
    monitor.interrupted = [&] { return hooks.interrupted(); };
  }
  if (hooks.checkpoint != nullptr) hooks.checkpoint->attend(monitor, model());
  SimulatedScene done = simulated(settings, solve(settings, monitor, hooks.helpers()));
  if (hooks.ranks != nullptr) {
    done.record.ranks = hooks.ranks->count();
    hooks.ranks->release();
  }
  check_validation();
  done.record.seconds.total = done.record.seconds.bvh + done.record.seconds.device + watch.lap();
  return done;
}

SimulatedScene Simulation::simulated(const SolveSettings& settings, RadiationResult result) const {
  SimulatedScene done{scene_, tracing_, record(settings), std::move(result)};
  done.record.complete = is_done(done.result.stop);
  done.record.seconds.direct = done.result.direct.seconds;
  done.record.seconds.indirect = done.result.indirect.seconds;
  return done;
}

RunRecord Simulation::record(const SolveSettings& settings) const {
  RunRecord record;
  record.version = version();
  record.commit = commit();
  record.title = scene_->title;
  record.scene_file = scene_->file.filename().string();
  record.scene_digest = scene_->digest;
  record.seed = settings.seed;
  record.accuracy = settings.accuracy;
  record.grid_m = settings.grid_m;
  record.passes = settings.passes;
  record.max_rays = settings.max_rays;
  record.max_seconds = settings.max_seconds;
  if (settings.memory_bytes) record.memory_bytes = static_cast<std::uint64_t>(*settings.memory_bytes);
  record.threads = threads_;
  record.device = device();
  record.seconds.bvh = tracing_->build_s;
  record.seconds.device = tracing_->open_s;
  return record;
}

std::size_t Simulation::tree_bytes() const {
  const Bvh& bvh = tracing_->tree.bvh;
  return bvh.nodes.size() * sizeof(BvhNode) + bvh.triangles.size() * sizeof(BvhTriangle);
}

void Simulation::check_validation() const {
  const std::vector<std::string> messages = tracing_->engine.validation_messages();
  if (messages.empty()) return;
  throw_failure(messages.front(), fmt::format("{} messages of the Vulkan validation layer", messages.size()),
                "report it with the scene and the device");
}

}  // namespace sunfleck
