#pragma once
// Tests whether a histogram is as flat as chance allows.

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <numeric>
#include <vector>

namespace sunfleck::test {

// Expects Pearson's chi-square of equally likely bins to lie between the quantiles that chance misses once in ten thousand
// times on either side.
inline void expect_flat(const std::vector<std::uint64_t>& bins, const char* what) {
  const double total = static_cast<double>(std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}));
  const double expected = total / static_cast<double>(bins.size());
  double sum = 0.0;
  for (const std::uint64_t count : bins) {
    const double deviation = static_cast<double>(count) - expected;
    sum += deviation * deviation / expected;
  }
  const boost::math::chi_squared distribution(static_cast<double>(bins.size() - 1));
  EXPECT_GE(sum, boost::math::quantile(distribution, 1e-4)) << what;
  EXPECT_LE(sum, boost::math::quantile(boost::math::complement(distribution, 1e-4))) << what;
}

}  // namespace sunfleck::test
