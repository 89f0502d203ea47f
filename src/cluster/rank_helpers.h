#pragma once
// The other ranks of a job, as rank 0 sees them: each makes replicates when told to.

#include "cluster/mailbox.h"
#include "transport/replicate_helpers.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace sunfleck {

class RankHelpers final : public ReplicateHelpers {
 public:
  // A rank from which nothing was heard for so long, while this one listened, is lost.
  static constexpr std::chrono::seconds longest_silence{120};

  // The mailbox must outlive it.
  explicit RankHelpers(Mailbox& mailbox, std::chrono::milliseconds silence = longest_silence);

  // Returns once all ranks are ready. Throws Error if one of them failed, or was given something else than `scene`.
  void wait_until_ready(const std::string& scene);

  // The light of the orders from here on.
  void set_stage(std::uint64_t stage) { stage_ = stage; }

  // One of them was told to stop (Ctrl-C, SIGTERM). Any thread may ask.
  [[nodiscard]] bool interrupted() const { return interrupted_; }

  [[nodiscard]] std::size_t slots() const override;
  [[nodiscard]] std::size_t free_slots() const override;
  void begin(const ReplicateOrder& order) override;
  [[nodiscard]] std::optional<MadeReplicate> take(const Replicate& blank) override;
  void drop() override;

  // Nothing more is wanted of them.
  void release();

  // Waits until all are gone. False if one is lost: then nothing can be waited for any more.
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

  [[nodiscard]] std::optional<Letter> hear();
  void note(Rank& rank, const Letter& letter);
  [[nodiscard]] bool is_silent(const Rank& rank) const { return !rank.gone && rank.silence > silence_; }
  void expect_sound() const;

  Mailbox& mailbox_;
  Clock::duration silence_;
  std::vector<Rank> ranks_;  // [rank - 1]
  std::uint64_t series_ = 0, stage_ = 0;
  std::atomic<bool> interrupted_ = false;
  bool released_ = false;
  Clock::time_point heard_ = Clock::now(), told_ = heard_;
};

}  // namespace sunfleck
