#include "physics/transport/triangles/beam_shares.h"

#include <algorithm>
#include <array>

namespace sunfleck {
namespace {

// The least variance of the sunlit share of each kind of shade. The beam's landings show the variances themselves, but the fewer
// landings there are, the less exactly. For mixed elements the least variance is a quarter of that which remains when the share
// is sampled by as many points of an additive sequence.
constexpr std::array<double, shade_kinds> least_variance = {0.0, 1e-6, 1e-5, 1e-5, 1e-4, 3e-4, 3e-4, 3e-4};

}  // namespace

double BeamShares::landings_in_sun(std::size_t element, std::size_t replicates) const {
  const double lit_m2 = exposure_.lit_m2_per_landing(element);
  return lit_m2 > 0.0 ? areas_m2_[element] / lit_m2 * static_cast<double>(replicates) : 0.0;
}

std::vector<std::uint32_t> BeamShares::doubted(std::span<const ElementShade> shades) const {
  std::vector<std::uint32_t> elements;
  for (std::uint32_t e = 0; e < shades.size(); ++e) {
    const bool dark = shades[e].kind == ShadeKind::inner_shade || shades[e].kind == ShadeKind::edge_shade;
    if (dark && sums_.landings[e].both() > 0) elements.push_back(e);
  }
  return elements;
}

BeamLight BeamShares::join(std::span<const ElementShade> shades) const {
  const double spread = landing_spread(shades);
  const std::vector<double> of_points = point_variance(shades, spread);
  BeamLight light{std::vector<double>(shades.size()), std::vector<double>(shades.size())};
  for (std::size_t e = 0; e < shades.size(); ++e) {
    const ElementShade& shade = shades[e];
    if (shade.kind == ShadeKind::unasked) continue;
    const double in_sun = landings_in_sun(e, sums_.replicates);
    const double of_point = of_points[static_cast<std::size_t>(shade.kind)];
    const double seen_at_least = 0.5 / (shade.points + 1.0);
    const double of_landings = spread * std::max<double>(shade.share, seen_at_least) / in_sun;
    const double weight = of_landings / (of_landings + of_point);
    light.landings[e] = in_sun * (weight * shade.share + (1.0 - weight) * seen_share(e));
    light.variance[e] = in_sun * in_sun * weight * of_point;
  }
  return light;
}

double BeamShares::seen_share(std::size_t element) const {
  return static_cast<double>(sums_.landings[element].both()) / landings_in_sun(element, sums_.replicates);
}

// Returns the variance of an element's share from landings, times the landings expected in full sun, relative to the share:
// 1 for rays without any order, less for a grid.
double BeamShares::landing_spread(std::span<const ElementShade> shades) const {
  double squares = 0.0, expected = 0.0;
  const std::size_t others = sums_.replicates - sums_.half_replicates;
  for (std::size_t e = 0; e < shades.size(); ++e) {
    if (shades[e].kind == ShadeKind::unasked || !(shades[e].share > 0.0F)) continue;
    const auto in_half = static_cast<double>(sums_.half_landings[e].both());
    const double in_others = static_cast<double>(sums_.landings[e].both()) - in_half;
    const double half = landings_in_sun(e, sums_.half_replicates);
    const double other = landings_in_sun(e, others);
    const double difference = in_half / half - in_others / other;
    // Weighted by the landings, so that elements with few of them do not rule.
    squares += difference * difference / (1.0 / half + 1.0 / other);
    expected += shades[e].share;
  }
  return expected > 0.0 ? squares / expected : 1.0;
}

// Returns the variance of shares from points, [kind of shade]. The noise of the landings is part of their difference from the
// points.
std::vector<double> BeamShares::point_variance(std::span<const ElementShade> shades, double spread) const {
  std::vector<double> squares(shade_kinds), weights(shade_kinds);
  for (std::size_t e = 0; e < shades.size(); ++e) {
    const auto kind = static_cast<std::size_t>(shades[e].kind);
    if (shades[e].kind == ShadeKind::unasked) continue;
    const double weight = landings_in_sun(e, sums_.replicates);
    const double seen = seen_share(e);
    const double difference = shades[e].share - seen;
    squares[kind] += weight * (difference * difference - spread * seen / weight);
    weights[kind] += weight;
  }
  for (std::size_t k = 0; k < shade_kinds; ++k) {
    squares[k] = std::max(least_variance[k], weights[k] > 0.0 ? squares[k] / weights[k] : 0.0);
  }
  // Elements are doubted because the beam landed on them, so that their landings say nothing about their points, which are as
  // many as those of mixed elements.
  squares[static_cast<std::size_t>(ShadeKind::doubted)] = squares[static_cast<std::size_t>(ShadeKind::mixed)];
  return squares;
}

}  // namespace sunfleck
