#include "physics/transport/solve/shade_classes.h"

#include "base/units.h"
#include "physics/transport/solve/shade_sums.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace sunfleck {
namespace {

// Adds the sums of one replicate to the means of its groups, of which light can reach `open_m2`.
void add_to(std::vector<ShadeMeans>& means, const ShadeSums& sums, std::span<const double> open_m2) {
  for (std::size_t i = 0; i < sums.groups(); ++i) {
    const double lit_m2 = sums.lit_m2[i];
    const double shaded_m2 = open_m2[i] - lit_m2;
    means[i].lit_m2.add(lit_m2);
    for (std::size_t b = 0; b < sums.bands; ++b) {
      const std::size_t k = i * sums.bands + b;
      const double sunlit_w = sums.direct_w[k] + sums.lit_indirect_w[k];
      const double shaded_w = sums.indirect_w[k] - sums.lit_indirect_w[k];
      means[i].sunlit[b].add(sunlit_w, lit_m2, sums.lit_indirect_w[k]);
      means[i].shaded[b].add(shaded_w, shaded_m2, shaded_w);
      means[i].sunlit_spread[b].add({lit_m2, sunlit_w, sums.lit_square[k], sums.lit_indirect_square[k]});
      means[i].shaded_spread[b].add({shaded_m2, shaded_w, 0.0, sums.indirect_square[k] - sums.lit_indirect_square[k]});
    }
  }
}

}  // namespace

void RatioMean::add(double numerator, double denominator, double other) {
  const double from_old_mean = numerator_.count() > 0 ? numerator - numerator_.mean() : 0.0;
  numerator_.add(numerator);
  denominator_.add(denominator);
  products_ += from_old_mean * (denominator - denominator_.mean());
  without_other_ += other == 0.0 ? 1 : 0;
}

Estimate RatioMean::estimate(double t_quantile, double unseen, double unseen_other) const {
  if (!(denominator_.mean() > t_quantile * denominator_.standard_error())) return {no_value, no_value};
  const double ratio = numerator_.mean() / denominator_.mean();
  const double squares = std::max(0.0, numerator_.squares() - 2.0 * ratio * products_ + ratio * ratio * denominator_.squares());
  const auto n = static_cast<double>(numerator_.count());
  double half_width = squares > 0.0 ? t_quantile * std::sqrt(squares / (n - 1.0) / n) : unseen;
  if (2 * without_other_ >= numerator_.count()) half_width = std::max(half_width, unseen_other);
  return {ratio, half_width / denominator_.mean()};
}

void SpreadMean::add(const Sums& sums) {
  const auto earlier = static_cast<double>(count_++);
  const std::array<double, size> values{sums.area, sums.density, sums.square,
                                        earlier > 0.0 ? sums.noisy_square / earlier : 0.0};
  for (std::size_t i = 0; i < means_.size(); ++i) means_[i] += (values[i] - means_[i]) / static_cast<double>(count_);
  if (earlier == 0.0) return;
  // West 1979, Commun. ACM 22:532, eq. 2, for weights `earlier`, whose sum is count * (count - 1) / 2.
  const double part = 2.0 / static_cast<double>(count_);
  std::array<double, size> from_old_means{};
  for (std::size_t i = 0; i < size; ++i) {
    from_old_means[i] = values[i] - weighted_means_[i];
    weighted_means_[i] += from_old_means[i] * part;
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      products_[i * size + j] += earlier * from_old_means[i] * (values[j] - weighted_means_[j]);
    }
  }
}

Estimate SpreadMean::estimate(double t_quantile) const {
  const auto n = static_cast<double>(count_);
  // Turns a weighted sum of squares into the variance of a mean: the weights add up to n (n - 1) / 2, their squares to
  // n (n - 1) (2 n - 1) / 6.
  const double to_variance = 2.0 / (n * (n - 1.0)) / (n - (4.0 * n - 2.0) / (3.0 * (n - 1.0)));
  const auto [area, density, square] = means_;
  if (count_ < 2 || !(area > 0.0)) return {no_value, no_value};
  const double noisy_square = weighted_means_[3];
  const double mean = density / area;
  const double mean_square = (square + noisy_square) / area;
  const double variance = std::max(0.0, mean_square - mean * mean);
  // Derivatives of the variance by the four means; the last twice, as the header says.
  const std::array<double, size> by{(2.0 * mean * mean - mean_square) / area, -2.0 * mean / area, 1.0 / area, 2.0 / area};
  double squares = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) squares += by[i] * by[j] * products_[i * size + j];
  }
  const double half_width = t_quantile * std::sqrt(std::max(0.0, squares) * to_variance);
  // Where the deviation is no larger than its error, the root of the variance's error bounds both.
  const double root = std::sqrt(variance);
  return {root, root > 0.0 ? std::min(half_width / (2.0 * root), std::sqrt(half_width)) : std::sqrt(half_width)};
}

