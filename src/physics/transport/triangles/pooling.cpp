#include "physics/transport/triangles/pooling.h"

#include "physics/transport/triangles/shrinkage.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sunfleck {
namespace {

constexpr std::size_t scales = 12;
// A scale with fewer comparisons between the halves uses the noise of all scales together.
constexpr double least_comparisons = 16.0;
// A part keeps at least this share of its expected light.
constexpr double least_share = 1e-3;
// Weights are at least this part of the largest, so that no sum of weights loses one to rounding.
constexpr double least_weight = 1e-9;
// The variance that an average over trees keeps at least of that of a single tree.
constexpr double least_part_of_variance = 0.25;
constexpr double infinite = std::numeric_limits<double>::infinity();
// Where no packet landed, the flux may still be that of 3.69 packets (95 %), which is 1.88 times 1.96.
constexpr double unseen_deviations = 1.88;

std::size_t scale_of(const TreeCut& cut) {
  return std::min<std::size_t>(static_cast<std::size_t>(std::bit_width(cut.whole.size())), scales - 1);
}

// What landed in the two halves of a run.
struct Halves {
  [[nodiscard]] double both() const { return a + b; }
  friend Halves operator+(const Halves& x, const Halves& y) { return {x.a + y.a, x.b + y.b}; }
  friend Halves operator-(const Halves& x, const Halves& y) { return {x.a - y.a, x.b - y.b}; }

  double a = 0.0, b = 0.0;
};

// Returns the sums of value(element) up to each place.
template <class ValueOf>
auto running_sums(const SurfaceTree& tree, const ValueOf& value) {
  std::vector<decltype(value(0))> sums(tree.order.size() + 1);
  for (std::size_t k = 0; k < tree.order.size(); ++k) sums[k + 1] = sums[k] + value(tree.order[k]);
  return sums;
}

std::vector<double> resolvable(std::span<const double> weights) {
  const double least = weights.empty() ? 0.0 : least_weight * *std::max_element(weights.begin(), weights.end());
  std::vector<double> resolved(weights.begin(), weights.end());
  for (double& weight : resolved) weight = std::max(weight, least);
  return resolved;
}

template <class Value>
Value in(const std::vector<Value>& sums, const TreeRange& range) {
  return sums[range.end] - sums[range.begin];
}

TreeRange first_part(const TreeCut& cut) {
  return {cut.whole.begin, cut.middle};
}

TreeWeights weigh(const SurfaceTree& tree, std::span<const double> weights) {
  TreeWeights of_tree{running_sums(tree, [&](std::uint32_t e) { return weights[e]; }), {}, {}};
  of_tree.expected.reserve(tree.cuts.size());
  of_tree.spreads.reserve(tree.cuts.size());
  for (const TreeCut& cut : tree.cuts) {
    const double expected = in(of_tree.sums, first_part(cut)) / in(of_tree.sums, cut.whole);
    of_tree.expected.push_back(expected);
    of_tree.spreads.push_back(std::sqrt(expected * (1.0 - expected)));
  }
  return of_tree;
}

// Pools over one tree.
class TreePooling {
 public:
  TreePooling(const SurfaceTree& tree, const TreeWeights& weights, std::span<const double> half_a,
              std::span<const double> half_b, double noise)
      : tree_(tree), weights_(weights), noise_(noise), landed_(running_sums(tree, [&](std::uint32_t e) {
          return Halves{half_a[e], half_b[e]};
        })) {}

  // Returns flux and variance by place in the order of the tree.
  PooledLight run() {
    compare();
    for (Scale& scale : scales_) shrink(scale);
    return divide();
  }

 private:
  // Sums over comparisons of the halves: squared differences of the mean, times the flux. Their mean is the variance of a split's
  // difference times its flux.
  struct Noise {
    double squares = 0.0, count = 0.0;
    [[nodiscard]] double mean() const { return count > 0.0 ? squares / count : 0.0; }
  };

  // The splits of one scale, in the order of the cuts.
  struct Scale {
    std::vector<double> differences;  // between the first part's share and that expected
    std::vector<double> fluxes;       // of both halves
    std::vector<double> variances;    // of true differences
    Noise noise;
  };

  void compare() {
    for (std::size_t k = 0; k < tree_.cuts.size(); ++k) {
      const TreeCut& cut = tree_.cuts[k];
      const double expected = weights_.expected[k];
      const double spread = weights_.spreads[k];
      const Halves whole = in(landed_, cut.whole), in_first = in(landed_, first_part(cut));
      const double flux = whole.both();
      Scale& scale = scales_[scale_of(cut)];
      scale.fluxes.push_back(flux);
      scale.differences.push_back(flux > 0.0 ? (in_first.both() / flux - expected) / spread : 0.0);
      if (!(whole.a > 0.0 && whole.b > 0.0)) continue;
      const double between = (in_first.a / whole.a - in_first.b / whole.b) / spread;
      for (Noise* noise : {&scale.noise, &noise_of_all_}) {
        noise->squares += 0.25 * between * between * flux;
        noise->count += 1.0;
      }
    }
  }

  // Returns the noise of all scales together.
  [[nodiscard]] double noise_of_all() const { return noise_of_all_.count < least_comparisons ? noise_ : noise_of_all_.mean(); }

