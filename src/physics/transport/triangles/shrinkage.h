#pragma once
// Adaptive shrinkage: from many noisy differences it learns how large true differences are, and then says of each what it
// most likely is (Stephens 2017, Biostatistics 18:275).

#include <span>
#include <vector>

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
  std::vector<double> shares_;  // [component]
};

}  // namespace sunfleck
