#pragma once
// Remote workers that make replicates for this process. A replicate depends only on its order, so any worker may make it.

#include "physics/transport/indirect/replicate.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace sunfleck {

struct MadeReplicate {
  std::uint64_t number = 0;
  ReplicateSet replicates;  // without their `direct`
};

// The interface to the workers; one thread may use it.
class ReplicateHelpers {
 public:
  virtual ~ReplicateHelpers() = default;

  // Has each worker make at most this many replicates at the same time, from now on; each has its own limit besides.
  virtual void limit_slots(std::size_t at_once) = 0;

  // Returns how many replicates all workers together can hold.
  [[nodiscard]] virtual std::size_t slots() const = 0;
  // Returns how many more replicates they would accept now.
  [[nodiscard]] virtual std::size_t free_slots() const = 0;

  // Gives the order to one of the workers; there must be a free slot.
  virtual void begin(const ReplicateOrder& order) = 0;

  // Returns a finished replicate, in any order, or nothing if none is ready. `blank` gives the sizes of its arrays. Throws
  // Error if a worker failed or is lost.
  [[nodiscard]] virtual std::optional<MadeReplicate> take(const ReplicateSet& blank) = 0;

  // Cancels everything that was begun and not taken.
  virtual void drop() = 0;
};

}  // namespace sunfleck
