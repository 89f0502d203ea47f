#pragma once
// Letters between the ranks of a job; rank 0 leads, the others help.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sunfleck {

enum class LetterKind : std::uint8_t {
  // from rank 0
  order,  // a replicate to be made
  drop,   // of orders so far nothing more is needed
  end,
  // to rank 0
  ready,
  made,     // each order has one answer: this
  dropped,  // or that
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

// Used by one thread.
class Mailbox {
 public:
  virtual ~Mailbox() = default;

  [[nodiscard]] virtual int ranks() const = 0;

  // Returns at once. Letters from one rank to another arrive in the order they were posted. Throws Error (failure).
  virtual void post(int to, LetterKind kind, std::vector<std::byte> content) = 0;

  // The next letter that has come; none if there is none. Has to be asked now and then for anything to arrive or leave.
  [[nodiscard]] virtual std::optional<Letter> take() = 0;

  // False while a letter is on its way out.
  [[nodiscard]] virtual bool all_posted() = 0;
};

}  // namespace sunfleck
