#include "physics/transport/solve/shade_classes.h"

#include "base/prefetch.h"
#include "base/units.h"
#include "physics/transport/model/columns.h"
#include "physics/transport/model/layer_shares.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sunfleck {
namespace {

// What a side absorbs of other light than the beam in one replicate, and what of it falls on the sunlit part. [band]
struct SideLight {
  explicit SideLight(std::size_t bands)
      : absorbed_w(bands), part_w(bands), earlier_w_m2(bands), lit_earlier_w_m2(bands), twice_beam_w_m2(bands), space(bands) {}

  // Adds the share of it that belongs to a group.
  void add_to(ShadeSums& sums, double share) {
    for (std::size_t b = 0; b < part_w.size(); ++b) part_w[b] = share * absorbed_w[b];
    columns::add_scaled(1.0, part_w, sums.indirect_w);
    columns::add_products(earlier_w_m2, part_w, sums.indirect_square);
    if (!any_lit) return;
    columns::add_scaled(lit, part_w, sums.lit_indirect_w);
    columns::add_products(twice_beam_w_m2, part_w, sums.lit_square);
    columns::add_products(lit_earlier_w_m2, part_w, sums.lit_indirect_square);
  }

  double lit = 0.0;  // part of the area
  bool any_lit = false;
  std::vector<double> absorbed_w, part_w;
  std::vector<double> earlier_w_m2, lit_earlier_w_m2;  // of both sides in all earlier replicates together
  std::vector<double> twice_beam_w_m2;
  std::vector<double> space;
};

}  // namespace

void RatioMean::add(double numerator, double denominator) {
  const double from_old_mean = numerator_.count() > 0 ? numerator - numerator_.mean() : 0.0;
  numerator_.add(numerator);
  denominator_.add(denominator);
  products_ += from_old_mean * (denominator - denominator_.mean());
}

Estimate RatioMean::estimate(double t_quantile, double unseen) const {
  if (!(denominator_.mean() > t_quantile * denominator_.standard_error())) return {no_value, no_value};
  const double ratio = numerator_.mean() / denominator_.mean();
  const double squares = std::max(0.0, numerator_.squares() - 2.0 * ratio * products_ + ratio * ratio * denominator_.squares());
  const auto n = static_cast<double>(numerator_.count());
  const double half_width = squares > 0.0 ? t_quantile * std::sqrt(squares / (n - 1.0) / n) : unseen;
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
  for (const BandQuanta& quanta : conversion.quanta) w_m2_per_quantum_.push_back(quanta.w_m2_per_quantum);
  ShadeMeans means;
  for (auto* ratios : {&means.sunlit, &means.shaded}) ratios->resize(bands);
  for (auto* spreads : {&means.sunlit_spread, &means.shaded_spread}) spreads->resize(bands);
  organs_.assign(all_groups_ ? conversion.areas.organ_open_m2.size() : 0, means);
  layers_.assign(all_groups_ ? conversion.areas.layer_open_foliage_m2.size() : 0, means);
  leaves_.assign(1, means);
}

void ShadeClasses::add(const Replicate& replicate, const PlaceSums& earlier) {
  const std::size_t bands = conversion_.quanta.size();
  ShadeSums none;
  for (auto* sums : {&none.direct_w, &none.indirect_w, &none.lit_indirect_w, &none.lit_square, &none.indirect_square,
                     &none.lit_indirect_square}) {
    sums->resize(bands);
  }
  Groups groups{std::vector(organs_.size(), none), std::vector(layers_.size(), none), std::vector(1, none)};
  if (conversion_.model.has_beam()) add_beam(replicate, groups);
  if (replicate.packets) add_other_light(replicate, earlier, groups);
  const auto add_all = [&](const std::vector<ShadeSums>& sums, std::span<const double> open_m2,
                           std::vector<ShadeMeans>& means) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      means[i].lit_m2.add(sums[i].lit_m2);
      for (std::size_t b = 0; b < bands; ++b) {
        means[i].sunlit[b].add(sums[i].direct_w[b] + sums[i].lit_indirect_w[b], sums[i].lit_m2);
        means[i].shaded[b].add(sums[i].indirect_w[b] - sums[i].lit_indirect_w[b], open_m2[i] - sums[i].lit_m2);
        means[i].sunlit_spread[b].add({sums[i].lit_m2, sums[i].direct_w[b] + sums[i].lit_indirect_w[b], sums[i].lit_square[b],
                                       sums[i].lit_indirect_square[b]});
        means[i].shaded_spread[b].add({open_m2[i] - sums[i].lit_m2, sums[i].indirect_w[b] - sums[i].lit_indirect_w[b], 0.0,
                                       sums[i].indirect_square[b] - sums[i].lit_indirect_square[b]});
      }
    }
  };
  const CanopyAreas& areas = conversion_.areas;
  add_all(groups.organs, areas.organ_open_m2, organs_);
  add_all(groups.layers, areas.layer_open_foliage_m2, layers_);
  add_all(groups.leaves, {&areas.open_foliage_m2, 1}, leaves_);
}

