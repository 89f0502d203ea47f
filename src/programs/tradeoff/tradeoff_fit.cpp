#include "programs/tradeoff/tradeoff_fit.h"

#include "base/units.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

// Limits beyond the finest setting: the error falls as a power of the bound between these two, whatever a few settings suggest;
// the time grows at most with the square of the bound's inverse, as packets do.
constexpr double least_error_slope = 0.5, most_error_slope = 1.0;
constexpr double most_time_slope = 2.0;
// A bound is extrapolated down to this share of the finest one measured; what is forecast beyond that means nothing.
constexpr double least_extrapolated = 0.1;

double rms(const TradeoffLevel& level, Quantity quantity) {
  double squares = 0.0;
  for (const TradeoffRun& run : level.runs) {
    const double error = run.errors[static_cast<std::size_t>(quantity)].true_error;
    squares += error * error;
  }
  return level.runs.empty() ? no_value : std::sqrt(squares / static_cast<double>(level.runs.size()));
}

// One setting of the series of bounds, in logarithms. The error is the larger of this and any finer setting's, so that it never
// falls as the bound widens.
struct Step {
  double bound = 0.0, error = 0.0, seconds = 0.0;
};

// Returns the steps from the widest bound to the finest.
std::vector<Step> bound_steps(const std::vector<TradeoffLevel>& levels, Quantity quantity) {
  std::vector<Step> steps;
  for (const TradeoffLevel& level : levels) {
    const double error = level.error[static_cast<std::size_t>(quantity)];
    if (level.series != TradeoffSeries::bounds || !(error > 0.0)) continue;
    steps.push_back({std::log(level.value), std::log(error), std::log(std::max(median_seconds(level), 1e-6))});
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.bound > b.bound; });
  for (std::size_t i = steps.size(); i-- > 1;) steps[i - 1].error = std::max(steps[i - 1].error, steps[i].error);
  return steps;
}

double largest_excess(const std::vector<TradeoffLevel>& levels, Quantity quantity) {
  double largest = 1.0;
  for (const TradeoffLevel& level : levels) {
    const double typical = rms(level, quantity);
    if (level.series != TradeoffSeries::bounds || !(level.error[static_cast<std::size_t>(quantity)] > 0.0)) continue;
    for (const TradeoffRun& run : level.runs)
      largest = std::max(largest, run.errors[static_cast<std::size_t>(quantity)].true_error / typical);
  }
  return largest;
}

// Interpolates between the steps on both sides of `at`; beyond the finest it extrapolates with the slope between the last two,
// clamped to the limits.
double interpolated(const std::vector<Step>& steps, double Step::*from, double Step::*to, double at, double least_slope,
                    double most_slope) {
  if (steps.size() == 1) return steps[0].*to;
  std::size_t i = 1;
  while (i + 1 < steps.size() && steps[i].*from > at) ++i;
  const Step& wide = steps[i - 1];
  const Step& fine = steps[i];
  const double run = wide.*from - fine.*from;
  double slope = run > 0.0 ? (wide.*to - fine.*to) / run : most_slope;
  if (at < fine.*from) slope = std::clamp(slope, least_slope, most_slope);
  return fine.*to + slope * (at - fine.*from);
}

double two_digits_down(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / step * (1.0 + 1e-9)) * step;
}

}  // namespace

std::optional<PowerLaw> fit_power_law(std::span<const WorkAndError> points) {
  std::vector<WorkAndError> logarithms;
  for (const WorkAndError& point : points) {
    const bool there = point.work > 0.0 && point.error > 0.0 && std::isfinite(point.work) && std::isfinite(point.error);
    if (there) logarithms.push_back({std::log(point.work), std::log(point.error)});
  }
  const auto n = static_cast<double>(logarithms.size());
  WorkAndError mean;
  for (const WorkAndError& point : logarithms) {
    mean.work += point.work / n;
    mean.error += point.error / n;
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const WorkAndError& point : logarithms) {
    xx += (point.work - mean.work) * (point.work - mean.work);
    xy += (point.work - mean.work) * (point.error - mean.error);
    yy += (point.error - mean.error) * (point.error - mean.error);
  }
  if (!(xx > 0.0)) return {};
  PowerLaw law;
  law.points = logarithms.size();
  law.exponent = xy / xx;
  law.factor = std::exp(mean.error - law.exponent * mean.work);
  law.standard_error = logarithms.size() > 2 ? std::sqrt(std::max(0.0, yy - law.exponent * xy) / (n - 2.0) / xx) : no_value;
  return law;
}

std::vector<TradeoffFit> fit_series(const std::vector<TradeoffLevel>& levels) {
  std::vector<TradeoffFit> fits;
  for (const TradeoffSeries series : {TradeoffSeries::grids, TradeoffSeries::packets}) {
    for (const Quantity quantity : quantities) {
      std::vector<WorkAndError> rays, seconds;
      for (const TradeoffLevel& level : levels) {
        if (level.series != series) continue;
        const double error = level.error[static_cast<std::size_t>(quantity)];
        rays.push_back({mean_rays(level), error});
        seconds.push_back({median_seconds(level), error});
      }
      const std::optional<PowerLaw> of_rays = fit_power_law(rays), of_seconds = fit_power_law(seconds);
      if (of_rays && of_seconds) fits.push_back({series, quantity, *of_rays, *of_seconds});
    }
  }
  return fits;
}

std::optional<Recommendation> recommend(const std::vector<TradeoffLevel>& levels, double requested_error, Quantity quantity) {
  const std::vector<Step> steps = bound_steps(levels, quantity);
  if (steps.empty()) return {};
  Recommendation found;
  found.requested_error = requested_error;
  found.quantity = quantity;
  found.margin = largest_excess(levels, quantity);
  const double wanted = std::log(requested_error / found.margin);
  double bound = steps.front().bound;
  if (steps.front().error > wanted) {
    if (steps.size() == 1) return {};
    // Lowering the error by one logarithmic unit lowers the bound by 1 / slope.
    bound = interpolated(steps, &Step::error, &Step::bound, wanted, 1.0 / most_error_slope, 1.0 / least_error_slope);
  }
  found.bound = two_digits_down(std::exp(bound));
  bound = std::log(found.bound);
  found.extrapolated = bound < steps.back().bound - 0.01;
  if (bound < steps.back().bound + std::log(least_extrapolated)) return {};
  found.expected = std::exp(interpolated(steps, &Step::bound, &Step::error, bound, least_error_slope, most_error_slope));
  // A wider bound takes less time, so the slope of the seconds is negative.
  found.seconds = std::exp(interpolated(steps, &Step::bound, &Step::seconds, bound, -most_time_slope, 0.0));
  return found;
}

}  // namespace sunfleck
