#pragma once
// Adaptive shrinkage: from many noisy differences it learns how large true differences are, and then says of each what it
// most likely is (Stephens 2017, Biostatistics 18:275).

#include <array>
#include <cstddef>
#include <span>

namespace sunfleck {

struct Posterior {
  double mean = 0.0, variance = 0.0;
};

class Shrinkage {
 public:
  // Learns from differences, each with the variance of its noise, that true ones come from a mixture of normal distributions
  // around 0 with fixed variances from 4^-7 to 1, and of exact zeros. The shares of the mixture are the most likely ones
  // under a weak preference for equal shares. A sample of a few thousand is used.
  Shrinkage(std::span<const double> differences, std::span<const double> noise);

  // Returns the mean and variance of a true difference; infinite noise gives those of the mixture.
  [[nodiscard]] Posterior of(double difference, double noise) const;

 private:
  static constexpr std::size_t components = 9;
  using Values = std::array<double, components>;

  // Variances of the true differences in each component.
  static constexpr Values variances = {0.0, 0x1p-14, 0x1p-12, 0x1p-10, 0x1p-8, 0x1p-6, 0x1p-4, 0x1p-2, 1.0};

  static Values inverse_variances(double noise);
  static Values likelihoods(double difference, const Values& inverse_variance);
  [[nodiscard]] Values posterior_shares(Values likely) const;

  Values shares_;
};

}  // namespace sunfleck
