#pragma once
// The light of single elements, estimated with the help of their neighbours on the same surface: where the spread between two
// halves of a run does not tell neighbours apart, they share their light; where it does, they keep it.

#include "physics/transport/triangles/surface_tree.h"

#include <span>
#include <vector>

namespace sunfleck {

struct PooledLight {
  std::vector<double> flux;      // [element], in the unit of the halves; the sum over a surface is that of the halves
  std::vector<double> variance;  // [element], of that flux
};

// What the weights of elements say of a tree.
struct TreeWeights {
  std::vector<double> sums;      // [place + 1], running
  std::vector<double> expected;  // [cut], share of the first part
  // [cut], what scales differences of shares to a noise that is the same for all splits of one flux
  std::vector<double> spreads;
};

// Pools the flux that landed on elements in two independent halves of a run. A range of a tree divides its flux among its two
// parts by their weights, corrected by the part of the seen difference that adaptive shrinkage takes for true: a multiscale
// model of counts in the manner of Kolaczyk (1999, J. Am. Stat. Assoc. 94:920), with the noise of each scale taken from the
// difference between the halves. The results are averages over the trees.
class Pooling {
 public:
  // `weights` are [element]: the flux on an element is expected to be in proportion to its weight. An element without weight keeps
  // what landed there, with variance 0. Both arguments must outlive the object.
  Pooling(std::span<const SurfaceTree> trees, std::span<const double> weights);

  // Where the parts of surfaces allow too few comparisons of the halves to know the noise, as where each surface is a single
  // element, it is `noise`: the variance of the flux on a surface for a unit of that flux.
  [[nodiscard]] PooledLight pool(std::span<const double> half_a, std::span<const double> half_b, double noise) const;

 private:
  std::span<const SurfaceTree> trees_;
  std::span<const double> weights_;
  std::vector<TreeWeights> of_trees_;
};

}  // namespace sunfleck
