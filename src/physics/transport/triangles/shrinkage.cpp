#include "physics/transport/triangles/shrinkage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sunfleck {
namespace {

constexpr std::size_t most_samples = 4096;
constexpr int steps = 30;
// The number of samples that the preference for equal shares weighs as much as.
constexpr double preference = 4.0;
constexpr double least_noise = 1e-12;

// Below this exponent a likelihood counts as nothing, without underflow.
constexpr double least_exponent = -700.0;

}  // namespace

// Returns the inverse variances of a seen difference in each component.
Shrinkage::Values Shrinkage::inverse_variances(double noise) {
  Values inverse;
  for (std::size_t k = 0; k < components; ++k) inverse[k] = 1.0 / (variances[k] + noise);
  return inverse;
}

// Returns the likelihood of a difference under each component, up to a common factor: the exponent is largest for the last one.
Shrinkage::Values Shrinkage::likelihoods(double difference, const Values& inverse_variance) {
  const double half_square = 0.5 * difference * difference;
  Values likely;
  for (std::size_t k = 0; k < components; ++k) likely[k] = std::sqrt(inverse_variance[k]);
  for (std::size_t k = 0; k + 1 < components; ++k)
    likely[k] *= std::exp(std::max(least_exponent, half_square * (inverse_variance.back() - inverse_variance[k])));
  return likely;
}

// Multiplies likelihoods by shares and scales the products to a sum of 1.
Shrinkage::Values Shrinkage::posterior_shares(Values likely) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < components; ++k) sum += likely[k] *= shares_[k];
  for (double& share : likely) share /= sum;
  return likely;
}

Shrinkage::Shrinkage(std::span<const double> differences, std::span<const double> noise) {
  shares_.fill(1.0 / components);
  const std::size_t stride = (differences.size() + most_samples - 1) / most_samples;
  std::vector<Values> samples;
  for (std::size_t i = 0; i < differences.size(); i += stride) {
    if (!std::isfinite(noise[i])) continue;
    samples.push_back(likelihoods(differences[i], inverse_variances(std::max(noise[i], least_noise))));
  }
  for (int step = 0; step < steps && !samples.empty(); ++step) {
    Values next;
    next.fill(preference / components);
    for (const Values& sample : samples) {
      const Values parts = posterior_shares(sample);
      for (std::size_t k = 0; k < components; ++k) next[k] += parts[k];
    }
    for (double& share : next) share /= static_cast<double>(samples.size()) + preference;
    shares_ = next;
  }
}

Posterior Shrinkage::of(double difference, double noise) const {
  Posterior posterior;
  double squares = 0.0;
  if (!std::isfinite(noise)) {
    for (std::size_t k = 0; k < components; ++k) posterior.variance += shares_[k] * variances[k];
    return posterior;
  }
  noise = std::max(noise, least_noise);
  const Values inverse = inverse_variances(noise);
  const Values parts = posterior_shares(likelihoods(difference, inverse));
  for (std::size_t k = 0; k < components; ++k) {
    const double kept = variances[k] * inverse[k];
    const double mean = kept * difference;
    posterior.mean += parts[k] * mean;
    squares += parts[k] * (mean * mean + kept * noise);
  }
  posterior.variance = std::max(0.0, squares - posterior.mean * posterior.mean);
  return posterior;
}

}  // namespace sunfleck
