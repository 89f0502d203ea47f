#pragma once
// Replicates in the order of their numbers, made ahead of need: several at once in this process, and by workers if there are
// any.

#include "physics/transport/indirect/replicate_maker.h"
#include "physics/transport/solve/replicate_helpers.h"

#include <atomic>
#include <cstddef>
#include <deque>
#include <future>
#include <optional>
#include <span>

namespace sunfleck {

class ReplicateQueue {
 public:
  // All arguments must outlive the queue; `helpers` may be null.
  ReplicateQueue(ReplicateMaker& maker, ReplicateHelpers* helpers, StopQuestion stop);
  ~ReplicateQueue();
  ReplicateQueue(const ReplicateQueue&) = delete;
  ReplicateQueue& operator=(const ReplicateQueue&) = delete;

  // Starts a series of replicates like `first`, beginning with it, and ends the series before. `conversions` are those
  // of their incidence, [light]. At most `at_once` are made at the same time in this process, and by each worker; if that is 1
  // and there are no workers, the thread that calls next() makes the replicate.
  void begin(const ReplicateOrder& first, std::span<const Conversion> conversions, std::size_t at_once);

  // Returns the next replicate, or nothing if stopped, which ends the series. Starts others: in this process only among
  // the first `certain` ones of the series, which will all be needed, and by workers also among the first `possible` ones.
  // Throws Error if one could not be made.
  [[nodiscard]] std::optional<ReplicateSet> next(std::size_t certain, std::size_t possible);

  // Ends the series; stops the replicates being made in this process and waits for them.
  void end();

 private:
  struct Making {
    std::future<std::optional<ReplicateSet>> here;  // invalid if a worker makes it
    std::optional<ReplicateSet> elsewhere;
  };

  void fill(std::size_t certain, std::size_t possible);
  void begin_here();
  void collect();
  [[nodiscard]] std::size_t busy_here() const;

  ReplicateMaker& maker_;
  ReplicateHelpers* helpers_;
  std::size_t at_once_ = 1;
  StopQuestion stop_;
  std::atomic<bool> dropped_ = false;
  ReplicateOrder order_;
  std::span<const Conversion> conversions_;
  ReplicateSet blank_;
  std::size_t taken_ = 0;
  std::deque<Making> ahead_;  // from the next one on; declared last, so that it is destroyed first
};

}  // namespace sunfleck
