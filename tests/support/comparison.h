#pragma once
// Compares estimates with their known values.

#include "physics/transport/model/statistics.h"
#include "programs/validate/known/verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace sunfleck::test {

// Returns the standard error behind a half-width of the default confidence, 0.95.
inline double standard_error(const Estimate& estimate, std::size_t replicates) {
  return estimate.half_width / t_quantile(0.95, replicates);
}

// Returns the mean of independent runs in the form of a result's estimates.
inline Estimate estimate_of(const ReplicateMean& mean) {
  return mean.estimate(t_quantile(0.95, mean.count()));
}

// Relative error of values computed in single precision.
inline constexpr double rounding = 1e-6;

// Expects a value within the estimate's own error, and an error small enough to make this a test. An entry without an error
// must be equal to 1e-6.
inline void expect_agrees(const Estimate& got, double expected, std::size_t replicates, double largest_standard_error,
                          std::size_t comparisons, const char* what) {
  const double error = standard_error(got, replicates);
  std::printf("%-44s expected %.7f got %.7f error %.1e z %+.2f\n", what, expected, got.value, error,
              error > 0.0 ? (got.value - expected) / error : 0.0);
  EXPECT_LE(error, largest_standard_error) << what;
  EXPECT_LE(std::abs(got.value - expected), table_quantile(comparisons, replicates) * error + rounding)
      << what << ": got " << got.value << " +- " << error << ", expected " << expected;
}

// Expects two estimates of one value to agree; they come from independent runs with `replicates` replicates each.
inline void expect_same(const Estimate& a, const Estimate& b, std::size_t replicates, double largest_standard_error,
                        std::size_t comparisons, const char* what) {
  const Estimate difference{a.value - b.value, std::hypot(a.half_width, b.half_width)};
  expect_agrees(difference, 0.0, replicates, largest_standard_error, comparisons, what);
}

// A value from an independent program.
struct Reference {
  double value;
  double error;  // standard error of the reference itself
};

// Expects agreement within three standard errors of the difference, and our own error to be at most `largest`.
inline void expect_within(const Estimate& got, const Reference& reference, std::size_t replicates, double largest,
                          const std::string& what) {
  const double own = standard_error(got, replicates);
  const double error = std::hypot(own, reference.error);
  const double difference = got.value - reference.value;
  std::printf("%-28s expected %.6f(%.0e) got %.6f(%.1e) z %+.2f\n", what.c_str(), reference.value, reference.error, got.value,
              own, difference / std::max(error, 1e-12));
  EXPECT_LE(own, largest) << what;
  EXPECT_LE(std::abs(difference), 3.0 * error + rounding) << what;
}

// Judges the reported errors by a whole table of independent comparisons: z must be distributed as Student's t.
class ZScores {
 public:
  explicit ZScores(std::size_t replicates) : replicates_(replicates) {}

  // Adds a comparison. An entry without an error only has to be equal.
  void add(const Estimate& got, double expected, const char* what) {
    const double error = standard_error(got, replicates_);
    if (error == 0.0) {
      EXPECT_NEAR(got.value, expected, rounding) << what;
      return;
    }
    const double z = (got.value - expected) / error;
    sum_ += z;
    squares_ += z * z;
    ++count_;
  }

  // Expects the mean within its own error at 0.1 %, and the root mean square within 25 % of that of Student's t.
  void expect_plausible() const {
    const auto n = static_cast<double>(count_);
    const double degrees = static_cast<double>(replicates_) - 1.0;
    const double spread = std::sqrt(degrees / (degrees - 2.0));
    const double mean = sum_ / n;
    const double rms = std::sqrt(squares_ / n);
    std::printf("z of %zu comparisons: mean %+.3f, rms %.3f (Student's %.3f)\n", count_, mean, rms, spread);
    // Quantile of the standard normal distribution: 0.1 % lie beyond it on the two sides together.
    constexpr double two_sided_quantile = 3.2905267314919;
    EXPECT_LE(std::abs(mean), two_sided_quantile * spread / std::sqrt(n));
    EXPECT_GE(rms, 0.75 * spread);
    EXPECT_LE(rms, 1.25 * spread);
  }

 private:
  std::size_t replicates_;
  std::size_t count_ = 0;
  double sum_ = 0.0;
  double squares_ = 0.0;
};

}  // namespace sunfleck::test
