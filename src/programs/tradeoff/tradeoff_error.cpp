#include "programs/tradeoff/tradeoff_error.h"

#include "base/check.h"
#include "base/units.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

constexpr std::size_t number(Quantity quantity) {
  return static_cast<std::size_t>(quantity);
}

}  // namespace

void TradeoffReference::add(const RunValues& part) {
  ++parts_;
  for (std::size_t q = 0; q < part.size(); ++q) {
    means_[q].resize(part[q].value.size());
    for (std::size_t i = 0; i < means_[q].size(); ++i) means_[q][i].add(part[q].value[i]);
  }
}

RunValues TradeoffReference::values() const {
  RunValues values;
  for (std::size_t q = 0; q < means_.size(); ++q) {
    for (const ReplicateMean& mean : means_[q]) values[q].value.push_back(mean.mean());
  }
  return values;
}

double TradeoffReference::own_error(Quantity quantity) const {
  const QuantityNorm& norm = norms_[number(quantity)];
  double squares = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < norm.weight.size(); ++i) {
    if (norm.weight[i] == 0.0) continue;
    const double relative = means_[number(quantity)][i].standard_error() / norm.scale[i];
    squares += norm.weight[i] * relative * relative;
    weights += norm.weight[i];
  }
  return weights > 0.0 ? std::sqrt(squares / weights) : no_value;
}

bool TradeoffReference::resolves(const TradeoffReference& runs, Quantity quantity) const {
  constexpr double significant = 3.0;
  const QuantityNorm& norm = norms_[number(quantity)];
  const std::vector<ReplicateMean>& truth = means_[number(quantity)];
  const std::vector<ReplicateMean>& means = runs.means_[number(quantity)];
  if (means.size() != truth.size() || runs.parts() < 2) return true;
  double apart = 0.0, of_means = 0.0, of_truth = 0.0;  // sums of squares
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (norm.weight[i] == 0.0) continue;
    const double weight = norm.weight[i] / (norm.scale[i] * norm.scale[i]);
    const auto square = [weight](double value) { return weight * value * value; };
    apart += square(means[i].mean() - truth[i].mean());
    of_means += square(means[i].standard_error());
    of_truth += square(truth[i].standard_error());
  }
  const double scatter = of_means * static_cast<double>(runs.parts());
  return apart <= significant * significant * (of_means + of_truth) && of_truth <= scatter;
}

QuantityError TradeoffReference::error(Quantity quantity, const QuantityValues& run, double confidence,
                                       std::size_t replicates) const {
  const QuantityNorm& norm = norms_[number(quantity)];
  const std::vector<ReplicateMean>& truth = means_[number(quantity)];
  QuantityError error{no_value, no_value, no_value, no_value};
  if (run.value.size() != truth.size()) return error;
  EXPECT(norm.weight.size(), ==, truth.size());
  const double quantile = t_quantile(confidence, replicates);
  double squares = 0.0, weights = 0.0, largest = 0.0, reported_squares = 0.0, reported_weights = 0.0, covered_weights = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double weight = norm.weight[i];
    if (weight == 0.0) continue;
    const double difference = std::abs(run.value[i] - truth[i].mean());
    const double relative = difference / norm.scale[i];
    squares += weight * relative * relative;
    weights += weight;
    largest = std::max(largest, relative);
    const double half_width = run.half_width[i];
    if (std::isnan(half_width)) continue;
    const double of_truth = quantile * truth[i].standard_error();
    reported_squares += weight * half_width * half_width / (norm.scale[i] * norm.scale[i]);
    reported_weights += weight;
    if (difference <= std::hypot(half_width, of_truth)) covered_weights += weight;
  }
  if (weights == 0.0) return error;
  error.true_error = std::sqrt(squares / weights);
  if (quantity != Quantity::triangle) error.largest = largest;
  if (reported_weights == 0.0) return error;
  error.reported = std::sqrt(reported_squares / reported_weights);
  error.covered = covered_weights / reported_weights;
  return error;
}

double typical_error(const std::vector<double>& errors, double reference_error) {
  double squares = 0.0;
  for (const double error : errors) squares += error * error;
  if (errors.empty() || std::isnan(squares)) return no_value;
  const double mean = squares / static_cast<double>(errors.size());
  const double own = mean - (std::isnan(reference_error) ? 0.0 : reference_error * reference_error);
  return own >= 0.5 * mean && own > 0.0 ? std::sqrt(own) : no_value;
}

}  // namespace sunfleck