ShadeClasses::ShadeClasses(const Conversion& conversion, ShadeGroups groups)
    : conversion_(conversion), all_groups_(groups == ShadeGroups::all) {
  const std::size_t bands = conversion.quanta.size();
  ShadeMeans means;
  for (auto* ratios : {&means.sunlit, &means.shaded}) ratios->resize(bands);
  for (auto* spreads : {&means.sunlit_spread, &means.shaded_spread}) spreads->resize(bands);
  organs_.assign(all_groups_ ? conversion.areas.organ_open_m2.size() : 0, means);
  layers_.assign(all_groups_ ? conversion.areas.layer_open_foliage_m2.size() : 0, means);
  leaves_.assign(1, means);
}

void ShadeClasses::add(const Replicate& replicate, PlaceSums& landed) {
  const ShadeGroupSums groups = sum_shade_and_add(conversion_, replicate, all_groups_, landed);
  const CanopyAreas& areas = conversion_.areas;
  add_to(organs_, groups.organs, areas.organ_open_m2);
  add_to(layers_, groups.layers, areas.layer_open_foliage_m2);
  add_to(leaves_, groups.leaves, {&areas.open_foliage_m2, 1});
}

ShadeClassResult ShadeClasses::result(const ShadeMeans& means, double open_m2, double unseen_lit_m2,
                                      const Errors& errors) const {
  ShadeClassResult result;
  result.sunlit_m2 = means.lit_m2.estimate_of_area(errors.t_quantile, unseen_lit_m2, open_m2);
  // The estimate is unbiased and may leave this range by chance, although the area cannot.
  result.sunlit_m2.value = std::clamp(result.sunlit_m2.value, 0.0, open_m2);
  result.shaded_m2 = {open_m2 - result.sunlit_m2.value, result.sunlit_m2.half_width};
  for (std::size_t b = 0; b < means.sunlit.size(); ++b) {
    const double absorbed_w = means.sunlit[b].numerator() + means.shaded[b].numerator();
    const auto add_class = [&](const RatioMean& ratio, const SpreadMean& spread, const Estimate& class_m2, auto& absorbed,
                               auto& spreads) {
      const bool is_known = class_m2.value > class_m2.half_width;  // to be there
      Estimate flux{no_value, no_value};
      if (is_known) {
        flux = ratio.estimate(errors.t_quantile, errors.unseen_events * errors.event_w[b],
                              errors.unseen_events * errors.other_event_w[b]);
      }
      // So may this estimate, where its class is small. It is moved to between nothing and all that the group absorbs, so that both
      // classes together absorb that; but that is not certain either.
      const double most = std::max(0.0, absorbed_w) / class_m2.value;
      if (!std::isnan(flux.value)) {
        const double moved = std::clamp(flux.value, class_m2.value == open_m2 ? most : 0.0, most);
        flux.half_width += std::abs(moved - std::exchange(flux.value, moved));
      }
      flux.half_width += flux.value * errors.unshot_share[b];
      absorbed.push_back(flux);
      Estimate deviation{no_value, no_value};
      if (!std::isnan(flux.value)) deviation = spread.estimate(errors.spread_quantile);
      // What nothing was seen of may deviate as much as there may be of it.
      if (flux.value == 0.0) deviation.half_width = std::max(deviation.half_width, flux.half_width);
      spreads.push_back(deviation);
    };
    add_class(means.sunlit[b], means.sunlit_spread[b], result.sunlit_m2, result.absorbed_sunlit, result.sunlit_sd);
    add_class(means.shaded[b], means.shaded_spread[b], result.shaded_m2, result.absorbed_shaded, result.shaded_sd);
  }
  return result;
}

ShadeClassResult ShadeClasses::organ(std::size_t organ, double unseen_lit_m2, const Errors& errors) const {
  return all_groups_ ? result(organs_[organ], conversion_.areas.organ_open_m2[organ], unseen_lit_m2, errors)
                     : ShadeClassResult{};
}

ShadeClassResult ShadeClasses::layer(std::size_t layer, double unseen_lit_m2, const Errors& errors) const {
  return all_groups_ ? result(layers_[layer], conversion_.areas.layer_open_foliage_m2[layer], unseen_lit_m2, errors)
                     : ShadeClassResult{};
}

ShadeClassResult ShadeClasses::leaves(double unseen_lit_m2, const Errors& errors) const {
  return result(leaves_[0], conversion_.areas.open_foliage_m2, unseen_lit_m2, errors);
}

}  // namespace sunfleck
