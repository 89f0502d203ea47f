#pragma once
// Replicates in order of their numbers, made ahead of need: side by side here, and by helpers if there are any.

#include "transport/replicate.h"
#include "transport/replicate_helpers.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <future>
#include <optional>

namespace sunfleck {

class ReplicateQueue {
 public:
  // All must outlive it; `helpers` may be null.
  ReplicateQueue(ReplicateMaker& maker, ReplicateHelpers* helpers, StopQuestion stop);
  ~ReplicateQueue();
  ReplicateQueue(const ReplicateQueue&) = delete;
  ReplicateQueue& operator=(const ReplicateQueue&) = delete;

  // From now on replicates like `first`, and that first; ends the series before. The tally is the one that add()s them, or
  // another of their incidence. At most `at_once` are in the making here; a single one without helpers is made by the thread
  // that asks for it.
  void begin(const ReplicateOrder& first, const Tally& tally, std::size_t at_once);

  // The next one; none if stopped, which ends the series. Begins others: here of the first `certain` ones of the series, which
  // will all be needed, elsewhere of the first `possible` ones too. Throws Error if one could not be made.
  [[nodiscard]] std::optional<Replicate> next(std::size_t certain, std::size_t possible);

  // Nothing more is needed; waits for those in the making here, which are asked to stop.
  void end();

 private:
  struct Making {
    std::future<std::optional<Replicate>> here;  // invalid if a helper has it
    std::optional<Replicate> elsewhere;
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
  const Tally* tally_ = nullptr;
  Replicate blank_;
  std::size_t taken_ = 0;
  std::deque<Making> ahead_;  // from the next one on; last, so that it ends first
};

}  // namespace sunfleck
