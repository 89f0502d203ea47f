#include "app/ranks.h"

#include "app/interrupt.h"
#include "app/simulation.h"
#include "base/error.h"
#include "base/log.h"
#include "cluster/launch.h"
#include "cluster/rank_worker.h"
#include "transport/replicate.h"

#include <fmt/format.h>

#include <mutex>
#include <new>
#include <optional>
#include <variant>

namespace sunfleck {
namespace {

// The same on all ranks of a job.
std::string what_is_simulated(const Scene& scene, const CounterLayout& layout) {
  return fmt::format("scene {} with {} counters in version {}, {}", scene.digest, layout.words(), version(), commit());
}

// Makes replicates in the light of one stage.
class Bench {
 public:
  Bench(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer) : maker_(model, layout, tracer) {}

  std::optional<Replicate> make(const ReplicateOrder& order, const StopQuestion& stop) {
    const std::shared_ptr<const Tally> tally = tally_of(order);
    return maker_.make(order, *tally, stop);
  }

 private:
  // That of the last order will nearly always do.
  std::shared_ptr<const Tally> tally_of(const ReplicateOrder& order) {
    const std::lock_guard lock(mutex_);
    if (!tally_ || order.beam_rays != beam_rays_) {
      beam_rays_ = order.beam_rays;
      tally_ = std::make_shared<const Tally>(maker_.tally(maker_.incidence(beam_rays_), ElementErrors::skip));
    }
    return tally_;
  }

  ReplicateMaker maker_;
  std::mutex mutex_;
  double beam_rays_ = 0.0;
  std::shared_ptr<const Tally> tally_;
};

}  // namespace

bool is_left_to_rank_0(const Command& command) {
  return is_silent_rank() && !std::holds_alternative<RunOptions>(command) && !std::holds_alternative<DayOptions>(command);
}

Ranks::Ranks() : job_(join_job()) {
  if (job_ && job_->seat().rank == 0) helpers_ = std::make_unique<RankHelpers>(job_->mailbox());
}

Ranks::~Ranks() {
  if (!job_) return;
  try {
    if (helpers_ ? helpers_->wait_until_gone() : served_) job_->finish();
  } catch (const std::exception&) {  // without an orderly end the launcher ends the others
  }
}

RunOptions Ranks::own_options(const RunOptions& options) const {
  RunOptions own = options;
  if (!job_) return own;
  if (own.threads == 0) own.threads = job_->seat().threads;
  own.device_turn = job_->seat().local_rank;
  return own;
}

void Ranks::gather(const Scene& scene, const CounterLayout& layout, const SolveSettings& settings) {
  if (!helpers_) return;
  if (!job_->seat().hint.empty()) say(job_->seat().hint);
  helpers_->wait_until_ready(what_is_simulated(scene, layout));
  if (settings.max_rays) {
    say("--max-rays: one replicate is made after the other, by rank 0 alone");
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

int Ranks::help(const std::function<void(const std::function<void(const Help&)>&)>& begin) {
  start_log(Verbosity::silent);
  watch_for_interrupts();
  const auto report = [this](ErrorKind kind, const std::string& text) {
    served_ = report_failure(job_->mailbox(), job_->seat().host, static_cast<int>(kind), text);
  };
  try {
    begin([this](const Help& help) { serve(help); });
  } catch (const Error& error) {
    report(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    report(ErrorKind::failure, three_part_message("out of memory", "the system gives no more", "put fewer ranks on a machine"));
  }
  return served_ ? exit_done : exit_failed;
}

void Ranks::serve(const Help& help) {
  std::optional<Bench> bench;
  RankService service;
  service.slots = static_cast<std::size_t>(help.settings.replicates_at_once);
  service.host = job_->seat().host;
  service.scene = what_is_simulated(help.scene, help.layout);
  service.set_stage = [&](std::uint64_t stage) {
    if (help.set_light) help.set_light(stage);
    bench.emplace(help.scene.model, help.layout, help.engine.tracer());
  };
  service.make = [&](const ReplicateOrder& order, const StopQuestion& stop) { return bench->make(order, stop); };
  service.interrupted = sunfleck::interrupted;
  served_ = sunfleck::serve(job_->mailbox(), service);
}

}  // namespace sunfleck
