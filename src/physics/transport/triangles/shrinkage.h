#pragma once
// Adaptive shrinkage: from many noisy differences it learns how large true differences are, and then says of each what it
// most likely is (Stephens 2017, Biostatistics 18:275). Its vectors give the same bits on every kind of processor.

#include <array>
#include <span>

namespace sunfleck {

class Shrinkage {
 public:
  // True differences come from a mixture of normal distributions around 0 with these variances.
  static constexpr std::array<double, 9> variances = {0.0, 0x1p-14, 0x1p-12, 0x1p-10, 0x1p-8, 0x1p-6, 0x1p-4, 0x1p-2, 1.0};
  using Values = std::array<double, variances.size()>;

  // Learns the shares of the mixture from differences, each with the variance of its noise. They are the most likely ones under
  // a weak preference for equal shares. A sample of a few thousand differences with finite noise is used.
  Shrinkage(std::span<const double> differences, std::span<const double> noise);

  // Replaces differences by the means of the true ones, and the variances of their noise by those of the true ones; infinite
  // noise by the mean and variance of the mixture.
  void shrink(std::span<double> differences, std::span<double> noise) const;

 private:
  Values shares_;
};

}  // namespace sunfleck
