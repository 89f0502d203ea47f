#include "simulate/cluster/rank_helpers.h"

#include "base/check.h"
#include "base/error.h"
#include "base/pause.h"
#include "simulate/cluster/replicate_message.h"

#include <fmt/format.h>

namespace sunfleck {

RankHelpers::RankHelpers(Mailbox& mailbox, std::chrono::milliseconds silence)
    : mailbox_(mailbox), silence_(silence), ranks_(static_cast<std::size_t>(mailbox.ranks() - 1)) {
  for (std::size_t k = 0; k < ranks_.size(); ++k) ranks_[k].name = fmt::format("rank {}", k + 1);
}

std::size_t RankHelpers::slots() const {
  std::size_t slots = 0;
  for (const Rank& rank : ranks_) slots += slots_of(rank);
  return slots;
}

// What was dropped stays in a rank's hand until it says so, and may be more than a new limit allows.
std::size_t RankHelpers::free_slots() const {
  std::size_t free = 0;
  for (const Rank& rank : ranks_) free += slots_of(rank) - std::min(slots_of(rank), rank.in_hand);
  return free;
}

void RankHelpers::begin(const ReplicateOrder& order) {
  const auto load = [this](const Rank& rank) {
    return rank.in_hand < slots_of(rank) ? static_cast<double>(rank.in_hand) / static_cast<double>(slots_of(rank)) : 1.0;
  };
  const auto least =
      std::min_element(ranks_.begin(), ranks_.end(), [&](const Rank& a, const Rank& b) { return load(a) < load(b); });
  EXPECT(least->in_hand, <, slots_of(*least));
  ++least->in_hand;
  mailbox_.post(static_cast<int>(least - ranks_.begin()) + 1, LetterKind::order,
                pack(OrderMessage{{series_, order.number}, stage_, order}));
}

std::optional<MadeReplicate> RankHelpers::take(const ReplicateSet& blank) {
  while (const std::optional<Letter> letter = hear()) {
    if (letter->kind != LetterKind::made) continue;
    const ReplicateKey key = unpack_key(letter->content);
    if (key.series != series_) continue;
    return MadeReplicate{key.number, unpack_replicates(letter->content, blank)};
  }
  expect_sound();
  return std::nullopt;
}

void RankHelpers::drop() {
  ++series_;
  for (std::size_t k = 0; k < ranks_.size(); ++k) {
    if (ranks_[k].in_hand > 0) mailbox_.post(static_cast<int>(k) + 1, LetterKind::drop, {});
  }
}

void RankHelpers::wait_until_ready(const std::string& scene) {
  Pause pause;
  const auto is_ready = [](const Rank& rank) { return rank.ready; };
  while (!std::all_of(ranks_.begin(), ranks_.end(), is_ready)) {
    if (!hear()) pause.take();
  }
  for (const Rank& rank : ranks_) {
    if (!rank.ready || rank.scene == scene) continue;
    throw_input(
        rank.name, fmt::format("it was given {}, rank 0 has {}", rank.scene, scene),
        "start the same command with the same scene and options on all ranks, or set SUNFLECK_MPI=off for independent runs");
  }
}

void RankHelpers::release() {
  if (released_) return;
  released_ = true;
  ++series_;
  for (std::size_t k = 0; k < ranks_.size(); ++k) mailbox_.post(static_cast<int>(k) + 1, LetterKind::end, {});
}

bool RankHelpers::wait_until_gone() {
  release();
  Pause pause;
  const auto is_gone = [](const Rank& rank) { return rank.gone; };
  while (!std::all_of(ranks_.begin(), ranks_.end(), is_gone) || !mailbox_.all_posted()) {
    if (std::any_of(ranks_.begin(), ranks_.end(), [this](const Rank& rank) { return is_silent(rank); })) return false;
    bool heard = false;
    try {
      heard = hear().has_value();
    } catch (const Error&) {  // the reason is already known
      heard = true;
    }
    if (!heard) pause.take();
  }
  return true;
}

// Returns the next letter after noting its contents; nothing if there is none.
std::optional<Letter> RankHelpers::hear() {
  const Clock::time_point now = Clock::now();
  const Clock::duration step = std::min<Clock::duration>(now - heard_, longest_step);
  heard_ = now;
  for (Rank& rank : ranks_) rank.silence += step;
  if (!released_ && now - told_ >= alive_pause) {
    told_ = now;
    for (std::size_t k = 0; k < ranks_.size(); ++k) mailbox_.post(static_cast<int>(k) + 1, LetterKind::alive, {});
  }
  std::optional<Letter> letter = mailbox_.take();
  if (letter) note(ranks_.at(static_cast<std::size_t>(letter->from - 1)), *letter);
  return letter;
}

void RankHelpers::note(Rank& rank, const Letter& letter) {
  rank.silence = {};
  switch (letter.kind) {
    case LetterKind::ready: {
      const ReadyMessage message = unpack<ReadyMessage>(letter.content);
      rank.ready = true;
      rank.slots = message.slots;
      rank.scene = message.scene;
      rank.name += fmt::format(" on {}", message.host);
      break;
    }
    case LetterKind::made:
    case LetterKind::dropped:
      EXPECT(rank.in_hand, >, 0U);
      --rank.in_hand;
      break;
    case LetterKind::failed: {
      const FailedMessage message = unpack<FailedMessage>(letter.content);
      throw Error(static_cast<ErrorKind>(message.kind),
                  fmt::format("rank {} on {}: {}", letter.from, message.host, message.text));
    }
    case LetterKind::interrupted:
      interrupted_ = true;
      break;
    case LetterKind::gone:
      rank.gone = true;
      break;
    default:
      break;
  }
}

void RankHelpers::expect_sound() const {
  for (const Rank& rank : ranks_) {
    if (rank.gone) throw_failure(rank.name, "it ended early", "see its messages for the reason");
    if (rank.in_hand == 0 || !is_silent(rank)) continue;
    throw_failure(rank.name, fmt::format("nothing heard from it for {:.0f} s", std::chrono::duration<double>(silence_).count()),
                  "see its messages for the reason");
  }
}

}  // namespace sunfleck
