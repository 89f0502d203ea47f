#pragma once
// Letters between the ranks of a job. Rank 0 leads, the others help.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sunfleck {

// Time between two signs of life sent to the other ranks.
inline constexpr std::chrono::seconds alive_pause{10};
// Limits the silence counted per step: a process that was stopped for a while (by a debugger, or in a suspended job) finds the
// letters of the others when it resumes.
inline constexpr std::chrono::seconds longest_step{1};

enum class LetterKind : std::uint8_t {
  // from rank 0
  order,  // make a replicate
  drop,   // drop all orders so far
  end,
  // to rank 0
  ready,
  made,     // answer to an order that was carried out
  dropped,  // answer to an order that was dropped
  interrupted,
  failed,
  gone,  // the last letter of a rank
  // both ways
  alive,
};

struct Letter {
  int from = 0;
  LetterKind kind = LetterKind::alive;
  std::vector<std::byte> content;
};

// Sends and receives letters; only one thread may use it.
class Mailbox {
 public:
  virtual ~Mailbox() = default;

  [[nodiscard]] virtual int ranks() const = 0;

  // Sends a letter and returns at once. Letters from one rank to another arrive in the order in which they were posted.
  // Throws Error (failure).
  virtual void post(int to, LetterKind kind, std::vector<std::byte> content) = 0;

  // Returns the next letter that has arrived, or nothing. It must be called regularly, because letters arrive and leave
  // only during the call.
  [[nodiscard]] virtual std::optional<Letter> take() = 0;

  // Returns false while a letter is on its way out.
  [[nodiscard]] virtual bool all_posted() = 0;
};

}  // namespace sunfleck
