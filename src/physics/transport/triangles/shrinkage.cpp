#include "physics/transport/triangles/shrinkage.h"

#include "base/rounding.h"

#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/transport/triangles/shrinkage.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#ifndef SUNFLECK_SHRINKAGE_CONSTANTS
#define SUNFLECK_SHRINKAGE_CONSTANTS
namespace sunfleck::shrinkage {

inline constexpr std::size_t components = Shrinkage::variances.size();
inline constexpr std::size_t most_samples = 4096;
inline constexpr int steps = 30;
// The number of samples that the preference for equal shares weighs as much as.
inline constexpr double preference = 4.0;
inline constexpr double least_noise = 1e-12;
// Below this exponent a likelihood counts as nothing, without underflow.
inline constexpr double least_exponent = -700.0;
inline constexpr double infinite = std::numeric_limits<double>::infinity();

// Factors of the power series of the exponential, from the last to the first.
inline constexpr std::array<double, 13> inverse_numbers = {1.0 / 13, 1.0 / 12, 1.0 / 11, 1.0 / 10, 1.0 / 9, 1.0 / 8, 1.0 / 7,
                                                           1.0 / 6,  1.0 / 5,  1.0 / 4,  1.0 / 3,  1.0 / 2, 1.0};

// Differences go side by side in eights, whatever the width of the vectors, so that sums over them have the same order.
inline constexpr std::size_t at_once = 8;
using Eight = std::array<double, at_once>;

struct alignas(64) Differences {
  Eight seen{}, noise{};
};

// What each component says of eight differences.
struct alignas(64) OfComponents {
  std::array<Eight, components> values;
};

struct Samples {
  std::vector<Differences> differences;
  std::vector<Eight> counted;  // 1, or 0 for what is missing in the last eight
  double count = 0.0;
};

}  // namespace sunfleck::shrinkage
#endif

HWY_BEFORE_NAMESPACE();
namespace sunfleck::shrinkage::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<double, at_once> reals;
const hn::RebindToUnsigned<decltype(reals)> words;
using Reals = hn::Vec<decltype(reals)>;

HWY_INLINE Reals all(double value) {
  return hn::Set(reals, value);
}

HWY_INLINE Reals from(const Eight& values, std::size_t i) {
  return hn::LoadU(reals, values.data() + i);
}

HWY_INLINE void to(Eight& values, std::size_t i, Reals what) {
  hn::StoreU(what, reals, values.data() + i);
}

// Calls take(first lane) for each vector of an eight.
template <class Take>
HWY_INLINE void for_each_vector(const Take& take) {
  for (std::size_t i = 0; i < at_once; i += hn::Lanes(reals)) take(i);
}

// Returns the exponential of numbers from least_exponent to 0, to a few units in the last place: 2^n times a power series of the
// rest. Products and sums are rounded one by one, because not every processor has joint ones.
HWY_INLINE Reals exp_of(Reals x) {
  constexpr double log2_of_e = 0x1.71547652b82fep+0;
  constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;
  const Reals rounding = all(0x1.8p52);  // adding it leaves the nearest whole number in the lowest bits
  const Reals shifted = hn::Add(hn::Mul(x, all(log2_of_e)), rounding);
  const Reals n = hn::Sub(shifted, rounding);
  const Reals rest = hn::Sub(hn::Sub(x, hn::Mul(n, all(ln2_high))), hn::Mul(n, all(ln2_low)));
  Reals series = all(1.0);
  for (const double inverse : inverse_numbers) series = hn::Add(hn::Mul(hn::Mul(series, rest), all(inverse)), all(1.0));
  const auto power = hn::ShiftLeft<52>(hn::Add(hn::BitCast(words, shifted), hn::Set(words, 1023)));
  return hn::Mul(series, hn::BitCast(reals, power));
}

// Finds for each component the inverse variance of a seen difference and its likelihood, up to a common factor: the exponent is
// largest for the last component.
HWY_INLINE void find_likelihoods(const Differences& of, OfComponents& inverse_variances, OfComponents& likelihoods) {
  for_each_vector([&](std::size_t i) HWY_ATTR {
    const Reals noise = hn::Max(from(of.noise, i), all(least_noise));
    const Reals half_square = hn::Mul(hn::Mul(all(0.5), from(of.seen, i)), from(of.seen, i));
    const Reals last = hn::Div(all(1.0), hn::Add(all(Shrinkage::variances.back()), noise));
    for (std::size_t k = 0; k < components; ++k) {
      const Reals inverse = hn::Div(all(1.0), hn::Add(all(Shrinkage::variances[k]), noise));
      const Reals exponent = hn::Max(hn::Mul(half_square, hn::Sub(last, inverse)), all(least_exponent));
      to(inverse_variances.values[k], i, inverse);
      to(likelihoods.values[k], i, hn::Mul(hn::Sqrt(inverse), exp_of(exponent)));
    }
  });
}

// Multiplies likelihoods by the shares of the components, and scales the products of each difference to the sum `scale`.
HWY_INLINE void find_parts(const OfComponents& likelihoods, const Shrinkage::Values& shares, const Eight& scale,
                           OfComponents& parts) {
  for_each_vector([&](std::size_t i) HWY_ATTR {
    Reals sum = hn::Zero(reals);
    for (std::size_t k = 0; k < components; ++k) sum = hn::Add(sum, hn::Mul(from(likelihoods.values[k], i), all(shares[k])));
    const Reals factor = hn::Div(from(scale, i), sum);
    for (std::size_t k = 0; k < components; ++k) {
      to(parts.values[k], i, hn::Mul(hn::Mul(from(likelihoods.values[k], i), all(shares[k])), factor));
    }
  });
}

