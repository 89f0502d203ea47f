#pragma once
// Shares a run or a day among several processes, started by an MPI launcher: rank 0 does everything that the program does
// alone, and the others are workers that make replicates for it.

#include "physics/transport/solve/solve.h"
#include "simulate/cluster/job.h"
#include "simulate/cluster/rank_helpers.h"
#include "simulate/requests.h"
#include "simulate/simulation.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sunfleck {

// Returns a text that is the same on all ranks that were given the same: `command` with its times, the folder and the exports
// of its result, and the settings of its work.
[[nodiscard]] std::string task_text(const std::string& command, const SceneRequest& scene, const ResultRequest& result,
                                    const SolveSettings& settings);

class Ranks {
 public:
  // Joins the job. A single process has no job, and then none of the functions below do anything. Throws as join_job.
  Ranks();
  // Ends the workers and leaves the job with them, unless one was lost.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int count() const { return job_ ? job_->seat().ranks : 1; }
  [[nodiscard]] bool is_worker() const { return job_ && job_->seat().rank > 0; }

  // Gives a request this rank's share of the cores, unless it specifies a number of threads, and its turn among equal devices.
  void take_seat(DeviceRequest& request) const;

  // In rank 0: waits until the workers have read the same scene and have the same task (task_text), and reports on them. Throws
  // their first error.
  void gather(const Simulation& simulation, const SolveSettings& settings, const std::string& task);
  // Returns the helpers that make replicates for `solve`; null without workers.
  [[nodiscard]] ReplicateHelpers* helpers() { return helpers_.get(); }
  void set_stage(std::uint64_t stage);  // selects the lights of Task::lights
  [[nodiscard]] bool interrupted() const { return helpers_ && helpers_->interrupted(); }
  // Tells the workers that no more replicates are needed.
  void release();

  // The settings with which a worker simulates.
  struct Task {
    Simulation& simulation;
    const SolveSettings& settings;
    std::string text;  // task_text
    // Returns the lights of a stage; empty for the light of the simulation's scene.
    std::function<std::vector<RadiationModel>(std::uint64_t stage)> lights;
  };
  // Makes replicates in a worker until rank 0 needs no more. `begin` prepares the task as rank 0 does, and passes it to the
  // function that it receives; rank 0 reports its errors. Returns whether the job ended properly.
  [[nodiscard]] bool serve(const std::function<void(const std::function<void(const Task&)>&)>& begin);

 private:
  void make_replicates(const Task& task);

  std::unique_ptr<Job> job_;
  std::unique_ptr<RankHelpers> helpers_;  // in rank 0
  bool served_ = false;                   // in a worker: true once the job ended properly
};

}  // namespace sunfleck
