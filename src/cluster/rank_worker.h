#pragma once
// What a rank other than 0 does: makes the replicates that rank 0 orders, until it is told to end.

#include "cluster/mailbox.h"
#include "transport/replicate.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace sunfleck {

struct RankService {
  std::size_t slots = 1;  // replicates side by side
  std::string host;
  std::string scene;  // see ReadyMessage
  // The light of the orders that follow; no replicate is in the making meanwhile.
  std::function<void(std::uint64_t stage)> set_stage;
  // Called by several threads at a time, as ReplicateMaker::make.
  std::function<std::optional<Replicate>(const ReplicateOrder&, const StopQuestion&)> make;
  StopQuestion interrupted;  // this process is asked to stop: rank 0 is told, and decides
  // Rank 0 is lost where nothing was heard of it for so long while this one listened. It does not listen while it adds up what
  // was made, nor between the steps of a day.
  std::chrono::milliseconds longest_silence = std::chrono::minutes(10);
};

// Until rank 0 ends it; false if rank 0 is lost. What goes wrong in the service is told to rank 0, not thrown. Throws what the
// mailbox throws.
[[nodiscard]] bool serve(Mailbox& mailbox, const RankService& service);

// For a rank that could not even begin: tells rank 0, and waits until it ends. The rest as serve.
[[nodiscard]] bool report_failure(Mailbox& mailbox, const std::string& host, int kind, const std::string& text);

}  // namespace sunfleck
