#pragma once
// A run or day that several processes work on, started by an MPI launcher: rank 0 does all that the program does alone, the
// others make replicates for it.

#include "app/engine.h"
#include "app/options.h"
#include "cluster/job.h"
#include "cluster/rank_helpers.h"
#include "io/scene_reader.h"
#include "transport/counters.h"
#include "transport/solve.h"

#include <functional>
#include <memory>
#include <string>

namespace sunfleck {

// Commands other than run and day: rank 0 works alone, the others have nothing to do.
[[nodiscard]] bool is_left_to_rank_0(const Command& command);

class Ranks {
 public:
  // Joins the job. A process that is alone has no job, and nothing below does anything then. Throws as join_job.
  Ranks();
  // Ends the others, and leaves the job with them; not where one is lost.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int count() const { return job_ ? job_->seat().ranks : 1; }
  [[nodiscard]] bool helps() const { return job_ && job_->seat().rank > 0; }

  // The same options with this rank's threads, where they are not asked for, and on another device of several alike.
  [[nodiscard]] RunOptions own_options(const RunOptions& options) const;

  // Rank 0: waits until the others have read the same scene; says what there is to say about them. Throws what went wrong
  // there.
  void gather(const Scene& scene, const CounterLayout& layout, const SolveSettings& settings);
  // For simulations; null if there are none.
  [[nodiscard]] ReplicateHelpers* helpers() { return helpers_.get(); }
  void set_stage(std::uint64_t stage);  // which of the lights of Help::set_light
  [[nodiscard]] bool interrupted() const { return helpers_ && helpers_->interrupted(); }
  // Rank 0 wants no more replicates.
  void release();

  // What another rank does with its part of the command: from scene to engine as rank 0 does, then this.
  struct Help {
    const Scene& scene;
    const CounterLayout& layout;
    Engine& engine;
    const SolveSettings& settings;
    std::function<void(std::uint64_t stage)> set_light;  // of the scene's model; may be empty
  };
  // `begin` reads the scene and so on, and calls the function it is given. Errors are rank 0's to tell. Returns the exit
  // status.
  int help(const std::function<void(const std::function<void(const Help&)>&)>& begin);

 private:
  void serve(const Help& help);

  std::unique_ptr<Job> job_;
  std::unique_ptr<RankHelpers> helpers_;  // rank 0's
  bool served_ = false;                   // another's: to the end
};

}  // namespace sunfleck
