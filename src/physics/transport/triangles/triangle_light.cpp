#include "physics/transport/triangles/triangle_light.h"

#include "physics/light/sun.h"
#include "physics/transport/triangles/beam_shares.h"
#include "physics/transport/triangles/pooling.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace sunfleck {
namespace {

constexpr std::size_t tree_count = 4;

// Calls give(k, part) for each number k below `count`, with whole numbers in proportion to value(k) whose sum is `total`, which
// is at least 0; values of which none is positive count as equal.
template <class Value, class Give>
void apportion(std::size_t count, std::int64_t total, const Value& value, const Give& give) {
  double sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) sum += std::max(0.0, value(k));
  const bool equal = !(sum > 0.0);
  if (equal) sum = static_cast<double>(count);
  double passed = 0.0;
  std::int64_t given = 0;
  for (std::size_t k = 0; k < count; ++k) {
    passed += equal ? 1.0 : std::max(0.0, value(k));
    const bool last = k + 1 == count;
    // A large total may be rounded up when it becomes a double.
    const auto share = static_cast<std::int64_t>(static_cast<double>(total) * std::min(1.0, passed / sum));
    const std::int64_t until = last ? total : std::min(total, share);
    give(k, until - given);
    given = until;
  }
}

std::vector<double> areas_within_reach_m2(const RadiationModel& model, const CounterLayout& layout) {
  const std::vector<bool> hidden = hidden_elements(model, layout);
  std::vector<double> areas;
  areas.reserve(hidden.size());
  for (std::size_t e = 0; e < hidden.size(); ++e) areas.push_back(hidden[e] ? 0.0 : area_m2(model.canopy.corners[e]));
  return areas;
}

class Estimation {
 public:
  // `shades` may be null; there are none without a beam.
  Estimation(const TriangleScene& scene, const TriangleSums& sums, const std::vector<double>& areas_m2,
             const std::vector<SurfaceTree>& trees, const std::vector<ElementShade>* shades)
      : scene_(scene), sums_(sums), elements_(scene.model.canopy.size()), areas_m2_(areas_m2), trees_(trees), shades_(shades) {}

  [[nodiscard]] TriangleLight run() {
    if (scene_.model.has_beam()) estimate_beam();
    if (!sums_.indirect.empty()) estimate_indirect();
    return std::move(light_);
  }

 private:
  // Replaces the sums over each surface by the same sums, divided in proportion to `values`. `at` is the index of an element.
  template <class At>
  void divide(const std::vector<double>& values, std::int64_t unit, std::span<const std::int64_t> landed, const At& at,
              std::vector<std::int64_t>& result) const {
    const std::vector<TreeRange>& surfaces = trees_.front().surfaces;
    tbb::parallel_for(std::size_t{0}, surfaces.size(), [&](std::size_t s) {
      const auto element = [&](std::size_t k) { return trees_.front().order[surfaces[s].begin + k]; };
      std::int64_t total = 0;
      for (std::size_t k = 0; k < surfaces[s].size(); ++k) total += landed[at(element(k))] * unit;
      apportion(
          surfaces[s].size(), total, [&](std::size_t k) { return values[element(k)]; },
          [&](std::size_t k, std::int64_t part) { result[at(element(k))] = part; });
    });
  }

  void estimate_indirect() {
    const std::size_t bands = scene_.model.bands.size();
    light_.side_indirect.resize(sums_.indirect.size());
    light_.side_sky.resize(sums_.sky.size());
    light_.indirect_variance.resize(sums_.indirect.size());
    std::vector<std::int64_t> scattered(sums_.indirect.begin(), sums_.indirect.end());
    std::vector<std::int64_t> half_scattered(sums_.half_indirect.begin(), sums_.half_indirect.end());
    for (std::size_t k = 0; k < sums_.sky.size(); ++k) {
      scattered[k] -= sums_.sky[k];
      half_scattered[k] -= sums_.half_sky[k];
    }
    const Pooling pooling(trees_, areas_m2_);
    for (std::size_t part = 0; part < 2 * bands; ++part) {
      const std::size_t side = part / bands, band = part % bands;
      const auto at = [side, band, bands](std::size_t e) { return (2 * e + side) * bands + band; };
      const double noise = sums_.other_noise[band];
      pool_part(pooling, scattered, half_scattered, at, noise, light_.side_indirect);
      if (sums_.sky.empty()) continue;
      pool_part(pooling, sums_.sky, sums_.half_sky, at, noise, light_.side_sky);
      for (std::size_t e = 0; e < elements_; ++e) light_.side_indirect[at(e)] += light_.side_sky[at(e)];
    }
  }

