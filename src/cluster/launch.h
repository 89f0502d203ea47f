#pragma once
// Whether this process is one of several that an MPI launcher started, as far as the environment tells: no library is asked.

#include <functional>
#include <optional>

namespace sunfleck {

struct Launch {
  int rank = 0;
  std::optional<int> ranks;  // none: only MPI knows

  [[nodiscard]] bool alone() const { return ranks && *ranks == 1; }
};

// Null for a variable that is not set, as std::getenv.
using Environment = std::function<const char*(const char*)>;

// None for a process that no MPI launcher started, and with SUNFLECK_MPI=off. Known are the variables of Open MPI's mpirun
// (OMPI_COMM_WORLD_RANK, OMPI_COMM_WORLD_SIZE), of MPICH, Intel MPI and Slurm's pmi2 (PMI_RANK, PMI_SIZE), and of PMIx as
// Slurm and PRRTE have it (PMIX_RANK; with Slurm also SLURM_STEP_NUM_TASKS). Slurm's variables alone say nothing about MPI.
[[nodiscard]] std::optional<Launch> launch_by_mpi(const Environment& environment);

// Of this process.
[[nodiscard]] std::optional<Launch> launch_by_mpi();

// A rank other than 0: what it had to say is said by rank 0 as well.
[[nodiscard]] bool is_silent_rank();

}  // namespace sunfleck
