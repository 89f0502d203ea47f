#pragma once
// How well simulated values follow measured ones.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace sunfleck {

// NaN where too few or only equal values leave a figure undefined.
struct Agreement {
  std::size_t n = 0;       // pairs
  double r2 = 0.0;         // squared Pearson correlation of simulated and measured
  double rmse = 0.0;       // root of the mean squared difference, in their unit
  double slope = 0.0;      // of the least-squares line simulated = intercept + slope * measured
  double intercept = 0.0;  // of that line
};

// Both have the same number of values, at least one.
[[nodiscard]] Agreement agreement(std::span<const double> simulated, std::span<const double> measured);

// "n 12, R2 0.970, RMSE 0.021, slope 0.980"
[[nodiscard]] std::string agreement_figures(const Agreement& figures);

// "agreement with FILE: n 12, R2 0.970, RMSE 0.021, slope 0.980"
[[nodiscard]] std::string agreement_line(std::string_view file, const Agreement& figures);

}  // namespace sunfleck
