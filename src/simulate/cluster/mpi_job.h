#pragma once
// The job through MPI's C interface, which only the main thread calls.

#include "simulate/cluster/job.h"
#include "simulate/cluster/launch.h"

#include <memory>

namespace sunfleck {

// Starts MPI and joins the job of a process that was launched like this. Returns null if MPI says that the process is alone.
// Throws as join_job.
[[nodiscard]] std::unique_ptr<Job> join_mpi_job(const Launch& launch);

}  // namespace sunfleck
