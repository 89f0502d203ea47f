#include "physics/transport/indirect/sky_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

namespace sunfleck {
namespace {

// Of `rays` rays, rays^0.65 directions are drawn: fewer would leave the sky's own spread unsampled, more would make the
// beams too small to be traced fast. Measured on two stands of 600 and 97,400 triangles with 65,536 to 200,000 rays a
// replicate, the error was the same within its own uncertainty as with exponents up to 0.9 or with all four dimensions
// jittered alike, and tracing was up to twice as fast.
constexpr double direction_exponent = 0.65;

std::size_t root_of(double count) {
  return static_cast<std::size_t>(std::max(1.0, std::round(std::sqrt(count))));
}

// Returns the numbers 0 to count - 1 in random order (Fisher and Yates).
std::vector<std::size_t> shuffled(std::size_t count, RandomStream& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t left = count; left > 1; --left) {
    const auto taken = std::min(left - 1, static_cast<std::size_t>(random.unit() * static_cast<double>(left)));
    std::swap(order[left - 1], order[taken]);
  }
  return order;
}

// Returns a random number in part `cell` of [0, 1), which is cut into `cells` equal parts.
double jittered(std::size_t cell, std::size_t cells, RandomStream& random) {
  return (static_cast<double>(cell) + random.unit()) / static_cast<double>(cells);
}

// The numbers of the lights that have a sky.
std::vector<std::size_t> lights_with_sky(Lights lights) {
  std::vector<std::size_t> lit;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    if (lights[k].has_sky()) lit.push_back(k);
  }
  return lit;
}

std::vector<Sky> skies_of(Lights lights) {
  std::vector<Sky> skies;
  for (const std::size_t k : lights_with_sky(lights)) skies.emplace_back(*lights[k].sky, lights[k].sun);
  return skies;
}

}  // namespace

SkyRays::SkyRays(Lights lights, const CounterLayout& layout, const StandAim* aim)
    : SkyRays(lights, layout, aim, skies_of(lights)) {}

SkyRays::SkyRays(Lights lights, const CounterLayout& layout, const StandAim* aim, const std::vector<Sky>& skies)
    : sky_(skies.size() == 1 ? skies.front() : Sky::mean_of(skies)),
      most_weight_(lights.size(), 1.0),
      periodic_(lights.front().plot.periodic),
      period_m_(lights.front().canopy.period_m),
      top_y_m_(layout.box.above_m()),
      centre_m_(0.5 * (layout.box.lo_m + layout.box.hi_m)),
      ground_m2_(lights.size()) {
  glm::dvec3 size_m = layout.box.hi_m - layout.box.lo_m;
  size_m.y = layout.box.seen_y_m - layout.box.lo_m.y;
  centre_m_.y = layout.box.lo_m.y + 0.5 * size_m.y;
  // The radius is enlarged by 2^-16, so that rounding to single precision leaves nothing outside.
  radius_m_ = 0.5 * glm::length(size_m) * (1.0 + 0x1p-16);
  if (aim != nullptr) {
    centre_m_ = aim->centre_m;
    radius_m_ = aim->reach_m;
    inner_share_ = aim->radius_m * aim->radius_m / (radius_m_ * radius_m_);
  }
  const std::vector<std::size_t> lit = lights_with_sky(lights);
  for (std::size_t k = 0; k < lit.size(); ++k) {
    ground_m2_[lit[k]] =
        periodic_ ? period_m_.x * period_m_.y : skies[k].spherical_irradiance() * std::numbers::pi * radius_m_ * radius_m_;
  }
  if (!sky_.is_list()) weigh(skies, lit, lights.size());
}

void SkyRays::weigh(std::span<const Sky> skies, const std::vector<std::size_t>& lit, std::size_t lights) {
  const auto same = [&](const Sky& sky) {
    for (std::size_t cell = 0; cell < std::size_t{Sky::rows} * Sky::columns; ++cell) {
      if (sky.radiance_of_cell(cell) != skies.front().radiance_of_cell(cell)) return false;
    }
    return true;
  };
  if (std::all_of(skies.begin() + 1, skies.end(), same)) return;
  weights_.resize(std::size_t{Sky::rows} * Sky::columns * lights);
  for (std::size_t k = 0; k < lit.size(); ++k) {
    const double mean_weight = periodic_ ? 1.0 : skies[k].spherical_irradiance() / sky_.spherical_irradiance();
    for (std::size_t cell = 0; cell < std::size_t{Sky::rows} * Sky::columns; ++cell) {
      const double mean = sky_.radiance_of_cell(cell);
      const double weight = mean > 0.0 ? skies[k].radiance_of_cell(cell) / mean : 0.0;
      weights_[cell * lights + lit[k]] = static_cast<float>(weight);
      most_weight_[lit[k]] = std::max(most_weight_[lit[k]], weight / mean_weight);
    }
  }
}

