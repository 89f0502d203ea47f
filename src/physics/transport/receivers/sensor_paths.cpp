#include "physics/transport/receivers/sensor_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

// Number of paths followed at a time: enough to fill a device; they take 3 MiB per band and 12 MiB for the rays.
constexpr std::size_t most_paths = std::size_t{1} << 17U;
// Ends paths that would never end on their own, as in a closed box of perfect mirrors.
constexpr int most_bounces = 10'000;
// First stream of random numbers, apart from those of beam, sky and indirect pass, whose numbers stay below 2^60.
constexpr std::uint64_t sensor_streams = std::uint64_t{1} << 60U;
constexpr std::uint32_t scattered_purpose = 1;

double fraction(double x) {
  return x - std::floor(x);
}

}  // namespace

SensorLight::SensorLight(const RadiationModel& model) {
  if (model.has_beam()) {
    to_sun = direction_to_sun(*model.sun);
    for (const Waveband& band : model.bands) beam_w_m2.push_back(band.direct_w_m2 / std::sin(model.sun->elevation_rad));
  }
  if (model.has_sky()) {
    sky.emplace(*model.sky, model.sun);
    for (const Waveband& band : model.bands) sky_w_m2.push_back(band.diffuse_w_m2);
  }
}

RandomStream sensor_stream(std::uint64_t seed, std::uint32_t purpose, std::size_t point, std::size_t replicate) {
  RandomStream of_point(seed, sensor_streams + point);
  return {of_point.word(), (std::uint64_t{purpose} << 32U) + replicate};
}

glm::dvec2 PairSequence::at(std::uint32_t k) const {
  return {fraction(u_ + k * 0.7548776662466927), fraction(v_ + k * 0.5698402909980532)};
}

// The rays under way at the same time: continuing paths, and shadow rays from the paths' current points.
struct SensorPaths::Wave {
  std::vector<shared::Packet> packets;  // [path], then [shadow]
  std::vector<Path> paths;
  std::vector<double> weights;  // [path * bands + band]
  std::vector<shared::Packet> shadow_packets;
  std::vector<std::size_t> shadow_slots;  // [shadow]
  std::vector<double> shadow_light;       // [shadow * bands + band], W m-2 that counts if nothing is in the way

  void clear() {
    packets.clear();
    paths.clear();
    weights.clear();
    shadow_packets.clear();
    shadow_slots.clear();
    shadow_light.clear();
  }
};

SensorPaths::SensorPaths(const RadiationModel& model, const CounterLayout& layout, const SensorLight& light,
                         const SensorRays& rays, Tracer& tracer)
    : bands_(model.bands.size()), light_(light), rays_(rays), tracer_(tracer), scene_(make_packet_block(model, layout)) {}

std::optional<std::vector<double>> SensorPaths::run(const SensorBatch& batch, const SensorSettings& settings,
                                                    const StopQuestion& stop) {
  const std::size_t slots = batch.slots();
  const std::size_t slots_at_a_time = std::max<std::size_t>(1, most_paths / settings.rays);
  std::vector<double> sums(slots * bands_);
  for (std::size_t first = 0; first < slots; first += slots_at_a_time) {
    Wave wave;
    for (std::size_t slot = first; slot < std::min(slots, first + slots_at_a_time); ++slot) begin(wave, batch, slot, settings);
    if (!follow(std::move(wave), sums, stop)) return std::nullopt;
  }
  for (double& sum : sums) sum /= settings.rays;
  return sums;
}

void SensorPaths::begin(Wave& wave, const SensorBatch& batch, std::size_t slot, const SensorSettings& settings) const {
  const SensorPoint& point = batch.all[batch.point(slot)];
  const bool spherical = point.response == SensorResponse::spherical;
  RandomStream random = sensor_stream(settings.seed, scattered_purpose, batch.point(slot), batch.replicate(slot));
  const PairSequence sequence(random);
  for (std::uint32_t ray = 0; ray < settings.rays; ++ray) {
    const glm::dvec2 at = sequence.at(ray);
    wave.packets.push_back(
        rays_.from(point, spherical ? direction_on_sphere(at.x, at.y) : direction_about(point.normal, at.x, at.y)));
    const double weight = start_weight(point.response);
    wave.paths.push_back({slot, weight, RandomStream(random.word(), ray)});
    wave.weights.insert(wave.weights.end(), bands_, weight);
  }
}

