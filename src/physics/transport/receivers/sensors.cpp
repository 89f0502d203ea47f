#include "physics/transport/receivers/sensors.h"

#include "base/check.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/sensor_paths.h"
#include "physics/transport/receivers/sensor_rays.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

constexpr std::size_t rays_at_a_time = std::size_t{1} << 18U;
constexpr std::uint32_t sky_purpose = 0;
// On planes this close to level, rays that carry equal shares of the horizontal irradiance have the smallest variance.
constexpr double nearly_level = 0.999;

// A ray towards a light, and the light that it adds to its slot if nothing is in the way.
struct LightRay {
  std::size_t slot = 0;
  double brings = 0.0;
};

// Collects rays to lights and traces them in batches.
class Visibility {
 public:
  Visibility(const RadiationModel& model, const CounterLayout& layout, const SensorRays& rays, Tracer& tracer,
             std::size_t slots, const StopQuestion& stop)
      : scene_(make_packet_block(model, layout)), rays_(rays), tracer_(tracer), stop_(stop), seen_(slots) {}

  void add(std::size_t slot, const SensorPoint& point, const glm::dvec3& to_light, double strength) {
    const double brings = strength * point.sees(to_light);
    if (brings <= 0.0 || stopped_) return;
    seen_[slot].largest = std::max(seen_[slot].largest, brings);
    packets_.push_back(rays_.from(point, to_light));
    light_.push_back({slot, brings});
    if (packets_.size() == rays_at_a_time) trace();
  }

  struct Seen {
    double sum = 0.0;      // of the light that rays added
    double largest = 0.0;  // the most that a single ray can add
  };
  // Returns the sums, [slot]; nothing if stopped.
  [[nodiscard]] std::optional<std::vector<Seen>> take() {
    trace();
    if (stopped_) return std::nullopt;
    return std::move(seen_);
  }

 private:
  void trace() {
    if (packets_.empty() || stopped_) return;
    landings_.resize(packets_.size());
    stopped_ = tracer_.trace(scene_, packets_, landings_, stop_) == TraceOutcome::stopped;
    if (!stopped_)
      for (std::size_t k = 0; k < light_.size(); ++k)
        if (landings_[k].surface == shared::left_upwards) seen_[light_[k].slot].sum += light_[k].brings;
    packets_.clear();
    light_.clear();
  }

  shared::PacketBlock scene_;
  const SensorRays& rays_;
  Tracer& tracer_;
  const StopQuestion& stop_;
  bool stopped_ = false;
  std::vector<Seen> seen_;
  std::vector<shared::Packet> packets_;
  std::vector<LightRay> light_;
  std::vector<shared::Landing> landings_;
};

// Adds the rays to the sky for one replicate of a point; they yield its irradiance under a sky of horizontal irradiance 1.
void add_sky_rays(Visibility& visibility, const Sky& sky, const SensorPoint& point, std::size_t slot, RandomStream random,
                  std::uint32_t rays) {
  const bool level = point.response == SensorResponse::cosine && point.normal.y > nearly_level;
  const PairSequence sequence(random);
  for (std::uint32_t ray = 0; ray < rays; ++ray) {
    const glm::dvec2 at = sequence.at(ray);
    if (level) {
      const glm::dvec3 to_sky = sky.draw_by_horizontal_irradiance(at.x, at.y);
      visibility.add(slot, point, to_sky, 1.0 / (to_sky.y * rays));
    } else {
      visibility.add(slot, point, sky.draw_by_radiance(at.x, at.y), sky.spherical_irradiance() / rays);
    }
  }
}

class SensorMeasurement {
 public:
  SensorMeasurement(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer, const SensorSettings& settings,
                    const StopQuestion& stop)
      : model_(model),
        layout_(layout),
        tracer_(tracer),
        settings_(settings),
        stop_(stop),
        light_(model),
        rays_(model, layout),
        points_(rays_.points()),
        replicates_(static_cast<std::size_t>(settings.replicates)),
        readings_(points_.size()) {
    for (SensorResult& reading : readings_)
      reading.direct = reading.sky = reading.scattered = std::vector<Estimate>(model.bands.size(), Estimate{0.0, 0.0});
  }

  // The following three return false if stopped.
  [[nodiscard]] bool direct() {
    if (light_.beam_w_m2.empty()) return true;
    Visibility visibility = look(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p) visibility.add(p, points_[p], light_.to_sun, 1.0);
    return settle(visibility, light_.beam_w_m2, &SensorResult::direct);
  }

