#pragma once
// The other ranks of a job as rank 0 sees them: workers that make replicates on order.

#include "physics/transport/solve/replicate_helpers.h"
#include "simulate/cluster/mailbox.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace sunfleck {

class RankHelpers final : public ReplicateHelpers {
 public:
  // A rank is lost if nothing was heard from it for this long while rank 0 was listening.
  static constexpr std::chrono::seconds longest_silence{120};

  // The mailbox must outlive the object.
  explicit RankHelpers(Mailbox& mailbox, std::chrono::milliseconds silence = longest_silence);

  // Waits until all ranks are ready. Throws Error if one of them failed or was given anything other than `scene`.
  void wait_until_ready(const std::string& scene);

  // Sets the stage (the step of a day, and so its light) of the orders from here on.
  void set_stage(std::uint64_t stage) { stage_ = stage; }

  // Returns true if one of the ranks received a request to stop (Ctrl-C, SIGTERM). Any thread may call it.
  [[nodiscard]] bool interrupted() const { return interrupted_; }

  void limit_slots(std::size_t at_once) override { most_slots_ = at_once; }
  [[nodiscard]] std::size_t slots() const override;
  [[nodiscard]] std::size_t free_slots() const override;
  void begin(const ReplicateOrder& order) override;
  [[nodiscard]] std::optional<MadeReplicate> take(const ReplicateSet& blank) override;
  void drop() override;

  // Dismisses all ranks: no more orders will follow.
  void release();

  // Waits until all ranks have ended. Returns false if one is lost, because waiting for it would never end.
  [[nodiscard]] bool wait_until_gone();

 private:
  using Clock = std::chrono::steady_clock;
  struct Rank {
    bool ready = false, gone = false;
    std::size_t slots = 0, in_hand = 0;
    std::string name;  // for messages
    std::string scene;
    Clock::duration silence{};
  };

  [[nodiscard]] std::size_t slots_of(const Rank& rank) const { return std::min(rank.slots, most_slots_); }
  [[nodiscard]] std::optional<Letter> hear();
  void note(Rank& rank, const Letter& letter);
  [[nodiscard]] bool is_silent(const Rank& rank) const { return !rank.gone && rank.silence > silence_; }
  void expect_sound() const;

  Mailbox& mailbox_;
  Clock::duration silence_;
  std::vector<Rank> ranks_;  // [rank - 1]
  std::size_t most_slots_ = std::numeric_limits<std::size_t>::max();
  std::uint64_t series_ = 0, stage_ = 0;
  std::atomic<bool> interrupted_ = false;
  bool released_ = false;
  Clock::time_point heard_ = Clock::now(), told_ = heard_;
};

}  // namespace sunfleck
