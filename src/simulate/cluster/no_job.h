#pragma once
// Stands in for the job in a program built without MPI, which can only refuse to be one of several processes.

#include "simulate/cluster/job.h"
#include "simulate/cluster/launch.h"

#include <memory>

namespace sunfleck {

// Returns null if a process that was launched like this can work alone. Throws Error (input) if it is one of several.
[[nodiscard]] std::unique_ptr<Job> join_no_job(const Launch& launch);

}  // namespace sunfleck
