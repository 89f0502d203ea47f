#pragma once
// Measures of how well simulated values agree with measured ones.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace sunfleck {

// A figure is NaN if there are too few values, or only equal ones, to define it.
struct Agreement {
  std::size_t n = 0;       // number of pairs
  double r2 = 0.0;         // squared Pearson correlation of simulated and measured
  double rmse = 0.0;       // root mean square difference, in the unit of the values
  double slope = 0.0;      // slope of the least-squares line simulated = intercept + slope * measured
  double intercept = 0.0;  // intercept of that line
};

// Compares two lists of the same length, at least one value.
[[nodiscard]] Agreement agreement(std::span<const double> simulated, std::span<const double> measured);

// Returns e.g. "n 12, R2 0.970, RMSE 0.021, slope 0.980".
[[nodiscard]] std::string agreement_figures(const Agreement& figures);

// Returns e.g. "agreement with FILE: n 12, R2 0.970, RMSE 0.021, slope 0.980".
[[nodiscard]] std::string agreement_line(std::string_view file, const Agreement& figures);

}  // namespace sunfleck
