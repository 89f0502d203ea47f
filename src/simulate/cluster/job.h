#pragma once
// The MPI job that this process belongs to. Only this folder uses MPI.

#include "simulate/cluster/mailbox.h"

#include <memory>
#include <string>

namespace sunfleck {

// The position of a process in its job.
struct Seat {
  int rank = 0, ranks = 1;
  int local_rank = 0;  // rank among the processes on the same machine
  int threads = 0;     // the process's share of the cores that it may use
  std::string host;
  // One line for the user if the launcher leaves cores of this machine unused; empty otherwise.
  std::string hint;
};

class Job {
 public:
  virtual ~Job() = default;

  [[nodiscard]] virtual const Seat& seat() const = 0;
  [[nodiscard]] virtual Mailbox& mailbox() = 0;

  // Ends this process's part in the job. All ranks must call it, with no letter under way. The launcher ends a job in
  // which a rank exits without calling it.
  virtual void finish() = 0;
};

// Joins the job. Returns null for a process that is alone, without starting MPI. Throws Error (input) if the launcher
// started several processes but this program cannot see the others, Error (failure) if MPI fails. A program built with MPI
// (SUNFLECK_MPI) uses mpi_job.h, and one built without it uses no_job.h.
[[nodiscard]] std::unique_ptr<Job> join_job();

}  // namespace sunfleck