  [[nodiscard]] bool sky() {
    if (!light_.sky) return true;
    const bool list = light_.sky->is_list();
    Visibility visibility = look(list ? points_.size() : points_.size() * replicates_);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      for (const SkyLight& one : light_.sky->lights()) visibility.add(p, points_[p], one.to_sky, one.weight / one.to_sky.y);
      for (std::size_t r = 0; r < replicates_ && !list; ++r)
        add_sky_rays(visibility, *light_.sky, points_[p], p * replicates_ + r,
                     sensor_stream(settings_.seed, sky_purpose, p, static_cast<int>(r)), settings_.rays);
    }
    return settle(visibility, light_.sky_w_m2, &SensorResult::sky);
  }

  [[nodiscard]] bool scattered() {
    if (!scatters(model_)) return true;
    const auto got = SensorPaths(model_, layout_, light_, rays_, tracer_).run(points_, settings_, stop_);
    if (!got) return false;
    const std::size_t bands = model_.bands.size();
    for (std::size_t p = 0; p < points_.size(); ++p)
      for (std::size_t b = 0; b < bands; ++b) {
        ReplicateMean mean;
        for (std::size_t r = 0; r < replicates_; ++r) mean.add((*got)[(p * replicates_ + r) * bands + b]);
        const double of_one_path = SensorPaths::start_weight(points_[p].response) * brightest_w_m2(b) / settings_.rays;
        readings_[p].scattered[b] = mean.estimate(quantile(), unseen(of_one_path));
      }
    return true;
  }

  [[nodiscard]] std::vector<std::vector<SensorResult>> by_sensor() {
    std::vector<std::vector<SensorResult>> results;
    auto next = readings_.begin();
    for (const Sensor& sensor : model_.sensors) {
      const auto end = next + static_cast<std::ptrdiff_t>(sensor.points_m.size());
      results.emplace_back(std::make_move_iterator(next), std::make_move_iterator(end));
      next = end;
    }
    return results;
  }

 private:
  [[nodiscard]] Visibility look(std::size_t slots) const { return {model_, layout_, rays_, tracer_, slots, stop_}; }
  [[nodiscard]] double quantile() const { return t_quantile(settings_.confidence, replicates_); }

  // Returns what may have escaped all replicates of a point if each event adds that much light.
  [[nodiscard]] double unseen(double of_one_event) const {
    return unseen_events(settings_.confidence) * of_one_event / static_cast<double>(replicates_);
  }

  // Returns the exitance of a surface in full sun under the open sky, the brightest possible after one scattering.
  [[nodiscard]] double brightest_w_m2(std::size_t band) const {
    double light_w_m2 = light_.beam_w_m2.empty() ? 0.0 : light_.beam_w_m2[band];
    if (light_.sky) light_w_m2 += light_.sky_w_m2[band] * light_.sky->spherical_irradiance();
    double brightest = model_.soil ? model_.soil->reflectance[band] * light_w_m2 : 0.0;
    for (const SurfaceOptics& optics : model_.optics) {
      const double emission = optics.emission_w_m2.empty() ? 0.0 : optics.emission_w_m2[band];
      for (const auto* face : {&optics.upper, &optics.lower}) {
        brightest = std::max(brightest, emission + (1.0 - (*face)[band].absorptance()) * light_w_m2);
      }
    }
    return brightest;
  }

  // Writes the readings. A point has either a single slot, which is exact, or one slot per replicate, which are averaged.
  [[nodiscard]] bool settle(Visibility& visibility, const std::vector<double>& light_w_m2,
                            std::vector<Estimate> SensorResult::*column) {
    const auto seen = visibility.take();
    if (!seen) return false;
    const std::size_t slots = seen->size() / points_.size();
    for (std::size_t p = 0; p < points_.size(); ++p) {
      ReplicateMean mean;
      double largest = 0.0;
      for (std::size_t r = 0; r < slots; ++r) {
        mean.add((*seen)[p * slots + r].sum);
        largest = std::max(largest, (*seen)[p * slots + r].largest);
      }
      const Estimate relative = slots == 1 ? Estimate{mean.mean(), 0.0} : mean.estimate(quantile(), unseen(largest));
      for (std::size_t b = 0; b < light_w_m2.size(); ++b) (readings_[p].*column)[b] = relative.scaled(light_w_m2[b]);
    }
    return true;
  }

  const RadiationModel& model_;
  const CounterLayout& layout_;
  Tracer& tracer_;
  const SensorSettings& settings_;
  const StopQuestion& stop_;
  SensorLight light_;
  SensorRays rays_;
  std::vector<SensorPoint> points_;
  std::size_t replicates_;
  std::vector<SensorResult> readings_;  // [point of all sensors]
};

}  // namespace

std::optional<std::vector<std::vector<SensorResult>>> measure_sensors(const RadiationModel& model, const CounterLayout& layout,
                                                                      Tracer& tracer, const SensorSettings& settings,
                                                                      const StopQuestion& stop) {
  EXPECT(settings.replicates, >=, 8);
  EXPECT(settings.rays, >=, 1U);
  EXPECT(settings.rays, <=, std::uint32_t{1} << 20U);
  if (model.sensors.empty()) return std::vector<std::vector<SensorResult>>{};
  SensorMeasurement measurement(model, layout, tracer, settings, stop);
  if (!measurement.direct() || !measurement.sky() || !measurement.scattered()) return std::nullopt;
  return measurement.by_sensor();
}

}  // namespace sunfleck
