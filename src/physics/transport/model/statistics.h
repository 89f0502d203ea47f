#pragma once
// Mean and confidence interval of independent, equal replicates.

#include <cstddef>
#include <limits>

namespace sunfleck {

// A value with the half-width of its confidence interval, in the value's unit; NaN if there are too few replicates.
struct Estimate {
  double value = 0.0;
  double half_width = std::numeric_limits<double>::quiet_NaN();

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.value, self.half_width);
  }

  [[nodiscard]] Estimate scaled(double factor) const { return {value * factor, half_width * (factor < 0 ? -factor : factor)}; }
};

// Running mean and sum of squared deviations (Welford 1962, Technometrics 4:419).
class ReplicateMean {
 public:
  void add(double value) {
    ++count_;
    const double delta = value - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (value - mean_);
    zeros_ += value == 0.0 ? 1 : 0;
    last_ = value;
  }

  // Passes the whole state to `archive`.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.count_, self.zeros_, self.mean_, self.squares_);
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  // Returns the value that was added last; it is no part of the state that `visit` passes.
  [[nodiscard]] double last() const { return last_; }
  [[nodiscard]] double squares() const { return squares_; }
  // Returns the standard error of the mean; NaN below two replicates.
  [[nodiscard]] double standard_error() const;
  [[nodiscard]] Estimate estimate(double t_quantile) const { return {mean_, t_quantile * standard_error()}; }
  // Returns whether the spread of the replicates is a poor guess: where they agree, perhaps by chance, and where so few events came
  // that half of them had none.
  [[nodiscard]] bool says_little() const { return count_ >= 2 && (squares_ == 0.0 || 2 * zeros_ >= count_); }
  // Returns the same as above, but where the spread says little the half-width is at least `unseen`, the amount that may have
  // escaped all replicates.
  [[nodiscard]] Estimate estimate(double t_quantile, double unseen) const;
  // Returns the same for the mean sunlit area out of `whole`, of which a ray shows the more the nearer to edge-on it lands.
  // Unless the spread says little, `unseen` is the area of parts nearer to edge-on than all that rays met: the replicates may
  // have missed what would change the area most. If as much of it as of the rest is sunlit, or up to twice as much, and that is
  // more than three times what the spread tells, it is the half-width.
  [[nodiscard]] Estimate estimate_of_area(double t_quantile, double unseen, double whole) const;

 private:
  std::size_t count_ = 0, zeros_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
  double last_ = 0.0;
};

// Returns the largest expected number of events that is consistent with none having been seen: the upper end of the
// two-sided confidence interval of a Poisson mean (Garwood 1936, Biometrika 28:437), 3.69 at 95 %. Divided by the number of
// trials it is the upper end for a share, a little above that of Clopper and Pearson (1934, Biometrika 26:404).
[[nodiscard]] double unseen_events(double confidence);

// Returns the ratio of half-width to standard error for a two-sided interval: Student's t with replicates - 1 degrees of
// freedom; NaN below two replicates.
[[nodiscard]] double t_quantile(double confidence, std::size_t replicates);

// Returns that ratio where the standard error is known.
[[nodiscard]] double normal_quantile(double confidence);

}  // namespace sunfleck
