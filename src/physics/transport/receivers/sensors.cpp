#include "physics/transport/receivers/sensors.h"

#include "base/check.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/sensor_paths.h"
#include "physics/transport/receivers/sensor_rays.h"
#include "physics/transport/receivers/sensor_tally.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::size_t rays_at_a_time = std::size_t{1} << 18U;
constexpr std::uint32_t sky_purpose = 0;
// Rays traced between two questions whether the time is up: a few seconds' work.
constexpr std::size_t most_rays_of_a_batch = std::size_t{1} << 22U;
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
        all_(rays_.points()) {
    for (const Sensor& sensor : model.sensors) first_point_.push_back(first_point_.back() + sensor.points_m.size());
    for (std::size_t b = 0; b < model.bands.size(); ++b) brightest_w_m2_.push_back(scatters(model) ? brightest_w_m2(b) : 0.0);
  }

  // Returns nothing if stopped.
  [[nodiscard]] std::optional<SensorReadings> measure() {
    std::vector<std::size_t> sensors(model_.sensors.size());
    std::iota(sensors.begin(), sensors.end(), std::size_t{0});
    if (!see_exact_light() || !add_replicates(sensors, static_cast<std::size_t>(settings_.replicates))) return std::nullopt;
    const std::optional<StopReason> end = settings_.bound ? reach_bound(std::move(sensors)) : StopReason::work_done;
    if (!end) return std::nullopt;
    return readings(*end);
  }

 private:
  // The sensor and band whose total has the largest error.
  struct Judged {
    double relative = 0.0;
    std::size_t sensor = 0, band = 0;
  };

  [[nodiscard]] Visibility look(std::size_t slots) const { return {model_, layout_, rays_, tracer_, slots, stop_}; }
  [[nodiscard]] std::size_t points_of(std::size_t sensor) const { return first_point_[sensor + 1] - first_point_[sensor]; }

  // Returns the exitance of a surface in full sun under the open sky, the brightest possible after one scattering.
  [[nodiscard]] double brightest_w_m2(std::size_t band) const {
    double light_w_m2 = light_.beam_w_m2.empty() ? 0.0 : light_.beam_w_m2[band];
    if (light_.sky) light_w_m2 += light_.sky_w_m2[band] * light_.sky->spherical_irradiance();
    double brightest = model_.soil ? model_.soil->reflectance[band] * light_w_m2 : 0.0;
    for (const SurfaceOptics& optics : model_.optics) {
      for (const auto* face : {&optics.upper, &optics.lower}) {
        brightest = std::max(brightest, optics.exitance_w_m2(band) + (1.0 - (*face)[band].absorptance()) * light_w_m2);
      }
    }
    return brightest;
  }

  // Sees the sun, and a sky of single lights, from every point, and begins the tallies. Returns false if stopped.
  [[nodiscard]] bool see_exact_light() {
    const std::size_t bands = model_.bands.size();
    Visibility sun = look(all_.size()), sky = look(all_.size());
    const bool list = light_.sky && light_.sky->is_list();
    for (std::size_t p = 0; p < all_.size(); ++p) {
      if (!light_.beam_w_m2.empty()) sun.add(p, all_[p], light_.to_sun, 1.0);
      if (!list) continue;
      for (const SkyLight& one : light_.sky->lights()) sky.add(p, all_[p], one.to_sky, one.weight / one.to_sky.y);
    }
    const auto sunlit = sun.take(), lit = sky.take();
    if (!sunlit || !lit) return false;
    const std::vector<double> sky_w_m2 = light_.sky ? light_.sky_w_m2 : std::vector<double>(bands);
    for (std::size_t s = 0; s < model_.sensors.size(); ++s) {
      ExactLight mean{std::vector<double>(bands), {}};
      const auto share = 1.0 / static_cast<double>(points_of(s));
      for (std::size_t p = first_point_[s]; p < first_point_[s + 1]; ++p) {
        ExactLight here{std::vector<double>(bands), {}};
        for (std::size_t b = 0; b < light_.beam_w_m2.size(); ++b) {
          here.direct_w_m2[b] = (*sunlit)[p].sum * light_.beam_w_m2[b];
          mean.direct_w_m2[b] += share * here.direct_w_m2[b];
        }
        if (list || !light_.sky) here.sky = (*lit)[p].sum;
        if (here.sky) mean.sky = mean.sky.value_or(0.0) + share * *here.sky;
        points_.emplace_back(std::move(here), sky_w_m2);
      }
      means_.emplace_back(std::move(mean), sky_w_m2);
    }
    sky_ray_.resize(all_.size());
    return true;
  }

  // Adds replicates of some sensors that have equally many. Returns false if stopped.
  [[nodiscard]] bool add_replicates(const std::vector<std::size_t>& sensors, std::size_t count) {
    std::vector<std::size_t> points;
    for (const std::size_t s : sensors)
      for (std::size_t p = first_point_[s]; p < first_point_[s + 1]; ++p) points.push_back(p);
    const SensorBatch batch{all_, points, points_[points.front()].replicates(), count};
    const auto sky = sky_light(batch);
    if (!sky) return false;
    std::vector<double> scattered(batch.slots() * model_.bands.size());
    if (scatters(model_)) {
      auto got = SensorPaths(model_, layout_, light_, rays_, tracer_).run(batch, settings_, stop_);
      if (!got) return false;
      scattered = std::move(*got);
    }
    std::size_t slot = 0;  // of the sensor's first point and replicate
    for (const std::size_t s : sensors) {
      for (std::size_t r = 0; r < count; ++r) add_replicate(s, slot + r, count, *sky, scattered);
      slot += points_of(s) * count;
    }
    return true;
  }

  // Returns the sampled sky light of each slot, for a sky of horizontal irradiance 1; nothing if stopped.
  [[nodiscard]] std::optional<std::vector<double>> sky_light(const SensorBatch& batch) {
    std::vector<double> light(batch.slots());
    if (!light_.sky || light_.sky->is_list()) return light;
    Visibility visibility = look(batch.slots());
    for (std::size_t slot = 0; slot < batch.slots(); ++slot) {
      const std::size_t p = batch.point(slot);
      add_sky_rays(visibility, *light_.sky, all_[p], slot, sensor_stream(settings_.seed, sky_purpose, p, batch.replicate(slot)),
                   settings_.rays);
    }
    const auto seen = visibility.take();
    if (!seen) return std::nullopt;
    for (std::size_t slot = 0; slot < batch.slots(); ++slot) {
      light[slot] = (*seen)[slot].sum;
      double& largest = sky_ray_[batch.point(slot)];
      largest = std::max(largest, (*seen)[slot].largest);
    }
    return light;
  }

  // Adds one replicate of a sensor, whose points have the slots `first`, `first + step`, ...
  void add_replicate(std::size_t sensor, std::size_t first, std::size_t step, const std::vector<double>& sky,
                     const std::vector<double>& scattered) {
    const std::size_t bands = model_.bands.size();
    const double share = 1.0 / static_cast<double>(points_of(sensor));
    SampledLight mean{0.0, std::vector<double>(bands)};
    for (std::size_t i = 0; i < points_of(sensor); ++i) {
      const std::size_t slot = first + i * step;
      const auto begin = scattered.begin() + static_cast<std::ptrdiff_t>(slot * bands);
      const SampledLight here{sky[slot], {begin, begin + static_cast<std::ptrdiff_t>(bands)}};
      points_[first_point_[sensor] + i].add(here);
      mean.sky += share * here.sky;
      for (std::size_t b = 0; b < bands; ++b) mean.scattered[b] += share * here.scattered[b];
    }
    means_[sensor].add(mean);
  }

  // Returns what one more event would add to a replicate of a point, in parts on which all replicates agree.
  [[nodiscard]] SampledLight unseen_at(std::size_t point) const {
    SampledLight event{sky_ray_[point], brightest_w_m2_};
    for (double& light : event.scattered) light *= SensorPaths::start_weight(all_[point].response) / settings_.rays;
    return points_[point].unseen(std::move(event));
  }

  // Returns the mean over a sensor's points. Events that may have escaped its points together are as many as at one of them.
  [[nodiscard]] SensorResult mean_of(std::size_t sensor) const {
    SampledLight largest{0.0, std::vector<double>(model_.bands.size())};
    const double share = 1.0 / static_cast<double>(points_of(sensor));
    for (std::size_t p = first_point_[sensor]; p < first_point_[sensor + 1]; ++p) {
      const SampledLight event = unseen_at(p);
      largest.sky = std::max(largest.sky, share * event.sky);
      for (std::size_t b = 0; b < largest.scattered.size(); ++b)
        largest.scattered[b] = std::max(largest.scattered[b], share * event.scattered[b]);
    }
    return means_[sensor].result(largest, settings_.confidence);
  }

  [[nodiscard]] Judged error_of(std::size_t sensor) const {
    const SensorResult mean = mean_of(sensor);
    Judged largest{0.0, sensor, 0};
    for (std::size_t b = 0; b < mean.total.size(); ++b) {
      const Estimate& total = mean.total[b];
      const double relative =
          total.half_width > 0.0 ? total.half_width / std::max(total.value, settings_.bound->least_w_m2[b]) : 0.0;
      if (relative > largest.relative) largest = {relative, sensor, b};
    }
    return largest;
  }

  // Gives the sensors more replicates, each until two checks in a row find its error within the bound. Returns nothing if
  // stopped.
  [[nodiscard]] std::optional<StopReason> reach_bound(std::vector<std::size_t> sensors) {
    const SensorBound& bound = *settings_.bound;
    std::vector<int> good(model_.sensors.size());
    std::size_t next = first_check;
    std::uint64_t rays = all_.size() * static_cast<std::size_t>(settings_.replicates) * settings_.rays;
    while (true) {
      const std::size_t done = means_[sensors.front()].replicates();
      if (done >= next) {
        double largest = 0.0;
        std::vector<std::size_t> left;
        for (const std::size_t s : sensors) {
          const double error = error_of(s).relative;
          good[s] = error <= bound.relative ? good[s] + 1 : 0;
          if (good[s] < 2) left.push_back(s);
          if (good[s] < 2) largest = std::max(largest, error);
        }
        if (left.empty()) return StopReason::bound_reached;
        sensors = std::move(left);
        next = next_check(done, largest / bound.relative);
        if (bound.report) bound.report(largest, rays);
      }
      if (done >= most_replicates) return StopReason::replicates_spent;
      if (bound.time_is_up && bound.time_is_up()) return StopReason::time_spent;
      std::size_t points = 0;
      for (const std::size_t s : sensors) points += points_of(s);
      const std::size_t at_once = std::max<std::size_t>(1, most_rays_of_a_batch / (points * settings_.rays));
      const std::size_t count = std::min(at_once, next - done);
      if (!add_replicates(sensors, count)) return std::nullopt;
      rays += std::uint64_t{points} * count * settings_.rays;
    }
  }

  // Returns the number of replicates of the next check, when the error is `excess` times the bound. Half-widths fall with the
  // square root of that number.
  [[nodiscard]] static std::size_t next_check(std::size_t done, double excess) {
    const auto n = static_cast<double>(done);
    const double wanted = std::clamp(1.1 * n * excess * excess, 1.25 * n, 2.0 * n);
    return std::min(most_replicates, static_cast<std::size_t>(std::ceil(wanted)));
  }

  [[nodiscard]] SensorReadings readings(StopReason stop) const {
    SensorReadings readings;
    readings.stop = stop;
    readings.summary.rays = settings_.rays;
    Judged largest;
    for (std::size_t s = 0; s < model_.sensors.size(); ++s) {
      std::vector<SensorResult>& points = readings.points.emplace_back();
      for (std::size_t p = first_point_[s]; p < first_point_[s + 1]; ++p)
        points.push_back(points_[p].result(unseen_at(p), settings_.confidence));
      readings.means.push_back(mean_of(s));
      readings.summary.replicates = std::max(readings.summary.replicates, means_[s].replicates());
      if (!settings_.bound) continue;
      const Judged judged = error_of(s);
      if (s == 0 || judged.relative > largest.relative) largest = judged;
    }
    if (!settings_.bound) return readings;
    readings.summary.relative_error = largest.relative;
    readings.summary.bound = settings_.bound->relative;
    readings.summary.judged = {.of = JudgedFigure::Of::sensor, .sensor = largest.sensor, .band = largest.band};
    return readings;
  }

  const RadiationModel& model_;
  const CounterLayout& layout_;
  Tracer& tracer_;
  const SensorSettings& settings_;
  const StopQuestion& stop_;
  SensorLight light_;
  SensorRays rays_;
  std::vector<SensorPoint> all_;             // points of all sensors
  std::vector<std::size_t> first_point_{0};  // [sensor], and the end
  std::vector<double> brightest_w_m2_;       // [band]; 0 if nothing scatters or shines
  std::vector<double> sky_ray_;              // [point], the most that a sky ray adds to a replicate
  std::vector<SensorTally> points_, means_;  // [point], [sensor]
};

}  // namespace

std::optional<SensorReadings> measure_sensors(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                              const SensorSettings& settings, const StopQuestion& stop) {
  EXPECT(settings.replicates, >=, 8);
  EXPECT(settings.rays, >=, 1U);
  EXPECT(settings.rays, <=, std::uint32_t{1} << 20U);
  if (settings.bound) {
    EXPECT(settings.bound->least_w_m2.size(), ==, model.bands.size());
  }
  if (model.sensors.empty()) return SensorReadings{};
  return SensorMeasurement(model, layout, tracer, settings, stop).measure();
}

}  // namespace sunfleck
