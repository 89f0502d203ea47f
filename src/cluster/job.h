#pragma once
// The MPI job that this process is part of. The only folder that knows MPI; programs built without it know only how to refuse.

#include "cluster/mailbox.h"

#include <memory>
#include <string>

namespace sunfleck {

// The place of a process in its job.
struct Seat {
  int rank = 0, ranks = 1;
  int local_rank = 0;  // among those on the same machine
  int threads = 0;     // its share of the cores that it may use
  std::string host;
  std::string hint;  // one line for the user where the launcher leaves cores of this machine unused; else empty
};

class Job {
 public:
  virtual ~Job() = default;

  [[nodiscard]] virtual const Seat& seat() const = 0;
  [[nodiscard]] virtual Mailbox& mailbox() = 0;

  // All ranks have to come here, with no letter on its way. A job that is not finished is ended by its launcher.
  virtual void finish() = 0;
};

// None for a process that is alone: then MPI is not even started. Throws Error (input) if the launcher started several but this
// program cannot know of the others, Error (failure) if MPI fails.
[[nodiscard]] std::unique_ptr<Job> join_job();

}  // namespace sunfleck
