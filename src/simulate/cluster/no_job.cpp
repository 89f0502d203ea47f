#include "simulate/cluster/no_job.h"

#include "base/error.h"

#include <fmt/format.h>

namespace sunfleck {

std::unique_ptr<Job> join_no_job(const Launch& launch) {
  // If the launcher does not give the number of processes, rank 0 cannot know that it is not alone.
  if (!launch.ranks && launch.rank == 0) return nullptr;
  throw_input(launch.ranks ? fmt::format("{} processes started by MPI", *launch.ranks) : "several processes started by MPI",
              "this program was built without MPI",
              "start a single process, build with MPI (Debian: libopenmpi-dev), or set SUNFLECK_MPI=off for independent runs");
}

}  // namespace sunfleck