std::vector<OfComponents> likelihoods_of(const Samples& samples) {
  std::vector<OfComponents> likelihoods(samples.differences.size());
  OfComponents unused;
  for (std::size_t s = 0; s < likelihoods.size(); ++s) find_likelihoods(samples.differences[s], unused, likelihoods[s]);
  return likelihoods;
}

// Returns the sums over samples of each component's parts.
Shrinkage::Values sum_parts(std::span<const OfComponents> likelihoods, std::span<const Eight> counted,
                            const Shrinkage::Values& shares) {
  OfComponents sums{}, parts;
  for (std::size_t s = 0; s < likelihoods.size(); ++s) {
    find_parts(likelihoods[s], shares, counted[s], parts);
    for_each_vector([&](std::size_t i) HWY_ATTR {
      for (std::size_t k = 0; k < components; ++k) {
        to(sums.values[k], i, hn::Add(from(sums.values[k], i), from(parts.values[k], i)));
      }
    });
  }
  Shrinkage::Values result{};
  for (std::size_t k = 0; k < components; ++k) {
    for (const double sum : sums.values[k]) result[k] += sum;
  }
  return result;
}

// Does what Shrinkage::shrink does with finite noise.
void shrink(const Shrinkage::Values& shares, Differences& eight) {
  OfComponents inverse_variances, parts;
  find_likelihoods(eight, inverse_variances, parts);
  Eight whole;
  whole.fill(1.0);
  find_parts(parts, shares, whole, parts);
  for_each_vector([&](std::size_t i) HWY_ATTR {
    const Reals noise = hn::Max(from(eight.noise, i), all(least_noise));
    Reals mean = hn::Zero(reals), square = hn::Zero(reals);
    for (std::size_t k = 0; k < components; ++k) {
      const Reals part = from(parts.values[k], i);
      const Reals kept = hn::Mul(all(Shrinkage::variances[k]), from(inverse_variances.values[k], i));
      const Reals of_component = hn::Mul(kept, from(eight.seen, i));
      mean = hn::Add(mean, hn::Mul(part, of_component));
      square = hn::Add(square, hn::Mul(part, hn::Add(hn::Mul(of_component, of_component), hn::Mul(kept, noise))));
    }
    const Reals variance = hn::Max(hn::Zero(reals), hn::Sub(square, hn::Mul(mean, mean)));
    to(eight.seen, i, mean);
    to(eight.noise, i, variance);
  });
}

}  // namespace sunfleck::shrinkage::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sunfleck {
namespace shrinkage {

HWY_EXPORT(likelihoods_of);
HWY_EXPORT(sum_parts);
HWY_EXPORT(shrink);

// Returns differences with finite noise, evenly spread over all.
Samples sampled(std::span<const double> seen, std::span<const double> noise) {
  const std::size_t stride = block_count(seen.size(), most_samples);
  Samples samples;
  std::size_t lane = at_once;
  for (std::size_t i = 0; i < seen.size(); i += stride) {
    if (!(noise[i] < infinite)) continue;
    if (lane == at_once) {
      samples.differences.emplace_back().noise.fill(1.0);
      samples.counted.emplace_back();
      lane = 0;
    }
    samples.differences.back().seen[lane] = seen[i];
    samples.differences.back().noise[lane] = noise[i];
    samples.counted.back()[lane] = 1.0;
    samples.count += 1.0;
    ++lane;
  }
  return samples;
}

Shrinkage::Values learned_shares(std::span<const double> seen, std::span<const double> noise) {
  const Samples samples = sampled(seen, noise);
  const std::vector<OfComponents> likelihoods = HWY_DYNAMIC_DISPATCH(likelihoods_of)(samples);
  Shrinkage::Values shares;
  shares.fill(1.0 / components);
  for (int step = 0; step < steps && samples.count > 0.0; ++step) {
    const Shrinkage::Values sums = HWY_DYNAMIC_DISPATCH(sum_parts)(likelihoods, samples.counted, shares);
    for (std::size_t k = 0; k < components; ++k) {
      shares[k] = (preference / components + sums[k]) / (samples.count + preference);
    }
  }
  return shares;
}

void shrink_all(const Shrinkage::Values& shares, std::span<double> seen, std::span<double> noise) {
  double unseen = 0.0;
  for (std::size_t k = 0; k < components; ++k) unseen += shares[k] * Shrinkage::variances[k];
  Differences eight;
  std::array<std::size_t, at_once> places;
  std::size_t taken = 0;
  const auto shrink_taken = [&] {
    HWY_DYNAMIC_DISPATCH(shrink)(shares, eight);
    for (std::size_t lane = 0; lane < taken; ++lane) {
      seen[places[lane]] = eight.seen[lane];
      noise[places[lane]] = eight.noise[lane];
    }
    taken = 0;
  };
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!(noise[i] < infinite)) {
      seen[i] = 0.0;
      noise[i] = unseen;
      continue;
    }
    eight.seen[taken] = seen[i];
    eight.noise[taken] = noise[i];
    places[taken++] = i;
    if (taken == at_once) shrink_taken();
  }
  shrink_taken();
}

}  // namespace shrinkage

Shrinkage::Shrinkage(std::span<const double> differences, std::span<const double> noise)
    : shares_(shrinkage::learned_shares(differences, noise)) {}

void Shrinkage::shrink(std::span<double> differences, std::span<double> noise) const {
  shrinkage::shrink_all(shares_, differences, noise);
}

}  // namespace sunfleck
#endif
