#pragma once
// Detection of an MPI launcher from the environment alone, without calling any library.

#include <functional>
#include <optional>

namespace sunfleck {

struct Launch {
  int rank = 0;
  std::optional<int> ranks;  // empty if only MPI knows it

  [[nodiscard]] bool alone() const { return ranks && *ranks == 1; }
};

// Returns the value of a variable; null if it is not set, as std::getenv.
using Environment = std::function<const char*(const char*)>;

// Returns the process's place among those that an MPI launcher started. Returns nothing for a process without a launcher,
// and with SUNFLECK_MPI=off, no, false or 0. The known variables are those of Open MPI's mpirun (OMPI_COMM_WORLD_RANK,
// OMPI_COMM_WORLD_SIZE), of MPICH, Intel MPI and Slurm's pmi2 (PMI_RANK, PMI_SIZE), and of PMIx under Slurm and PRRTE
// (PMIX_RANK; with Slurm also SLURM_STEP_NUM_TASKS). Slurm's variables alone say nothing about MPI.
[[nodiscard]] std::optional<Launch> launch_by_mpi(const Environment& environment);

// Does the same for the environment of this process.
[[nodiscard]] std::optional<Launch> launch_by_mpi();

// Returns true for a rank other than 0: rank 0 prints its messages as well.
[[nodiscard]] bool is_worker_rank();

}  // namespace sunfleck
