#include "programs/viewer/live_light.h"

#include "base/error.h"
#include "base/file.h"
#include "base/folder_lock.h"
#include "programs/viewer/saved_scene.h"
#include "simulate/result_folder.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace sunfleck {
namespace {

// Landings of beams are kept for reuse with other optics while they fit into this many bytes.
constexpr std::size_t most_beam_bytes = std::size_t{512} << 20U;
// Errors of single sides are kept, and the light of triangles is estimated when the bounds are reached, while these errors fit into this
// many bytes: a field of ten million triangles does without.
constexpr std::size_t most_side_bytes = std::size_t{256} << 20U;
// Minimum pause between two results of one request: drawing a result takes copying and painting, which should need only a small
// part of the time.
constexpr double least_pause_s = 0.15;
constexpr double pause_per_second = 0.25;

// Returns a copy of the scene without its triangles.
Scene light_of_scene(Scene& scene) {
  Canopy canopy = std::exchange(scene.model.canopy, {});
  Scene light = scene;
  scene.model.canopy = std::move(canopy);
  return light;
}

SolveSettings live_settings(const RunOptions& options, const Scene& scene) {
  SolveSettings settings = solve_settings(options, scene, options.threads);
  const std::size_t side_bytes = 2 * scene.model.canopy.size() * scene.model.bands.size() * 2 * sizeof(double);
  if (side_bytes <= most_side_bytes) settings.element_errors = ElementErrors::keep_sides_and_refine;
  return settings;
}

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

std::string what_went_wrong(const std::exception& error) {
  const bool memory =
      dynamic_cast<const std::bad_alloc*>(&error) != nullptr || dynamic_cast<const std::length_error*>(&error) != nullptr;
  return memory ? "out of memory (allocation failed); close other programs or load a smaller scene" : error.what();
}

std::uint64_t rays_of(const RadiationResult& result) {
  return result.direct.rays + result.indirect.packets + result.indirect.sky_rays;
}

}  // namespace

LiveLight::LiveLight(Simulation& simulation, const RunOptions& options, std::function<void()> notify)
    : original_(light_of_scene(simulation.scene())),
      simulation_(simulation),
      options_(options),
      notify_(std::move(notify)),
      settings_(live_settings(options, simulation.scene())),
      has_receivers_(remove_receivers(simulation.scene())),
      request_(request_of(original_)) {
  simulation.remember_beams(most_beam_bytes);
  asked_ = 1;
  asked_at_ = Clock::now();
  worker_ = std::thread([this] { work(); });
}

LiveLight::~LiveLight() {
  {
    const std::lock_guard lock(news_mutex_);
    quitting_ = true;
  }
  order_.notify_all();
  worker_.join();
}

std::uint64_t LiveLight::ask(const LightRequest& request) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(news_mutex_);
    request_ = request;
    number = ++asked_;
    asked_at_ = Clock::now();
  }
  order_.notify_all();
  return number;
}

void LiveLight::save(const std::filesystem::path& folder) {
  {
    const std::lock_guard lock(news_mutex_);
    save_folder_ = folder;
    save_asked_ = true;
    news_.saving = true;
    news_.saved.reset();
  }
  order_.notify_all();
}

LightNews LiveLight::news() const {
  const std::lock_guard lock(news_mutex_);
  return news_;
}

bool LiveLight::wait_for_order() {
  std::unique_lock lock(news_mutex_);
  order_.wait(lock, [this] { return quitting_ || asked_ != news_.request || (save_asked_ && news_.version > 0); });
  return !quitting_;
}

void LiveLight::work() {
  while (wait_for_order()) {
    LightRequest request;
    std::uint64_t number = 0;
    {
      const std::lock_guard lock(news_mutex_);
      request = request_;
      number = asked_;
    }
    std::string problem;
    try {
      if (number != news().request) {
        simulate_request(request, number);
      } else if (save_asked_) {
        save_if_asked();
      }
      continue;
    } catch (const std::exception& error) {
      problem = what_went_wrong(error);
    }
    {
      const std::lock_guard lock(news_mutex_);
      news_.request = number;
      news_.problem = problem;
    }
    notify_();
  }
}

