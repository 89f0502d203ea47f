#include "programs/viewer/live_light.h"

#include "base/error.h"
#include "base/folder_lock.h"
#include "physics/transport/solve/darkness.h"
#include "programs/viewer/saved_scene.h"
#include "simulate/day_blocks.h"
#include "simulate/result_folder.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>

namespace sunfleck {
namespace {

// Landings of beams are kept for reuse with other optics while they fit into this many bytes.
constexpr std::size_t most_beam_bytes = std::size_t{512} << 20U;
// Errors of single sides are kept, and the light of triangles is estimated when the bounds are reached, while these errors fit
// into this many bytes: a field of ten million triangles does without.
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

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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

LiveLight::LiveLight(Simulation& simulation, const RunOptions& options, std::function<void()> notify, double played_s)
    : original_(light_of_scene(simulation.scene())),
      simulation_(simulation),
      options_(options),
      notify_(std::move(notify)),
      settings_(live_settings(options, simulation.scene())),
      played_s_(played_s),
      has_receivers_(remove_receivers(simulation.scene())),
      // The results of the last ones are kept meanwhile.
      most_in_memory_(lights_in_memory(simulation.model(), true, false, 0.5 * settings_.memory_bytes.value())),
      most_together_(most_in_memory_),
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

std::uint64_t LiveLight::ask(const LightRequest& request, std::vector<LightRequest> ahead) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(news_mutex_);
    request_ = request;
    ahead_ = std::move(ahead);
    if (ahead_.empty()) kept_.clear();
    in_vain_ = ahead_.empty() || !is_foreseen();
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
  order_.wait(lock, [this] {
    return quitting_ || asked_ != news_.request || !ahead_.empty() || (save_asked_ && !is_played_ && news_.version > 0);
  });
  return !quitting_;
}

void LiveLight::work() {
  while (wait_for_order()) {
    LightRequest request;
    std::vector<LightRequest> ahead;
    std::uint64_t number = 0;
    {
      const std::lock_guard lock(news_mutex_);
      request = request_;
      ahead = ahead_;
      number = asked_;
    }
    std::string problem;
    try {
      if (number != news().request) {
        std::vector<LightRequest> moments = ahead;
        moments.insert(moments.begin(), request);
        const bool shown = show_kept() || (!ahead.empty() && simulate_together(moments, 2.0 * played_s_));
        if (!shown) simulate_request(request, number);
      } else if (save_asked_ && !is_played_) {
        save_if_asked();
      } else if (!simulate_together(ahead, static_cast<double>(most_together_) * played_s_)) {
        const std::lock_guard lock(news_mutex_);
        if (asked_ == number) ahead_.clear();
      }
      continue;
    } catch (const std::exception& error) {
      problem = what_went_wrong(error);
    }
    {
      const std::lock_guard lock(news_mutex_);
      news_.request = std::max(news_.request, number);
      news_.problem = problem;
      together_.clear();
      if (asked_ == number) ahead_.clear();
    }
    notify_();
  }
}

bool LiveLight::wants_result() const {
  if (save_asked_) return true;
  const std::lock_guard lock(news_mutex_);
  const double pause_s = std::max(least_pause_s, pause_per_second * seconds_since(asked_at_));
  return news_.result_request != news_.request || seconds_since(last_result_) >= pause_s;
}

void LiveLight::begin_request(const LightRequest& request, std::uint64_t number) {
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
}

void LiveLight::simulate_request(const LightRequest& request, std::uint64_t number) {
  is_played_ = false;
  begin_request(request, number);
  Monitor monitor;
  monitor.interrupted = [this, number] { return superseded(number); };
  monitor.wants_result = [this] { return wants_result(); };
  monitor.receive_result = [this, number](RadiationResult result) { take_result(std::move(result), number, false); };
  RadiationResult result = simulation_.solve(settings_, monitor);
  if (!superseded(number)) take_result(std::move(result), number, true);
}

LiveLight::Kept::const_iterator LiveLight::find_kept(const LightRequest& request) const {
  return std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) { return one.first == request; });
}

