#pragma once
// The state of a run between two replicates: everything needed to resume it as if it had never stopped.

#include "base/number_pieces.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

struct Series;
struct SolveSettings;

// Largest number of packets in the first round of a replicate; on most machines memory limits it further.
inline constexpr double most_first_packets = 0x1p24;

// All sums of a run, light by light, as plain numbers, in a fixed order; the first integer is the number of replicates.
struct PlainSums {
  std::vector<std::int64_t> integers;
  std::vector<double> reals;
};

// The same numbers, read where they are: a copy of them all would be the largest array of a run.
struct SumPieces {
  NumberPieces<std::int64_t> integers;
  NumberPieces<double> reals;
};

// Returns everything that another series with the same conversions needs to continue. The series must outlive the pieces.
[[nodiscard]] SumPieces pieces_of(const Series& series);

// Takes them over. Returns false if there are too few or too many.
[[nodiscard]] bool restore(Series& series, const PlainSums& plain);

// The state of a run after its pilots.
struct SolveState {
  Work work;                             // of each replicate
  std::vector<double> ray_shares;        // [light], of the work's rays; empty for a single light and for fixed work
  std::size_t next_check = first_check;  // number of replicates at which it is due; unused if the work is fixed
  PlainSums sums;

  [[nodiscard]] std::size_t replicates() const;
};

// A state as it is handed over and written; what it is made of must outlive it.
struct SolveStateView {
  Work work;
  std::vector<double> ray_shares;
  std::size_t next_check = first_check;
  SumPieces sums;
};

// What all states of a run have in common.
struct StateShape {
  std::size_t lights = 1;
  std::size_t integers = 0, reals = 0;  // numbers of sums
  double least_rays = 0.0;              // of the work
};

// Returns the shape of the states of runs in these lights.
[[nodiscard]] StateShape state_shape(Lights lights, const CounterLayout& layout, const SolveSettings& settings,
                                     const WantedSums& wanted);

// Returns false for a state that no such run can have had: a different number of sums, or counts or work out of range.
[[nodiscard]] bool is_state_of(const SolveState& state, const StateShape& shape);

}  // namespace sunfleck
