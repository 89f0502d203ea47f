#pragma once
// What the measured settings say: how fast errors fall, and which bound gives an asked error.

#include "io/tradeoff_table.h"

#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

struct WorkAndError {
  double work = 0.0;  // rays or seconds
  double error = 0.0;
};

// Points that are not positive and finite are left out. None with fewer than two of different work.
[[nodiscard]] std::optional<PowerLaw> fit_power_law(std::span<const WorkAndError> points);

// Slopes of the ladders of grids and packets; those that cannot be fitted are left out.
[[nodiscard]] std::vector<TradeoffFit> fit_ladders(const std::vector<TradeoffRung>& rungs);

// The widest bound, of two digits, with which runs meet the asked error, foreseen from the rungs of the ladder of bounds
// (others are passed over, and those whose error the reference does not tell). A bound's error is interpolated between rungs,
// in logarithms. It is to lie below the asked error by a margin: the most that any run measured exceeds its own rung's root
// mean square. With n runs measured that is a tolerance limit free of any distribution (Wilks 1941, Annals of Mathematical
// Statistics 12:91): nine of ten further runs meet it but for a chance of 0.9^n, 3 % for 32. A bound beyond the finest rung is
// extrapolated, marked so. None without rungs.
[[nodiscard]] std::optional<Recommendation> recommend(const std::vector<TradeoffRung>& rungs, double asked_error,
                                                      Quantity quantity);

}  // namespace sunfleck
