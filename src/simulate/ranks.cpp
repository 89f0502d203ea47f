#include "simulate/ranks.h"

#include "base/digest.h"
#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "base/threads.h"
#include "base/version.h"
#include "files/results/tables/work_settings.h"
#include "physics/transport/indirect/replicate_maker.h"
#include "simulate/cluster/rank_worker.h"
#include "simulate/interrupt.h"
#include "simulate/result_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

namespace sunfleck {
namespace {

// Returns a text that must be the same on all ranks of a job.
std::string what_is_simulated(const Simulation& simulation, const std::string& task) {
  return fmt::format("scene {} with {} counters in version {}, {}, for {}", simulation.scene().digest,
                     simulation.layout().words(), version(), commit(), task);
}

// Makes replicates in the lights of one stage.
class ReplicateBench {
 public:
  ReplicateBench(Simulation& simulation, std::vector<RadiationModel> lights)
      : lights_(std::move(lights)), maker_(lights_, simulation.layout(), simulation.tracing().engine.tracer()) {}

  std::optional<ReplicateSet> make(const ReplicateOrder& order, const StopQuestion& stop) {
    const auto conversions = conversions_of(order);
    return maker_.make(order, *conversions, stop);
  }

 private:
  // Returns the conversions of the last order if they fit this one, which is nearly always the case.
  std::shared_ptr<const std::vector<Conversion>> conversions_of(const ReplicateOrder& order) {
    const std::lock_guard lock(mutex_);
    std::vector<double> rays;
    for (std::size_t k = 0; k < lights_.size(); ++k) rays.push_back(order.rays_of(k));
    if (conversions_ && rays == rays_) return conversions_;
    rays_ = std::move(rays);
    auto conversions = std::make_shared<std::vector<Conversion>>();
    conversions->reserve(lights_.size());
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      conversions->push_back(maker_.conversion(maker_.incidence(rays_[k], order.aimed, k), k));
    }
    conversions_ = std::move(conversions);
    return conversions_;
  }

  std::vector<RadiationModel> lights_;
  ReplicateMaker maker_;
  std::mutex mutex_;
  std::vector<double> rays_;  // [light]
  std::shared_ptr<const std::vector<Conversion>> conversions_;
};

}  // namespace

std::string task_text(const std::string& command, const SceneRequest& scene, const ResultRequest& result,
                      const SolveSettings& settings) {
  nlohmann::ordered_json work = {{"exports", result.exports}, {"triangles", settings.element_errors}};
  add_work_settings(work, settings.accuracy, settings.grid_m, settings.passes, settings.max_rays);
  Digest digest;
  digest.add(work.dump());
  return fmt::format("{} into {} with seed {} and settings {}", command, printable(result_folder(result, scene.scene).string()),
                     settings.seed, digest.text());
}

Ranks::Ranks() : job_(join_job()) {
  if (job_ && job_->seat().rank == 0) helpers_ = std::make_unique<RankHelpers>(job_->mailbox());
}

Ranks::~Ranks() {
  if (!job_) return;
  try {
    if (helpers_ ? helpers_->wait_until_gone() : served_) job_->finish();
  } catch (const std::exception&) {  // without a proper end the launcher ends the others
  }
}

void Ranks::take_seat(DeviceRequest& request) const {
  if (!job_) return;
  if (request.threads == 0) request.threads = job_->seat().threads;
  request.device_turn = job_->seat().local_rank;
}

void Ranks::gather(const Simulation& simulation, const SolveSettings& settings, const std::string& task) {
  if (!helpers_) return;
  if (!job_->seat().hint.empty()) say(job_->seat().hint);
  helpers_->wait_until_ready(what_is_simulated(simulation, task));
  if (settings.max_rays) {
    say("--max-rays: rank 0 alone makes the replicates, one after another");
    release();
  } else {
    say(fmt::format("{} ranks", count()));
  }
}

void Ranks::set_stage(std::uint64_t stage) {
  if (helpers_) helpers_->set_stage(stage);
}

void Ranks::release() {
  if (helpers_) helpers_->release();
}

bool Ranks::serve(const std::function<void(const std::function<void(const Task&)>&)>& begin) {
  start_log(Verbosity::silent);
  watch_for_interrupts();
  const auto report = [this](ErrorKind kind, const std::string& text) {
    served_ = report_failure(job_->mailbox(), job_->seat().host, static_cast<int>(kind), text);
  };
  try {
    begin([this](const Task& task) { make_replicates(task); });
  } catch (const Error& error) {
    report(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    report(ErrorKind::failure, three_part_message("out of memory", "allocation failed", "run fewer ranks per machine"));
  } catch (const std::exception& error) {
    report(ErrorKind::failure,
           three_part_message("a rank", error.what(), "free memory or threads, or run fewer ranks per machine"));
  }
  return served_;
}

void Ranks::make_replicates(const Task& task) {
  const CpuThreads limit(task.simulation.threads());
  std::optional<ReplicateBench> bench;
  RankService service;
  service.slots = static_cast<std::size_t>(task.settings.replicates_at_once);
  service.host = job_->seat().host;
  service.scene = what_is_simulated(task.simulation, task.text);
  service.set_stage = [&](std::uint64_t stage) {
    bench.emplace(task.simulation, task.lights ? task.lights(stage) : std::vector{task.simulation.model()});
  };
  service.make = [&](const ReplicateOrder& order, const StopQuestion& stop) { return bench->make(order, stop); };
  service.interrupted = sunfleck::interrupted;
  served_ = sunfleck::serve(job_->mailbox(), service);
}

}  // namespace sunfleck