  template <class At>
  void pool_part(const Pooling& pooling, std::span<const std::int64_t> all, std::span<const std::int64_t> half, const At& at,
                 double noise, std::vector<std::int64_t>& result) {
    std::vector<double> a(elements_), b(elements_);
    for (std::size_t e = 0; e < elements_; ++e) {
      a[e] = static_cast<double>(half[at(e)]);
      b[e] = static_cast<double>(all[at(e)] - half[at(e)]);
      result[at(e)] = all[at(e)];
    }
    const PooledLight pooled = pooling.pool(a, b, noise);
    for (std::size_t e = 0; e < elements_; ++e) light_.indirect_variance[at(e)] += pooled.variance[e];
    divide(pooled.flux, 1, all, at, result);
  }

  void estimate_beam() {
    const BeamShares shares(scene_.exposure, sums_, areas_m2_);
    BeamLight beam = shades_ != nullptr ? shares.join(*shades_) : pooled_landings(shares);
    std::vector<std::int64_t> landed(2 * elements_);
    for (std::size_t e = 0; e < elements_; ++e) {
      landed[2 * e] = static_cast<std::int64_t>(sums_.landings[e].upper);
      landed[2 * e + 1] = static_cast<std::int64_t>(sums_.landings[e].lower);
    }
    light_.side_direct.resize(landed.size());
    for (std::size_t k = 0; k < landed.size(); ++k) light_.side_direct[k] = landed[k] * RadiationResult::parts_per_landing;
    const glm::dvec3 to_sun = direction_to_sun(*scene_.model.sun);
    std::array<std::vector<double>, 2> expected{std::vector<double>(elements_), std::vector<double>(elements_)};  // [side]
    for (std::size_t e = 0; e < elements_; ++e) {
      const bool upper = glm::dot(unit_normal(scene_.model.canopy.corners[e]), to_sun) > 0.0;
      expected[upper ? 0 : 1][e] = beam.landings[e];
    }
    for (std::size_t side = 0; side < 2; ++side) {
      divide(
          expected[side], RadiationResult::parts_per_landing, landed, [side](std::size_t e) { return 2 * e + side; },
          light_.side_direct);
    }
    light_.direct_variance = std::move(beam.variance);
    if (shades_ != nullptr) add_variance_of_totals(expected, landed);  // pooled landings have it
  }

  // What landed on one side of a surface.
  struct SideTotal {
    TreeRange surface;
    std::size_t side = 0;
    std::uint32_t organ = 0;
    double expected = 0.0, variance = 0.0;  // of the expected landings
    double landings = 0.0;                  // expected or seen, whichever is more
  };

  // `expected` is [side][element], `landed` is [2 * element + side].
  [[nodiscard]] std::vector<SideTotal> side_totals(const std::array<std::vector<double>, 2>& expected,
                                                   const std::vector<std::int64_t>& landed) const {
    const SurfaceTree& tree = trees_.front();
    std::vector<SideTotal> totals;
    for (const TreeRange& surface : tree.surfaces) {
      for (std::size_t side = 0; side < 2; ++side) {
        SideTotal& total = totals.emplace_back(SideTotal{surface, side, scene_.surfaces.at(tree.order[surface.begin]).organ});
        for (std::uint32_t k = surface.begin; k < surface.end; ++k) {
          const std::uint32_t e = tree.order[k];
          total.expected += expected[side][e];
          if (expected[side][e] > 0.0) total.variance += light_.direct_variance[e];
          total.landings += static_cast<double>(landed[2 * e + side]);
        }
        total.landings = std::max(total.landings, total.expected);
      }
    }
    return totals;
  }