bool LiveLight::wants_result() const {
  if (save_asked_) return true;
  const std::lock_guard lock(news_mutex_);
  const double pause_s = std::max(least_pause_s, pause_per_second * seconds_between(asked_at_, Clock::now()));
  return news_.result_request != news_.request || seconds_between(last_result_, Clock::now()) >= pause_s;
}

void LiveLight::simulate_request(const LightRequest& request, std::uint64_t number) {
  std::optional<double> assumed;
  {
    const std::lock_guard lock(result_mutex_);
    // The old result belongs to the previous light and is removed, because the scene no longer describes it.
    Scene& scene = simulation_.scene();
    assumed = grant(request, original_, scene.model);
    granted_ = request;
    const bool changed = !first_difference(request_of(original_), request).empty();
    scene.title = original_.title + (changed ? " (light changed)" : "");
    scene.digest = original_.digest + (changed ? "-changed-" + digest_of(request) : "");
    result_.reset();
  }
  {
    const std::lock_guard lock(news_mutex_);
    news_.request = number;
    news_.problem.clear();
    news_.assumed_diffuse_share = assumed;
    news_.sun = simulation_.model().sun;
    news_.incoming = simulation_.model().bands;
  }
  Monitor monitor;
  monitor.interrupted = [this, number] { return superseded(number); };
  monitor.wants_result = [this] { return wants_result(); };
  monitor.receive_result = [this, number](RadiationResult result) { take_result(std::move(result), number, false); };
  RadiationResult result = simulation_.solve(settings_, monitor);
  if (!superseded(number)) take_result(std::move(result), number, true);
}

void LiveLight::take_result(RadiationResult result, std::uint64_t number, bool complete) {
  if (superseded(number)) return;
  // The result is stored before it is announced, so that anyone notified finds it.
  const std::uint64_t version = news().version + 1;
  {
    const std::lock_guard lock(result_mutex_);
    result_ = std::move(result);
    stamp_ = {version, number, complete};
  }
  tell(*result_, number, complete);
  notify_();
  if (save_asked_) save_if_asked();
}

void LiveLight::tell(const RadiationResult& result, std::uint64_t number, bool complete) {
  const std::lock_guard lock(news_mutex_);
  last_result_ = Clock::now();
  news_.seconds = seconds_between(asked_at_, last_result_);
  ++news_.version;
  news_.result_request = number;
  news_.complete = complete;
  news_.stop = result.stop;
  news_.rays = rays_of(result);
  news_.spared_beams = simulation_.spared_beams();
  news_.direct_error = result.direct.relative_error;
  news_.indirect_error = result.indirect.relative_error;
  news_.direct_bound = settings_.accuracy.direct;
  news_.indirect_bound = settings_.accuracy.indirect;
  news_.bands = result.bands;
  news_.layers = result.layers;
}

void LiveLight::save_if_asked() {
  std::filesystem::path folder;
  {
    const std::lock_guard lock(news_mutex_);
    folder = save_folder_;
  }
  SaveOutcome outcome;
  try {
    if (!result_) throw_failure(folder.string(), "there is no result to save", "change the light, or load the scene again");
    write(folder, *result_);
    outcome.done = true;
    outcome.text = fmt::format("saved in {}{}", folder.string(), is_done(result_->stop) ? "" : " (incomplete)");
    if (has_receivers_) outcome.text += "; only `run` writes planes and sensors";
  } catch (const std::exception& error) {
    outcome.text = what_went_wrong(error);
  }
  {
    const std::lock_guard lock(news_mutex_);
    save_asked_ = false;
    news_.saving = false;
    news_.saved = outcome;
  }
  notify_();
}

void LiveLight::write(const std::filesystem::path& folder, const RadiationResult& result) {
  FolderLock lock(folder);
  check_inputs(folder, simulation_.scene());
  prepare_folder(folder, lock);
  SimulatedScene simulated = simulation_.simulated(settings_, result);
  if (has_receivers_) simulated.record.not_written.emplace_back("planes and sensors");
  save_scene({original_, granted_, simulation_.scene(), settings_.accuracy, options_.seed}, folder);
  write_whole_result(folder, options_, simulated, simulated.record).throw_if_any();
}

}  // namespace sunfleck
