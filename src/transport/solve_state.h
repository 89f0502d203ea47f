#pragma once
// A run between two of its replicates: what it takes to go on as if it had never stopped.

#include "transport/accuracy.h"
#include "transport/counters.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/tally_sums.h"

#include <cstddef>

namespace sunfleck {

// Replicates after which the bounds are checked for the first time.
inline constexpr std::size_t first_check = 12;
// Packets in the first round of a replicate, at most; memory sets a lower bound on most machines.
inline constexpr double most_first_packets = 0x1p24;

// The pilots are behind it.
struct SolveState {
  Work work;                             // of each replicate
  std::size_t next_check = first_check;  // after so many replicates; as it is where the work is fixed
  std::size_t good_checks = 0;           // in a row, the last one included
  TallySums sums;

  [[nodiscard]] std::size_t replicates() const;
};

// A state with nothing in it, as large as those of such runs, and with the least work they can have.
[[nodiscard]] SolveState blank_state(const RadiationModel& model, const CounterLayout& layout, ElementErrors element_errors);

// False for a state that no such run can have been in: another number of sums, or counts or work out of range.
[[nodiscard]] bool is_state_of(const SolveState& state, const SolveState& blank);

}  // namespace sunfleck
