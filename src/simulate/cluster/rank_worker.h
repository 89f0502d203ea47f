#pragma once
// The work of a rank other than 0: it makes the replicates that rank 0 orders, until rank 0 ends it.

#include "physics/transport/indirect/replicate.h"
#include "physics/transport/model/tracer.h"
#include "simulate/cluster/mailbox.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace sunfleck {

struct RankService {
  std::size_t slots = 1;  // number of replicates made at the same time
  std::string host;
  std::string scene;  // see ReadyMessage
  // Sets the light of the orders that follow; called only while no replicate is being made.
  std::function<void(std::uint64_t stage)> set_stage;
  // Makes a replicate, as ReplicateMaker::make; called by several threads at the same time.
  std::function<std::optional<ReplicateSet>(const ReplicateOrder&, const StopQuestion&)> make;
  // Returns true if this process received a request to stop; it is reported to rank 0, which decides.
  StopQuestion interrupted;
  // Rank 0 is lost if nothing was heard from it for this long while this rank was listening. Rank 0 does not listen while
  // it adds up replicates, nor between the steps of a day.
  std::chrono::milliseconds longest_silence = std::chrono::minutes(10);
};

// Serves until rank 0 ends it. Returns false if rank 0 is lost. Errors of the service are reported to rank 0, not thrown.
// Throws what the mailbox throws.
[[nodiscard]] bool serve(Mailbox& mailbox, const RankService& service);

// Reports to rank 0 that this rank could not begin, and waits until rank 0 ends it; behaves like serve in all other respects.
[[nodiscard]] bool report_failure(Mailbox& mailbox, const std::string& host, int kind, const std::string& text);

}  // namespace sunfleck
