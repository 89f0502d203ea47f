#pragma once
// The state of a run between two replicates: everything needed to resume it as if it had never stopped.

#include "base/number_pieces.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

struct RunSums;

// Number of replicates after which the bounds are checked for the first time.
inline constexpr std::size_t first_check = 12;
// Largest number of packets in the first round of a replicate; on most machines memory limits it further.
inline constexpr double most_first_packets = 0x1p24;

// All sums of a run as plain numbers, in a fixed order; the first integer is the number of replicates.
struct PlainSums {
  std::vector<std::int64_t> integers;
  std::vector<double> reals;
};

// The same numbers, read where they are: a copy of them all would be the largest array of a run.
struct SumPieces {
  NumberPieces<std::int64_t> integers;
  NumberPieces<double> reals;
};

// Return everything that other sums with the same conversion need to continue. The number of values depends only on the
// model and on the element errors. The sums must outlive their pieces.
[[nodiscard]] PlainSums plain_sums(const RunSums& sums);
[[nodiscard]] SumPieces pieces_of(const RunSums& sums);

// Takes them over. Returns false if there are too few or too many.
[[nodiscard]] bool restore(RunSums& sums, const PlainSums& plain);

// The state of a run after its pilots.
struct SolveState {
  Work work;                             // of each replicate
  std::size_t next_check = first_check;  // number of replicates at which it is due; unused if the work is fixed
  PlainSums sums;

  [[nodiscard]] std::size_t replicates() const;
};

// A state as it is handed over and written; what it is made of must outlive it.
struct SolveStateView {
  SolveStateView(Work of_work, std::size_t check, SumPieces pieces);
  SolveStateView(const SolveState& state);  // NOLINT(google-explicit-constructor): a view of the state
  operator SolveState() const;              // NOLINT(google-explicit-constructor): a copy

  Work work;
  std::size_t next_check = first_check;
  SumPieces sums;
};

// Returns an empty state with arrays as large as those of such runs, and with the least work they can have.
[[nodiscard]] SolveState blank_state(const RadiationModel& model, const CounterLayout& layout, ElementErrors element_errors);

// Returns false for a state that no such run can have had: a different number of sums, or counts or work out of range.
[[nodiscard]] bool is_state_of(const SolveState& state, const SolveState& blank);

}  // namespace sunfleck