  // Turns variances of expected landings into those of the landings that divide() gives: an element gets its share of what
  // landed on its side of the surface, which varies from run to run, too. The variance of an organ's landings belongs to its
  // sides in proportion to their landings.
  void add_variance_of_totals(const std::array<std::vector<double>, 2>& expected, const std::vector<std::int64_t>& landed) {
    const std::vector<SideTotal> totals = side_totals(expected, landed);
    std::vector<double> organ_landings(sums_.organ_landings_variance.size());
    for (const SideTotal& total : totals) organ_landings[total.organ] += total.landings;
    for (const SideTotal& total : totals) {
      if (!(total.expected > 0.0)) continue;
      const double of_total = sums_.organ_landings_variance[total.organ] * total.landings / organ_landings[total.organ];
      for (std::uint32_t k = total.surface.begin; k < total.surface.end; ++k) {
        const std::uint32_t e = trees_.front().order[k];
        if (!(expected[total.side][e] > 0.0)) continue;
        const double share = expected[total.side][e] / total.expected;
        double& variance = light_.direct_variance[e];
        const double of_others = std::max(0.0, total.variance - variance);
        variance = (1.0 - share) * (1.0 - share) * variance + share * share * (of_others + of_total);
      }
    }
  }

  [[nodiscard]] BeamLight pooled_landings(const BeamShares& shares) const {
    std::vector<double> weights(elements_), a(elements_), b(elements_);
    for (std::size_t e = 0; e < elements_; ++e) {
      weights[e] = shares.landings_in_sun(e, 1);
      a[e] = static_cast<double>(sums_.half_landings[e].both());
      b[e] = static_cast<double>(sums_.landings[e].both()) - a[e];
    }
    const auto sum = [](const auto& values) { return std::accumulate(values.begin(), values.end(), 0.0); };
    const double variance = sum(sums_.organ_landings_variance), landings = sum(a) + sum(b);
    PooledLight pooled = Pooling(trees_, weights).pool(a, b, variance / std::max(1.0, landings));
    return {std::move(pooled.flux), std::move(pooled.variance)};
  }

  const TriangleScene& scene_;
  const TriangleSums& sums_;
  std::size_t elements_;
  const std::vector<double>& areas_m2_;
  const std::vector<SurfaceTree>& trees_;
  const std::vector<ElementShade>* shades_;
  TriangleLight light_;
};

}  // namespace

TriangleNeighbours::TriangleNeighbours(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces)
    : areas_m2(areas_within_reach_m2(model, layout)), trees(tree_count) {
  tbb::parallel_for(std::size_t{0}, tree_count,
                    [&](std::size_t t) { trees[t] = make_surface_tree(model.canopy, surfaces.number_of, areas_m2, t); });
}

TriangleLight TriangleEstimator::estimate(const TriangleScene& scene, const TriangleSums& sums, const StopQuestion& stop) {
  if (!shades_ && scene.model.has_beam()) {
    shades_ = ask_shadow_points(scene.model, scene.layout, scene.exposure, neighbours_.trees.front(), tracer_, seed_, stop);
  }
  std::optional<std::vector<ElementShade>> shades = shades_;
  if (shades) {
    const std::vector<std::uint32_t> doubted = BeamShares(scene.exposure, sums, neighbours_.areas_m2).doubted(*shades);
    if (!ask_doubted(scene.model, scene.layout, doubted, tracer_, seed_, stop, *shades)) shades.reset();
  }
  return Estimation(scene, sums, neighbours_.areas_m2, neighbours_.trees, shades ? &*shades : nullptr).run();
}

