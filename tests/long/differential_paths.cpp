#include "long/differential_paths.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace sunfleck::test::differential {
namespace {

constexpr double pi = std::numbers::pi;
const glm::dvec3 upwards(0.0, 1.0, 0.0);

// A path that has less than this share of its initial weight may be ended by chance.
constexpr double roulette_from = 0.1;

// Returns the mean over the bands of the weight relative to its scale.
double importance(const std::vector<double>& weights, const std::vector<double>& scale) {
  double sum = 0.0;
  double bands = 0.0;
  for (std::size_t b = 0; b < weights.size(); ++b) {
    if (!(scale[b] > 0.0)) continue;
    sum += weights[b] / scale[b];
    bands += 1.0;
  }
  return bands > 0.0 ? sum / bands : 0.0;
}

void multiply(std::vector<double>& weights, double factor) {
  for (double& weight : weights) weight *= factor;
}

// Chooses one of two paths with odds equal to their importance, and preserves the mean. Returns false if neither carries
// anything.
bool choose(std::vector<double>& first, std::vector<double>& second, const std::vector<double>& scale, Dice& dice,
            bool& takes_first) {
  const double a = importance(first, scale);
  const double b = importance(second, scale);
  if (!(a + b > 0.0)) return false;
  const double odds = a / (a + b);
  takes_first = dice.unit() < odds;
  multiply(takes_first ? first : second, 1.0 / (takes_first ? odds : 1.0 - odds));
  return true;
}

// Returns false if the path ends here.
bool survives(std::vector<double>& weights, const std::vector<double>& scale, Dice& dice) {
  const double left = importance(weights, scale);
  if (left >= roulette_from) return true;
  const double chance = left / roulette_from;
  if (dice.unit() >= chance) return false;
  multiply(weights, 1.0 / chance);
  return true;
}

std::vector<double> weighted(const std::vector<double>& weights, const std::vector<FaceOptics>& face,
                             double FaceOptics::*coefficient) {
  std::vector<double> result(weights.size());
  for (std::size_t b = 0; b < weights.size(); ++b) result[b] = weights[b] * face[b].*coefficient;
  return result;
}

}  // namespace

Paths::Leaving Paths::scatter(const Landing& landing, std::vector<double>& weights, const std::vector<double>& scale,
                              Dice& dice) const {
  if (landing.on == Landing::On::soil_plane) {
    for (std::size_t b = 0; b < weights.size(); ++b) weights[b] *= model_.soil->reflectance[b];
    if (!survives(weights, scale, dice)) return {};
    return {{world_.start(landing.point_m, upwards), cosine_direction(upwards, dice)}, true};
  }
  const SurfaceOptics& optics = model_.optics[model_.canopy.optics_of[landing.element]];
  const std::vector<FaceOptics>& face = landing.side == 0 ? optics.upper : optics.lower;
  std::vector<double> reflected = weighted(weights, face, &FaceOptics::reflectance);
  std::vector<double> transmitted = weighted(weights, face, &FaceOptics::transmittance);
  bool reflects = false;
  if (!choose(reflected, transmitted, scale, dice, reflects)) return {};
  weights = std::move(reflects ? reflected : transmitted);
  if (!survives(weights, scale, dice)) return {};
  const bool to_upper = (landing.side == 0) == reflects;
  const glm::dvec3 normal = world_.normal(landing.element) * (to_upper ? 1.0 : -1.0);
  return {{world_.start(landing.point_m, normal), cosine_direction(normal, dice)}, true};
}

// `first` is the first landing of the light, if it is known.
void Paths::follow(Ray ray, Height from, std::vector<double> flux_w, Carried carried, Dice& dice, Tally& tally,
                   const Landing* first) const {
  const std::vector<double> scale = flux_w;
  Landing landing = first != nullptr ? *first : world_.follow(ray.origin_m, ray.direction);
  while (true) {
    tally.add(ray, from, landing, flux_w, carried);
    if (landing.on != Landing::On::element && landing.on != Landing::On::soil_plane) return;
    const Leaving leaving = scatter(landing, flux_w, scale, dice);
    if (!leaving.any) return;
    ray = leaving.ray;
    from = tally.height_of(landing);
    carried = Carried::sent;
    landing = world_.follow(ray.origin_m, ray.direction);
  }
}

void Paths::follow_light(std::size_t cells, Dice& dice, Tally& tally) const {
  const auto count = static_cast<double>(cells * cells);
  const auto flux_of = [&](double Waveband::*irradiance, double ground_m2) {
    std::vector<double> flux_w;
    for (const Waveband& band : model_.bands) flux_w.push_back(band.*irradiance * ground_m2);
    return flux_w;
  };
  if (light_.has_beam()) {
    const double ground_m2 = light_.beam_ground_m2() / count;
    const std::vector<double> flux_w = flux_of(&Waveband::direct_w_m2, ground_m2);
    for (const Ray& ray : light_.beam_rays(cells, dice)) {
      const Landing landing = world_.follow(ray.origin_m, ray.direction);
      tally.add_sunlight(ray, landing, ground_m2);
      follow(ray, tally.above_all(), flux_w, Carried::beam, dice, tally, &landing);
    }
  }
  if (light_.has_sky()) {
    const std::vector<double> flux_w = flux_of(&Waveband::diffuse_w_m2, light_.sky_ground_m2() / count);
    for (const Ray& ray : light_.sky_rays(cells, dice)) {
      follow(ray, tally.above_all(), flux_w, Carried::sky, dice, tally, nullptr);
    }
  }
  for (std::size_t k = 0; k < cells * cells && light_.has_lamps(); ++k) {
    const Emitted emitted = light_.emitted(cells * cells, dice);
    const Height from = tally.height_of_lamp(emitted.element, emitted.ray.origin_m);
    follow(emitted.ray, from, emitted.flux_w, Carried::sent, dice, tally, nullptr);
  }
}