bool LiveLight::is_foreseen() const {
  return find_kept(request_) != kept_.end() || std::find(together_.begin(), together_.end(), request_) != together_.end();
}

std::vector<LightRequest> LiveLight::missing(const std::vector<LightRequest>& moments) const {
  const std::lock_guard lock(news_mutex_);
  std::vector<LightRequest> missing;
  for (const LightRequest& moment : moments) {
    const bool is_new = find_kept(moment) == kept_.end() && std::find(missing.begin(), missing.end(), moment) == missing.end();
    if (is_new && missing.size() < most_together_) missing.push_back(moment);
  }
  return missing;
}

std::optional<RadiationModel> LiveLight::granted(const LightRequest& request) const {
  RadiationModel light = simulation_.model();
  try {
    grant(request, original_, light);
  } catch (const Error&) {
    return std::nullopt;
  }
  return light;
}

bool LiveLight::simulate_together(const std::vector<LightRequest>& moments, double most_s) {
  if (most_together_ < 2) return false;
  std::vector<LightRequest> together = missing(moments);
  std::vector<RadiationModel> lights;
  for (const LightRequest& moment : together) {
    std::optional<RadiationModel> light = granted(moment);
    if (!light || is_dark(*light)) break;
    lights.push_back(*std::move(light));
  }
  together.resize(lights.size());
  if (lights.empty()) return false;
  {
    const std::lock_guard lock(news_mutex_);
    if (ahead_.empty()) return false;  // the day is no longer played
    together_ = together;
    in_vain_ = asked_ != news_.request && !is_foreseen();
  }
  SolveSettings settings = settings_;
  settings.element_errors = ElementErrors::skip;
  settings.max_seconds = most_s;
  Monitor monitor;
  monitor.interrupted = [this] { return quitting_ || in_vain_; };
  monitor.report = [this](const Progress&) { show_kept(); };
  bool in_time = true;
  const auto keep = [&](std::size_t moment, RadiationResult result, const SharedOutcome&) {
    if (result.stop == StopReason::interrupted) return;
    in_time = result.direct.replicates >= 2;
    const std::lock_guard lock(news_mutex_);
    if (in_time && !ahead_.empty()) kept_.emplace_back(together[moment], std::move(result));
  };
  try {
    static_cast<void>(simulation_.solve_lights(lights, settings, monitor, nullptr, {}, keep));
  } catch (const std::bad_alloc&) {
    in_time = false;  // fewer moments may fit into the memory
  }
  {
    const std::lock_guard lock(news_mutex_);
    together_.clear();
  }
  most_together_ = in_time ? std::min(2 * most_together_, most_in_memory_) : most_together_ / 2;
  show_kept();
  return in_time;
}

bool LiveLight::show_kept() {
  LightRequest request;
  RadiationResult result;
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(news_mutex_);
    const auto shown = find_kept(request_);
    if (asked_ == news_.request || ahead_.empty() || shown == kept_.end()) return false;
    request = request_;
    number = asked_;
    result = std::move(kept_[static_cast<std::size_t>(shown - kept_.begin())].second);
    kept_.erase(kept_.begin(), shown + 1);
  }
  is_played_ = true;
  begin_request(request, number);
  take_result(std::move(result), number, true);
  return true;
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
  if (save_asked_ && !is_played_) save_if_asked();
}

void LiveLight::tell(const RadiationResult& result, std::uint64_t number, bool complete) {
  const std::lock_guard lock(news_mutex_);
  last_result_ = Clock::now();
  news_.seconds = seconds_since(asked_at_);
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
  check_folder(folder, simulation_.scene(), ResultOf::run);
  prepare_folder(folder, lock, ResultOf::run);
  SimulatedScene simulated = simulation_.simulated(settings_, result);
  if (has_receivers_) simulated.record.not_written.emplace_back("planes and sensors");
  save_scene({original_, granted_, simulation_.scene(), settings_.accuracy, options_.seed}, folder);
  write_whole_result(folder, options_, simulated, simulated.record).throw_if_any();
}

}  // namespace sunfleck
