#pragma once
// Others who make replicates beside this process. A replicate hangs on its order alone, so it does not matter who made it.

#include "transport/replicate.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace sunfleck {

struct MadeReplicate {
  std::uint64_t number = 0;
  Replicate replicate;  // without its `sums`
};

// Asked by one thread.
class ReplicateHelpers {
 public:
  virtual ~ReplicateHelpers() = default;

  // How many replicates they can have in hand, all of them together, and how many more they would take now.
  [[nodiscard]] virtual std::size_t slots() const = 0;
  [[nodiscard]] virtual std::size_t free_slots() const = 0;

  // One of them begins it; there must be a free slot.
  virtual void begin(const ReplicateOrder& order) = 0;

  // One that is finished, in any order; none if there is none yet. `blank` tells its sizes. Throws Error if one of them failed
  // or is gone.
  [[nodiscard]] virtual std::optional<MadeReplicate> take(const Replicate& blank) = 0;

  // What was begun and not taken is not needed any more.
  virtual void drop() = 0;
};

}  // namespace sunfleck