// Follows the paths until all have ended. Returns false if stopped.
bool SensorPaths::follow(Wave wave, std::vector<double>& sums, const StopQuestion& stop) const {
  Wave next;
  std::vector<shared::Landing> landings;
  for (int bounce = 0; bounce < most_bounces && !wave.packets.empty(); ++bounce) {
    landings.resize(wave.packets.size());
    if (tracer_.trace(scene_, wave.packets, landings, stop) == TraceOutcome::stopped) return false;
    next.clear();
    for (std::size_t p = 0; p < wave.paths.size(); ++p) {
      if (landings[p].surface > shared::landed_on_ground) continue;
      const std::span<double> weights(&wave.weights[p * bands_], bands_);
      scatter(next, wave.paths[p], weights, rays_.surface(landings[p]), sums);
    }
    for (std::size_t s = 0; s < wave.shadow_slots.size(); ++s) {
      if (landings[wave.paths.size() + s].surface != shared::left_upwards) continue;
      for (std::size_t b = 0; b < bands_; ++b) sums[wave.shadow_slots[s] * bands_ + b] += wave.shadow_light[s * bands_ + b];
    }
    next.packets.insert(next.packets.end(), next.shadow_packets.begin(), next.shadow_packets.end());
    std::swap(wave, next);
  }
  return true;
}

void SensorPaths::scatter(Wave& next, Path path, std::span<double> weights, const MetSurface& surface,
                          std::vector<double>& sums) const {
  for (std::size_t b = 0; b < surface.emission_w_m2.size(); ++b)
    sums[path.slot * bands_ + b] += weights[b] * surface.emission_w_m2[b];
  if (!light_.beam_w_m2.empty()) look_at_light(next, path, weights, surface, light_.to_sun, 1.0, light_.beam_w_m2);
  if (light_.sky) {
    const double u = path.random.unit(), v = path.random.unit();
    look_at_light(next, path, weights, surface, light_.sky->draw_by_radiance(u, v), light_.sky->spherical_irradiance(),
                  light_.sky_w_m2);
  }
  go_on(next, path, weights, surface);
}

// Adds a shadow ray towards light of the given strength per area normal to it. The light is reflected if it comes from the
// side that was met, transmitted if it comes from the other side.
void SensorPaths::look_at_light(Wave& next, const Path& path, std::span<const double> weights, const MetSurface& surface,
                                const glm::dvec3& to_light, double strength, std::span<const double> light_w_m2) const {
  const double cosine = glm::dot(surface.normal, to_light);
  double largest = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    const double share = cosine > 0.0 ? surface.front[b].reflectance : surface.back[b].transmittance;
    const double light = weights[b] * share * strength * std::abs(cosine) * light_w_m2[b];
    next.shadow_light.push_back(light);
    largest = std::max(largest, light);
  }
  if (largest == 0.0) {
    next.shadow_light.resize(next.shadow_light.size() - bands_);
    return;
  }
  next.shadow_packets.push_back(rays_.from(surface, to_light));
  next.shadow_slots.push_back(path.slot);
}

// Continues a path towards light from other surfaces. Chooses reflection or transmission by their shares of what the path
// could contribute, then plays Russian roulette, so that no band's weight rises far above its value at the sensor and not
// all of them fall far below it.
void SensorPaths::go_on(Wave& next, Path path, std::span<double> weights, const MetSurface& surface) const {
  double reflected = 0.0, transmitted = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    reflected += weights[b] * surface.front[b].reflectance;
    transmitted += weights[b] * surface.back[b].transmittance;
  }
  if (!(reflected + transmitted > 0.0)) return;
  const double chance = reflected / (reflected + transmitted);
  const bool reflects = path.random.unit() < chance;
  double largest = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    weights[b] *= reflects ? surface.front[b].reflectance / chance : surface.back[b].transmittance / (1.0 - chance);
    largest = std::max(largest, weights[b]);
  }
  const double survival = std::min(1.0, largest / path.start);
  if (path.random.unit() >= survival) return;
  for (double& weight : weights) weight /= survival;
  const double u = path.random.unit(), v = path.random.unit();
  next.packets.push_back(rays_.from(surface, direction_about(reflects ? surface.normal : -surface.normal, u, v)));
  next.weights.insert(next.weights.end(), weights.begin(), weights.end());
  next.paths.push_back(path);
}

}  // namespace sunfleck
