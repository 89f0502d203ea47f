#pragma once
// Evaluates the measured settings: how fast errors fall, and which bound gives a required error.

#include "files/results/tables/tradeoff_table.h"

#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

struct WorkAndError {
  double work = 0.0;  // rays or seconds
  double error = 0.0;
};

// Fits a power law. Points that are not positive and finite are left out. None if fewer than two points differ in work.
[[nodiscard]] std::optional<PowerLaw> fit_power_law(std::span<const WorkAndError> points);

// Returns the slopes of the series of grids and of packets; those that cannot be fitted are left out.
[[nodiscard]] std::vector<TradeoffFit> fit_series(const std::vector<TradeoffLevel>& levels);

// Returns the widest bound, with two digits, at which runs are expected to meet the required error. The bound is predicted from
// the series of bounds; other series are ignored, as are settings whose error the reference cannot resolve. The error at a
// bound is interpolated between the measured settings, in logarithms, and has to lie below the required error by a margin: the
// largest factor by which any measured run exceeds the root mean square of its own setting. With n measured runs that is a
// distribution-free tolerance limit (Wilks 1941, Annals of Mathematical Statistics 12:91): nine of ten further runs meet it
// except with probability 0.9^n, 3 % for 32. A bound beyond the finest setting is extrapolated and marked as such. None without
// settings, if a single one would have to be extrapolated, or if the bound would be less than a tenth of the finest setting's.
[[nodiscard]] std::optional<Recommendation> recommend(const std::vector<TradeoffLevel>& levels, double requested_error,
                                                      Quantity quantity);

}  // namespace sunfleck
