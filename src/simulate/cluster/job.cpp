#include "simulate/cluster/job.h"

#include "simulate/cluster/launch.h"
#ifdef SUNFLECK_MPI
#include "simulate/cluster/mpi_job.h"
#else
#include "simulate/cluster/no_job.h"
#endif

#include <optional>

namespace sunfleck {

std::unique_ptr<Job> join_job() {
  const std::optional<Launch> launch = launch_by_mpi();
  if (!launch || launch->alone()) return nullptr;
#ifdef SUNFLECK_MPI
  return join_mpi_job(*launch);
#else
  return join_no_job(*launch);
#endif
}

}  // namespace sunfleck
