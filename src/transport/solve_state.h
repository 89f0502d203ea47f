#pragma once
// The state of a run between two replicates: everything needed to resume it as if it had never stopped.

#include "transport/accuracy.h"
#include "transport/counters.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/tally_sums.h"

#include <cstddef>

namespace sunfleck {

// Number of replicates after which the bounds are checked for the first time.
inline constexpr std::size_t first_check = 12;
// Largest number of packets in the first round of a replicate; on most machines memory limits it further.
inline constexpr double most_first_packets = 0x1p24;

// The state of a run after its pilots.
struct SolveState {
  Work work;                             // of each replicate
  std::size_t next_check = first_check;  // number of replicates at which it is due; unused if the work is fixed
  std::size_t good_checks = 0;           // in a row, up to the last check
  TallySums sums;

  [[nodiscard]] std::size_t replicates() const;
};

// Returns an empty state with arrays as large as those of such runs, and with the least work they can have.
[[nodiscard]] SolveState blank_state(const RadiationModel& model, const CounterLayout& layout, ElementErrors element_errors);

// Returns false for a state that no such run can have had: a different number of sums, or counts or work out of range.
[[nodiscard]] bool is_state_of(const SolveState& state, const SolveState& blank);

}  // namespace sunfleck
