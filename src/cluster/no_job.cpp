// A program built without MPI.

#include "base/error.h"
#include "cluster/job.h"
#include "cluster/launch.h"

#include <fmt/format.h>

namespace sunfleck {

std::unique_ptr<Job> join_job() {
  const std::optional<Launch> launch = launch_by_mpi();
  if (!launch || launch->alone()) return nullptr;
  // Where the launcher does not say how many, the first of them cannot know that it is not alone.
  if (!launch->ranks && launch->rank == 0) return nullptr;
  throw_input(launch->ranks ? fmt::format("{} processes started by MPI", *launch->ranks) : "several processes started by MPI",
              "this program was built without it",
              "start one, or build with MPI (Debian: libopenmpi-dev); runs that have nothing to do with each other need "
              "SUNFLECK_MPI=off");
}

}  // namespace sunfleck