bool Paths::is_free(const glm::dvec3& from_m, const glm::dvec3& to_light) const {
  return world_.follow(from_m, to_light).on == Landing::On::sky;
}

std::vector<double> Paths::lights_on(const glm::dvec3& start_m, const glm::dvec3& normal) const {
  std::vector<double> irradiance_w_m2(model_.bands.size());
  const auto add = [&](const glm::dvec3& to_light, double per_level, double Waveband::*level_w_m2) {
    const double cosine = glm::dot(normal, to_light);
    if (cosine <= 0.0 || !is_free(start_m, to_light)) return;
    for (std::size_t b = 0; b < irradiance_w_m2.size(); ++b) {
      irradiance_w_m2[b] += model_.bands[b].*level_w_m2 * per_level * cosine / to_light.y;
    }
  };
  if (light_.has_beam()) add(light_.to_sun(), 1.0, &Waveband::direct_w_m2);
  for (const SkyLight& one : light_.sky_lights()) add(one.to_sky, one.weight, &Waveband::diffuse_w_m2);
  return irradiance_w_m2;
}

// Light that leaves the side that was seen was reflected there, or was transmitted from the other side.
Paths::Arrived Paths::arrive(const Landing& landing, std::vector<double>& weights, Dice& dice) const {
  const std::vector<double> scale(weights.size(), 1.0);
  if (landing.on == Landing::On::soil_plane) {
    for (std::size_t b = 0; b < weights.size(); ++b) weights[b] *= model_.soil->reflectance[b];
    if (!survives(weights, scale, dice)) return {};
    return {world_.start(landing.point_m, upwards), upwards, true};
  }
  const SurfaceOptics& optics = model_.optics[model_.canopy.optics_of[landing.element]];
  const bool sees_upper = landing.side == 0;
  std::vector<double> reflected = weighted(weights, sees_upper ? optics.upper : optics.lower, &FaceOptics::reflectance);
  std::vector<double> transmitted = weighted(weights, sees_upper ? optics.lower : optics.upper, &FaceOptics::transmittance);
  bool reflects = false;
  if (!choose(reflected, transmitted, scale, dice, reflects)) return {};
  weights = std::move(reflects ? reflected : transmitted);
  if (!survives(weights, scale, dice)) return {};
  const glm::dvec3 normal = world_.normal(landing.element) * (sees_upper == reflects ? 1.0 : -1.0);
  return {world_.start(landing.point_m, normal), normal, true};
}

// Follows one path; `weight` converts the radiance that it meets to the sensor's reading.
void Paths::look_back(Ray ray, double weight, Dice& dice, Reading& reading) const {
  const std::size_t bands = model_.bands.size();
  std::vector<double> weights(bands, 1.0);
  for (bool first = true;; first = false) {
    const Landing landing = world_.follow(ray.origin_m, ray.direction);
    if (landing.on == Landing::On::sky) {
      std::vector<double>& seen = first ? reading.sky : reading.scattered;
      const double radiance = light_.radiance(ray.direction);
      for (std::size_t b = 0; b < bands; ++b) seen[b] += weight * weights[b] * radiance * model_.bands[b].diffuse_w_m2;
      return;
    }
    if (landing.on != Landing::On::element && landing.on != Landing::On::soil_plane) return;
    if (landing.on == Landing::On::element && landing.side == 0) {
      const std::vector<double>& emission = model_.optics[model_.canopy.optics_of[landing.element]].emission_w_m2;
      for (std::size_t b = 0; b < emission.size(); ++b) reading.scattered[b] += weight * weights[b] * emission[b] / pi;
    }
    const Arrived arrived = arrive(landing, weights, dice);
    if (!arrived.any) return;
    const std::vector<double> irradiance_w_m2 = lights_on(arrived.start_m, arrived.normal);
    for (std::size_t b = 0; b < bands; ++b) reading.scattered[b] += weight * weights[b] * irradiance_w_m2[b] / pi;
    ray = {arrived.start_m, cosine_direction(arrived.normal, dice)};
  }
}

Paths::Reading Paths::read(const Sensor& sensor, std::size_t paths, Dice& dice) const {
  const std::size_t bands = model_.bands.size();
  Reading reading{std::vector<double>(bands), std::vector<double>(bands), std::vector<double>(bands)};
  const bool spherical = sensor.response == SensorResponse::spherical;
  const glm::dvec3 point_m = sensor.points_m[0];
  const auto look_at = [&](const glm::dvec3& to_light, double per_level, double Waveband::*level_w_m2,
                           std::vector<double>& seen) {
    const double sees = spherical ? 1.0 : std::max(0.0, glm::dot(sensor.normal, to_light));
    if (sees == 0.0 || !is_free(point_m, to_light)) return;
    for (std::size_t b = 0; b < bands; ++b) seen[b] += model_.bands[b].*level_w_m2 * per_level * sees / to_light.y;
  };
  for (std::size_t k = 0; k < paths; ++k) {
    const glm::dvec3 direction = spherical ? any_direction(dice) : cosine_direction(sensor.normal, dice);
    look_back({point_m, direction}, (spherical ? 4.0 : 1.0) * pi / static_cast<double>(paths), dice, reading);
  }
  if (light_.has_beam()) look_at(light_.to_sun(), 1.0, &Waveband::direct_w_m2, reading.direct);
  for (const SkyLight& one : light_.sky_lights()) look_at(one.to_sky, one.weight, &Waveband::diffuse_w_m2, reading.sky);
  return reading;
}

}  // namespace sunfleck::test::differential