TriangleErrors triangle_errors(const TriangleScene& scene, const TriangleLight& light, double confidence) {
  const double quantile = normal_quantile(confidence);
  const RadiationModel& model = scene.model;
  const std::size_t bands = light.side_indirect.size() / std::max<std::size_t>(1, 2 * model.canopy.size());
  TriangleErrors errors;
  errors.indirect.resize(bands);
  // `places` and `variances` return the indices of an element's values.
  const auto typical = [&](std::span<const std::int64_t> flux, std::span<const double> variance, double unit,
                           const auto& places, const auto& variances) {
    double squares = 0.0, sum = 0.0, area = 0.0;
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const double element_m2 = area_m2(model.canopy.corners[e]);
      if (!is_vegetation(scene.surfaces.at(e).role) || !(element_m2 > 0.0)) continue;
      for (const std::size_t place : places(e)) sum += static_cast<double>(flux[place]) / unit;
      for (const std::size_t place : variances(e)) squares += variance[place] / element_m2;
      area += element_m2;
    }
    return sum > 0.0 ? quantile * std::sqrt(squares * area) / sum : 0.0;
  };
  if (!light.side_direct.empty()) {
    errors.direct = typical(
        light.side_direct, light.direct_variance, RadiationResult::parts_per_landing,
        [](std::size_t e) {
          return std::array{2 * e, 2 * e + 1};
        },
        [](std::size_t e) { return std::array{e}; });
  }
  for (std::size_t b = 0; b < bands; ++b) {
    const auto sides = [&](std::size_t e) { return std::array{2 * e * bands + b, (2 * e + 1) * bands + b}; };
    errors.indirect[b] = typical(light.side_indirect, light.indirect_variance, 1.0, sides, sides);
  }
  return errors;
}

void set_triangle_light(const TriangleScene& scene, TriangleLight light, std::span<const double> unshot_shares,
                        double confidence, RadiationResult& result) {
  const RadiationModel& model = scene.model;
  const std::size_t elements = model.canopy.size();
  const std::size_t bands = model.bands.size();
  const double quantile = normal_quantile(confidence);
  result.side_direct = std::move(light.side_direct);
  if (!light.side_indirect.empty()) result.side_indirect = std::move(light.side_indirect);
  if (!light.side_sky.empty()) result.side_sky = std::move(light.side_sky);
  result.element_error.assign(elements * bands, 0.0);
  result.side_error.assign(2 * elements * bands, 0.0);
  result.triangle_relative_error.clear();
  const glm::dvec3 to_sun = model.has_beam() ? direction_to_sun(*model.sun) : glm::dvec3(0.0, 1.0, 0.0);
  std::vector<double> squares(bands), flux(bands);
  double area = 0.0;
  for (std::size_t e = 0; e < elements; ++e) {
    const double element_m2 = area_m2(model.canopy.corners[e]);
    if (!(element_m2 > 0.0)) continue;
    const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
    const bool upper = glm::dot(unit_normal(model.canopy.corners[e]), to_sun) > 0.0;
    const bool vegetation = is_vegetation(scene.surfaces.at(e).role);
    if (vegetation) area += element_m2;
    for (std::size_t b = 0; b < bands; ++b) {
      double absorbed = 0.0, variance = 0.0, unshot = 0.0;
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t place = (2 * e + side) * bands + b;
        double incident = result.side_indirect_w_m2(2 * e + side, element_m2, b);
        const double unshot_of_side = incident * unshot_shares[b];
        double of_side = 0.0;
        if (!light.indirect_variance.empty()) {
          const double per_quantum = result.w_per_quantum[b] / element_m2;
          of_side = light.indirect_variance[place] * per_quantum * per_quantum;
        }
        if (!result.side_direct.empty()) {
          const double per_landing = result.irradiance_w_m2(1, element_m2, model.bands[b].direct_w_m2);
          incident += result.side_direct_w_m2(2 * e + side, element_m2, model.bands[b].direct_w_m2);
          if (upper == (side == 0)) of_side += light.direct_variance[e] * per_landing * per_landing;
        }
        const double absorptance = (side == 0 ? optics.upper : optics.lower)[b].absorptance();
        absorbed += incident * absorptance;
        variance += of_side * absorptance * absorptance;
        unshot += unshot_of_side * absorptance;
        result.side_error[place] = quantile * std::sqrt(of_side) + unshot_of_side;
      }
      const double error = quantile * std::sqrt(variance) + unshot;
      result.element_error[b * elements + e] = error;
      if (!vegetation) continue;
      squares[b] += error * error * element_m2;
      flux[b] += absorbed * element_m2;
    }
  }
  for (std::size_t b = 0; b < bands; ++b) {
    result.triangle_relative_error.push_back(flux[b] > 0.0 ? std::sqrt(squares[b] * area) / flux[b] : 0.0);
  }
}

}  // namespace sunfleck