void ShadeClasses::add_beam(const Replicate& replicate, Groups& groups) const {
  const Canopy& canopy = conversion_.model.canopy;
  for (const std::uint32_t e : replicate.direct.hit) {
    const double lit_m2_per_landing = conversion_.exposure.lit_m2_per_landing(e);
    const bool foliage = conversion_.areas.foliage[e];
    if (!all_groups_ && !foliage) continue;
    const std::size_t first = first_layer(conversion_.layout, canopy.corners[e]);
    std::size_t word = conversion_.layout.first_bin_word + 2 * std::size_t{conversion_.layout.first_bin[e]};
    for (std::size_t k = first; k < conversion_.layout.end_layer(e, first); ++k, word += 2) {
      const double upper = replicate.counters[word];
      const double lower = replicate.counters[word + 1];
      const auto add_to = [&](ShadeSums& sums) {
        sums.lit_m2 += (upper + lower) * lit_m2_per_landing;
        for (std::size_t b = 0; b < sums.direct_w.size(); ++b) {
          const double per_landing_w = conversion_.ground_per_ray_m2 * conversion_.beam_w_m2(b);
          const double upper_w = per_landing_w * conversion_.absorptance(canopy.optics_of[e], 0, b);
          const double lower_w = per_landing_w * conversion_.absorptance(canopy.optics_of[e], 1, b);
          sums.direct_w[b] += upper * upper_w + lower * lower_w;
          if (lit_m2_per_landing > 0.0) {
            sums.lit_square[b] += (upper * upper_w * upper_w + lower * lower_w * lower_w) / lit_m2_per_landing;
          }
        }
      };
      if (upper + lower == 0.0) continue;
      if (foliage) add_to(groups.leaves[0]);
      if (!all_groups_) continue;
      add_to(groups.organs[canopy.organ_of[e]]);
      if (foliage) add_to(groups.layers[k]);
    }
  }
}

void ShadeClasses::add_other_light(const Replicate& replicate, const PlaceSums& earlier, Groups& groups) const {
  const Canopy& canopy = conversion_.model.canopy;
  const std::size_t bands = conversion_.quanta.size();
  const PlaceSums::Finder earlier_sides(earlier);
  LayerShares shares(conversion_.layout);
  SideLight light(bands);
  // Most elements have no landing in a replicate.
  std::vector<bool> hit(canopy.size());
  for (const std::uint32_t e : replicate.direct.hit) hit[e] = true;
  const std::span<const Triangle> own = canopy.corners.copies().empty() ? canopy.corners.own() : std::span<const Triangle>();
  const auto come = [&](std::size_t side) {
    earlier_sides.prefetch(side & ~std::size_t{1});
    if (!own.empty()) prefetch(own[side / 2]);
  };
  const auto add_side = [&](std::size_t side, std::span<const std::int64_t> quanta) {
    const std::size_t e = side / 2;
    if (!all_groups_ && !conversion_.areas.foliage[e]) return;
    const Triangle& corners = canopy.corners[e];
    const double element_m2 = area_m2(corners);
    const double per_m2 = element_m2 > 0.0 ? 1.0 / element_m2 : 0.0;
    const BeamLandings landings = hit[e] ? conversion_.element_landings(replicate.counters, e) : BeamLandings();
    light.lit = static_cast<double>(landings.both()) * conversion_.exposure.lit_m2_per_landing(e) * per_m2;
    set_absorbed_w(side, quanta, light.absorbed_w);
    std::fill(light.earlier_w_m2.begin(), light.earlier_w_m2.end(), 0.0);
    for (const std::size_t of : {2 * e, 2 * e + 1}) {
      const auto landed = earlier_sides.at(of);
      if (landed.empty()) continue;
      set_absorbed_w(of, landed, light.space);
      for (std::size_t b = 0; b < bands; ++b) light.earlier_w_m2[b] += light.space[b] * per_m2;
    }
    light.any_lit = hit[e];
    for (std::size_t b = 0; light.any_lit && b < bands; ++b) {
      light.twice_beam_w_m2[b] = 2.0 * (absorbed_beam_w(e, landings, b) * per_m2);
      light.lit_earlier_w_m2[b] = light.lit * light.earlier_w_m2[b];
    }
    const auto add_to = [&](ShadeSums& sums, double share) { light.add_to(sums, share); };
    if (conversion_.areas.foliage[e]) add_to(groups.leaves[0], 1.0);
    if (!all_groups_) return;
    add_to(groups.organs[canopy.organ_of[e]], 1.0);
    if (!conversion_.areas.foliage[e]) return;
    shares.visit(e, corners, [&](std::size_t k, double share) { add_to(groups.layers[k], share); });
  };
  replicate.packets->side_landed.for_each(add_side, come);
}

