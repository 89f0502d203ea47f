#pragma once
// The sunlit and the shaded part of leaves and organs, and what each absorbs: the two classes of leaf area with which canopy
// models compute photosynthesis (e.g. de Pury and Farquhar 1997, Plant Cell Environ. 20:537).

#include "physics/transport/indirect/conversion.h"
#include "physics/transport/indirect/replicate.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/statistics.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sunfleck {

// A ratio of two means over replicates, whose error includes that both vary together.
class RatioMean {
 public:
  // `other` is the part of the numerator that rays and packets bring of which few may come.
  void add(double numerator, double denominator, double other);

  // Passes the whole state to `archive`.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.numerator_, self.denominator_, self.products_, self.without_other_);
  }

  // Returns the ratio of the means; NaN unless the denominator is known to be above 0. Its half-width follows from the spread
  // of numerator - ratio * denominator (Cochran 1977, Sampling Techniques, eq. 6.13) or, if that is 0, from an `unseen` part of
  // the numerator. It is at least that of `unseen_other` where half of the replicates had none of the other part.
  [[nodiscard]] Estimate estimate(double t_quantile, double unseen, double unseen_other) const;

  // Returns the mean numerator.
  [[nodiscard]] double numerator() const { return numerator_.mean(); }

 private:
  ReplicateMean numerator_, denominator_;
  double products_ = 0.0;          // sum of the products of both deviations
  std::size_t without_other_ = 0;  // replicates
};

// The standard deviation of a density over an area, from what every replicate finds. One part of the density is known without
// noise wherever the area is found, such as a beam's; the other only as a noisy estimate of each triangle's, whose square would
// be too large: its mean square comes from products of different replicates, each multiplied with the sum of all before.
class SpreadMean {
 public:
  // What a replicate finds: integrals over the area, except for `noisy_square`.
  struct Sums {
    double area = 0.0;
    double density = 0.0;
    double square = 0.0;        // of the density's square, except the square of its noisy part
    double noisy_square = 0.0;  // of the noisy part's estimate times the sum of the estimates of all earlier replicates
  };

  // Adds a replicate.
  void add(const Sums& sums);

  // Passes the whole state to `archive`.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.count_, self.means_, self.weighted_means_, self.products_);
  }

  // Returns the square root of mean square / mean area - (mean integral / mean area)^2; NaN below two replicates or without area.
  // Its half-width follows from the first-order expansion in the means, whose covariances are those of the replicates (the delta
  // method, e.g. Cochran 1977, Sampling Techniques, section 6.3). The mean product of different replicates counts twice there,
  // since each replicate is a factor on either side (Hoeffding 1948, Ann. Math. Stat. 19:293, the first projection of a
  // U-statistic). `t_quantile` is that of effective(replicates).
  [[nodiscard]] Estimate estimate(double t_quantile) const;

  // Returns the number of equally weighted replicates that tell as much of the covariances, (sum w)^2 / sum w^2.
  [[nodiscard]] static std::size_t effective(std::size_t replicates) { return replicates * 3 / 4; }

 private:
  static constexpr std::size_t size = 4;

  std::size_t count_ = 0;
  std::array<double, size - 1> means_{};  // area, density, square
  // The same and the product with the mean of all earlier replicates, each weighted by their number: the products of later
  // replicates are less noisy, and this is the weight of all products of two different replicates.
  std::array<double, size> weighted_means_{};
  std::array<double, size * size> products_{};  // weighted sums of products of two deviations
};

struct ShadeMeans {
  ReplicateMean lit_m2;
  std::vector<RatioMean> sunlit, shaded;                 // [band], W m-2 of the class's area
  std::vector<SpreadMean> sunlit_spread, shaded_spread;  // [band], W m-2

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.lit_m2, self.sunlit, self.shaded, self.sunlit_spread, self.shaded_spread);
  }
};

// The means of all groups over the replicates of a run.
class ShadeClasses {
 public:
  // The conversion must outlive the object.
  explicit ShadeClasses(const Conversion& conversion, ShadeGroups groups = ShadeGroups::all);

  // Adds a replicate, and its landings to `landed`, what landed on each side in all replicates added before.
  void add(const Replicate& replicate, PlaceSums& landed);

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    for (auto* groups : {&self.organs_, &self.layers_, &self.leaves_}) archive(*groups);
  }

  // Return the classes of an organ, of the leaves in a layer, or of all leaves; the first two are empty unless all groups are
  // kept. `unseen_lit_m2` is the least half-width of a sunlit area of which the replicates show little, `unshot_share` is [band],
  // `event_w` the flux that one event brings, [band], and `other_event_w` that of an event that is not the beam's.
  struct Errors {
    double t_quantile = 0.0, spread_quantile = 0.0, unseen_events = 0.0;
    std::vector<double> unshot_share, event_w, other_event_w;
  };
  [[nodiscard]] ShadeClassResult organ(std::size_t organ, double unseen_lit_m2, const Errors& errors) const;
  [[nodiscard]] ShadeClassResult layer(std::size_t layer, double unseen_lit_m2, const Errors& errors) const;
  [[nodiscard]] ShadeClassResult leaves(double unseen_lit_m2, const Errors& errors) const;

 private:
  [[nodiscard]] ShadeClassResult result(const ShadeMeans& means, double open_m2, double unseen_lit_m2,
                                        const Errors& errors) const;

  const Conversion& conversion_;
  bool all_groups_;
  std::vector<ShadeMeans> organs_, layers_, leaves_;  // the last has one entry
};

}  // namespace sunfleck
