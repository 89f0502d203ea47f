#include "physics/transport/model/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace sunfleck {

double ReplicateMean::standard_error() const {
  if (count_ < 2) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(count_);
  return std::sqrt(squares_ / (n - 1.0) / n);
}

Estimate ReplicateMean::estimate(double t_quantile, double unseen) const {
  return {mean_, says_little() ? std::max(t_quantile * standard_error(), unseen) : t_quantile * standard_error()};
}

Estimate ReplicateMean::estimate_of_area(double t_quantile, double unseen, double whole) const {
  constexpr double most_times_the_rest = 2.0, far_more = 3.0;
  Estimate result = estimate(t_quantile, unseen);
  if (says_little() || !(unseen < whole)) return result;
  const double share_of_rest = std::min(1.0, most_times_the_rest * mean_ / (whole - unseen));
  if (unseen * share_of_rest > far_more * result.half_width) result.half_width = unseen * share_of_rest;
  return result;
}

double unseen_events(double confidence) {
  return -std::log(0.5 * (1.0 - confidence));
}

double t_quantile(double confidence, std::size_t replicates) {
  if (replicates < 2) return std::numeric_limits<double>::quiet_NaN();
  const boost::math::students_t distribution(static_cast<double>(replicates - 1));
  return boost::math::quantile(boost::math::complement(distribution, 0.5 * (1.0 - confidence)));
}

double normal_quantile(double confidence) {
  constexpr std::size_t many = 1000000;
  return t_quantile(confidence, many);
}

}  // namespace sunfleck