std::span<const float> SkyRays::weights(const glm::vec3& direction) const {
  const std::size_t lights = most_weight_.size();
  return std::span(weights_).subspan(Sky::cell_of(-glm::dvec3(direction)) * lights, lights);
}

glm::dvec3 SkyRays::origin_above(double u, double v) const {
  return {u * period_m_.x, top_y_m_, v * period_m_.y};
}

glm::dvec3 SkyRays::origin_around(const glm::dvec3& to_sky, double u, double v) const {
  const glm::dvec3 level = std::abs(to_sky.x) < std::abs(to_sky.z) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 across = glm::normalize(glm::cross(to_sky, level));
  const double radius_m = radius_m_ * std::sqrt(u);
  const double angle = 2.0 * std::numbers::pi * v;
  return centre_m_ + radius_m_ * to_sky + radius_m * (std::cos(angle) * across + std::sin(angle) * glm::cross(to_sky, across));
}

std::vector<shared::Packet> SkyRays::draw(std::size_t count, RandomStream& random) const {
  const auto wanted = static_cast<double>(count);
  const std::size_t directions = root_of(std::pow(wanted, direction_exponent));
  const std::size_t rings = aimed() ? 2 : 1;
  const std::size_t origins = root_of(wanted / static_cast<double>(rings * directions * directions));
  const std::vector<std::size_t> parts = shuffled(directions * directions, random);
  std::vector<shared::Packet> rays, ring;
  rays.reserve(rings * directions * directions * origins * origins);
  for (std::size_t k = 0; k < directions * directions; ++k) {
    const double along_u = jittered(k % directions, directions, random);
    const double along_v = jittered(k / directions, directions, random);
    const glm::dvec3 to_sky =
        periodic_ ? sky_.draw_by_horizontal_irradiance(along_u, along_v) : sky_.draw_by_radiance(along_u, along_v);
    for (std::size_t ray = 0; ray < rings * origins * origins; ++ray) {
      const std::size_t cell = ray % (origins * origins);
      double u = jittered(cell % origins * directions + parts[k] % directions, origins * directions, random);
      const double v = jittered(cell / origins * directions + parts[k] / directions, origins * directions, random);
      const bool inner = ray == cell;
      if (aimed()) u = inner ? u * inner_share_ : inner_share_ + u * (1.0 - inner_share_);
      const shared::Packet packet{periodic_ ? origin_above(u, v) : origin_around(to_sky, u, v), shared::no_element, -to_sky, 0};
      (inner ? rays : ring).push_back(packet);
    }
  }
  rays.insert(rays.end(), ring.begin(), ring.end());
  return rays;
}

double SkyRays::share_of_first(std::size_t k, std::size_t rays) const {
  const double part = static_cast<double>(k) / static_cast<double>(rays);
  if (!aimed()) return part;
  return part <= 0.5 ? 2.0 * part * inner_share_ : inner_share_ + (2.0 * part - 1.0) * (1.0 - inner_share_);
}

SkyShares::SkyShares(const SkyRays& sky, std::span<const shared::Packet> rays) : sky_(sky), rays_(rays), shares_(sky.lights()) {
  if (sky.alike()) return;
  totals_.resize(sky.lights());
  sums_.resize(sky.lights());
  for (std::size_t r = 0; r < rays.size(); ++r) add(r, totals_);
}

std::span<const double> SkyShares::next() {
  const std::size_t ray = taken_++;
  if (sky_.alike()) {
    std::fill(shares_.begin(), shares_.end(), sky_.share_of_first(ray + 1, rays_.size()));
    return shares_;
  }
  add(ray, sums_);
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    shares_[k] = totals_[k] > 0.0 && taken_ < rays_.size() ? std::min(1.0, sums_[k] / totals_[k]) : 1.0;
  }
  return shares_;
}

void SkyShares::add(std::size_t ray, std::vector<double>& sums) {
  const double share = sky_.share_of_first(ray + 1, rays_.size()) - sky_.share_of_first(ray, rays_.size());
  if (ray == 0 || rays_[ray].direction != rays_[ray - 1].direction) weights_ = sky_.weights(rays_[ray].direction);
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += share * double{weights_[k]};
}

double SkyRays::largest_weight(std::size_t light) const {
  return most_weight_[light] * (aimed() ? 2.0 * std::max(inner_share_, 1.0 - inner_share_) : 1.0);
}

}  // namespace sunfleck