double ShadeClasses::absorbed_beam_w(std::size_t element, const BeamLandings& landings, std::size_t band) const {
  const std::size_t optics = conversion_.model.canopy.optics_of[element];
  return conversion_.ground_per_ray_m2 * conversion_.beam_w_m2(band) *
         (static_cast<double>(landings.upper) * conversion_.absorptance(optics, 0, band) +
          static_cast<double>(landings.lower) * conversion_.absorptance(optics, 1, band));
}

void ShadeClasses::set_absorbed_w(std::size_t side, std::span<const std::int64_t> quanta, std::span<double> absorbed_w) const {
  const RadiationModel& model = conversion_.model;
  columns::scale(quanta, w_m2_per_quantum_, model.plot.area_m2(),
                 conversion_.absorptances(model.canopy.optics_of[side / 2], side % 2), absorbed_w);
}

ShadeClassResult ShadeClasses::result(const ShadeMeans& means, double open_m2, const Errors& errors) const {
  ShadeClassResult result;
  result.sunlit_m2 = means.lit_m2.estimate(errors.t_quantile, errors.unseen_events * conversion_.ground_per_ray_m2);
  // The estimate is unbiased and may leave this range by chance, although the area cannot.
  result.sunlit_m2.value = std::clamp(result.sunlit_m2.value, 0.0, open_m2);
  result.shaded_m2 = {open_m2 - result.sunlit_m2.value, result.sunlit_m2.half_width};
  for (std::size_t b = 0; b < means.sunlit.size(); ++b) {
    const auto add_class = [&](const RatioMean& ratio, const SpreadMean& spread, auto& absorbed, auto& spreads) {
      Estimate flux = ratio.estimate(errors.t_quantile, errors.unseen_events * errors.event_w[b]);
      flux.half_width += flux.value * errors.unshot_share[b];
      absorbed.push_back(flux);
      spreads.push_back(std::isnan(flux.value) ? Estimate{no_value, no_value} : spread.estimate(errors.spread_quantile));
    };
    add_class(means.sunlit[b], means.sunlit_spread[b], result.absorbed_sunlit, result.sunlit_sd);
    add_class(means.shaded[b], means.shaded_spread[b], result.absorbed_shaded, result.shaded_sd);
  }
  return result;
}

ShadeClassResult ShadeClasses::organ(std::size_t organ, const Errors& errors) const {
  return all_groups_ ? result(organs_[organ], conversion_.areas.organ_open_m2[organ], errors) : ShadeClassResult{};
}

ShadeClassResult ShadeClasses::layer(std::size_t layer, const Errors& errors) const {
  return all_groups_ ? result(layers_[layer], conversion_.areas.layer_open_foliage_m2[layer], errors) : ShadeClassResult{};
}

ShadeClassResult ShadeClasses::leaves(const Errors& errors) const {
  return result(leaves_[0], conversion_.areas.open_foliage_m2, errors);
}

}  // namespace sunfleck
