#include "physics/transport/triangles/shrinkage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sunfleck {
namespace {

constexpr std::size_t components = 9;
constexpr std::size_t most_samples = 4096;
constexpr int steps = 30;
// The number of samples that the preference for equal shares weighs as much as.
constexpr double preference = 4.0;
constexpr double least_noise = 1e-12;

// Variances of the true differences in each component.
constexpr std::array<double, components> variances = {0.0, 0x1p-14, 0x1p-12, 0x1p-10, 0x1p-8, 0x1p-6, 0x1p-4, 0x1p-2, 1.0};

using Likelihoods = std::array<double, components>;

// Returns the likelihood of a difference under each component, up to a common factor.
Likelihoods likelihoods(double difference, double noise) {
  std::array<double, components> logs{};
  for (std::size_t k = 0; k < components; ++k) {
    const double variance = variances[k] + noise;
    logs[k] = -0.5 * (difference * difference / variance + std::log(variance));
  }
  const double most = *std::max_element(logs.begin(), logs.end());
  for (double& value : logs) value = std::exp(value - most);
  return logs;
}

// Multiplies likelihoods by shares and scales the products to a sum of 1.
Likelihoods posterior_shares(Likelihoods likely, const std::vector<double>& shares) {
  double sum = 0.0;
  for (std::size_t k = 0; k < components; ++k) sum += likely[k] *= shares[k];
  for (double& share : likely) share /= sum;
  return likely;
}

}  // namespace

Shrinkage::Shrinkage(std::span<const double> differences, std::span<const double> noise)
    : shares_(components, 1.0 / components) {
  const std::size_t stride = (differences.size() + most_samples - 1) / most_samples;
  std::vector<Likelihoods> samples;
  for (std::size_t i = 0; i < differences.size(); i += stride) {
    if (std::isfinite(noise[i])) samples.push_back(likelihoods(differences[i], std::max(noise[i], least_noise)));
  }
  for (int step = 0; step < steps && !samples.empty(); ++step) {
    std::vector<double> next(components, preference / components);
    for (const Likelihoods& sample : samples) {
      const Likelihoods parts = posterior_shares(sample, shares_);
      for (std::size_t k = 0; k < components; ++k) next[k] += parts[k];
    }
    for (double& share : next) share /= static_cast<double>(samples.size()) + preference;
    shares_ = std::move(next);
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
  const Likelihoods parts = posterior_shares(likelihoods(difference, noise), shares_);
  for (std::size_t k = 0; k < components; ++k) {
    const double kept = variances[k] / (variances[k] + noise);
    const double mean = kept * difference;
    posterior.mean += parts[k] * mean;
    squares += parts[k] * (mean * mean + kept * noise);
  }
  posterior.variance = std::max(0.0, squares - posterior.mean * posterior.mean);
  return posterior;
}

}  // namespace sunfleck