  // Replaces the differences of a scale by true ones.
  void shrink(Scale& scale) const {
    const double noise_flux = scale.noise.count < least_comparisons ? noise_of_all() : scale.noise.mean();
    scale.variances.reserve(scale.fluxes.size());
    for (const double flux : scale.fluxes) scale.variances.push_back(flux > 0.0 ? noise_flux / flux : infinite);
    Shrinkage(scale.differences, scale.variances).shrink(scale.differences, scale.variances);
  }

  // Passes the flux of each surface down to its elements. All places of a range have the same flux for a unit of weight and the
  // same relative variance until the range is cut, so the first of them holds both for all.
  [[nodiscard]] PooledLight divide() const {
    const std::size_t places = tree_.order.size();
    std::vector<double> density(places), relative(places);
    for (const TreeRange& surface : tree_.surfaces) {
      const double flux = in(landed_, surface).both();
      density[surface.begin] = flux / in(weights_.sums, surface);
      relative[surface.begin] = flux > 0.0 ? noise_of_all() / flux : 0.0;
    }
    std::array<std::size_t, scales> next{};  // [scale], number of its next split
    for (std::size_t k = 0; k < tree_.cuts.size(); ++k) {
      const TreeCut& cut = tree_.cuts[k];
      const double expected = weights_.expected[k];
      const double spread = weights_.spreads[k];
      const Scale& scale = scales_[scale_of(cut)];
      const std::size_t in_scale = next[scale_of(cut)]++;
      const double share = std::clamp(expected + scale.differences[in_scale] * spread, least_share * expected,
                                      1.0 - least_share * (1.0 - expected));
      const double variance_of_share = scale.variances[in_scale] * spread * spread;
      const std::uint32_t whole = cut.whole.begin;
      const auto pass = [&](std::uint32_t to, double part, double expected_part) {
        density[to] = density[whole] * (part / expected_part);
        relative[to] = relative[whole] + variance_of_share / (part * part);
      };
      pass(cut.middle, 1.0 - share, 1.0 - expected);
      pass(whole, share, expected);
    }
    return light({std::move(density), std::move(relative)});
  }

  // Returns the light of places with that flux for a unit of weight and that relative variance.
  [[nodiscard]] PooledLight light(PooledLight pooled) const {
    for (const TreeRange& surface : tree_.surfaces) {
      const bool dark = !(in(landed_, surface).both() > 0.0);
      for (std::uint32_t k = surface.begin; k < surface.end; ++k) {
        const double weight = weights_.sums[k + 1] - weights_.sums[k];
        pooled.flux[k] *= weight;
        if (dark) {
          const double unseen = unseen_deviations * noise_of_all() * weight / in(weights_.sums, surface);
          pooled.variance[k] = unseen * unseen;
        } else {
          pooled.variance[k] = pooled.variance[k] * pooled.flux[k] * pooled.flux[k];
        }
      }
    }
    return pooled;
  }

  const SurfaceTree& tree_;
  const TreeWeights& weights_;
  double noise_;
  std::vector<Halves> landed_;  // [place + 1], running sums
  std::array<Scale, scales> scales_;
  Noise noise_of_all_;
};

}  // namespace

Pooling::Pooling(std::span<const SurfaceTree> trees, std::span<const double> weights)
    : trees_(trees), weights_(weights), of_trees_(trees.size()) {
  const std::vector<double> resolved = resolvable(weights);
  tbb::parallel_for(std::size_t{0}, trees.size(), [&](std::size_t t) { of_trees_[t] = weigh(trees_[t], resolved); });
}

PooledLight Pooling::pool(std::span<const double> half_a, std::span<const double> half_b, double noise) const {
  const std::size_t elements = weights_.size();
  PooledLight pooled{std::vector<double>(elements), std::vector<double>(elements)};
  std::vector<PooledLight> of_tree(trees_.size());
  tbb::parallel_for(std::size_t{0}, trees_.size(),
                    [&](std::size_t t) { of_tree[t] = TreePooling(trees_[t], of_trees_[t], half_a, half_b, noise).run(); });
  const double share = 1.0 / static_cast<double>(trees_.size());
  std::vector<double> squares(elements);
  // The trees have the same surfaces, each at the same places.
  const std::vector<TreeRange>& surfaces = trees_.front().surfaces;
  tbb::parallel_for(std::size_t{0}, surfaces.size(), [&](std::size_t s) {
    for (std::size_t t = 0; t < trees_.size(); ++t) {
      for (std::size_t k = surfaces[s].begin; k < surfaces[s].end; ++k) {
        const std::uint32_t e = trees_[t].order[k];
        pooled.flux[e] += share * of_tree[t].flux[k];
        squares[e] += share * of_tree[t].flux[k] * of_tree[t].flux[k];
        pooled.variance[e] += share * of_tree[t].variance[k];
      }
    }
  });
  // The mean over the trees is better than a single tree by as much as they differ from it (Krogh and Vedelsby 1995, NIPS 7).
  for (std::size_t e = 0; e < elements; ++e) {
    const double between = squares[e] - pooled.flux[e] * pooled.flux[e];
    pooled.variance[e] = std::max(least_part_of_variance * pooled.variance[e], pooled.variance[e] - between);
  }
  for (std::size_t e = 0; e < elements; ++e) {
    if (!(weights_[e] > 0.0)) pooled.flux[e] = half_a[e] + half_b[e];
  }
  return pooled;
}

}  // namespace sunfleck
