#pragma once
// Scattered light that the points of sensors see: paths are followed backwards, wave by wave, with shadow rays to sun and
// sky from every surface they meet.

#include "base/random.h"
#include "physics/light/sky.h"
#include "physics/transport/receivers/sensor_rays.h"
#include "physics/transport/receivers/sensors.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// The light sources of a scene as sensors see them.
struct SensorLight {
  explicit SensorLight(const RadiationModel& model);

  std::vector<double> beam_w_m2;  // [waveband], on a plane that faces the sun; empty without a beam
  std::vector<double> sky_w_m2;   // [waveband], on a level plane; empty without a sky
  glm::dvec3 to_sun{0.0, 1.0, 0.0};
  std::optional<Sky> sky;
};

// Some replicates of some points. Its slots are numbered by point, then by replicate.
struct SensorBatch {
  std::span<const SensorPoint> all;     // points of all sensors
  std::span<const std::size_t> points;  // numbers of those in the batch
  std::size_t first = 0, replicates = 0;

  [[nodiscard]] std::size_t slots() const { return points.size() * replicates; }
  [[nodiscard]] std::size_t point(std::size_t slot) const { return points[slot / replicates]; }
  [[nodiscard]] std::size_t replicate(std::size_t slot) const { return first + slot % replicates; }
};

// Returns the random numbers of one point's replicate. `purpose` keeps those of sky light and of scattered light apart.
[[nodiscard]] RandomStream sensor_stream(std::uint64_t seed, std::uint32_t purpose, std::size_t point, std::size_t replicate);

// Points of a two-dimensional additive sequence (Roberts' R2: steps are powers of the plastic number) with a random start.
class PairSequence {
 public:
  explicit PairSequence(RandomStream& random) : u_(random.unit()), v_(random.unit()) {}
  [[nodiscard]] glm::dvec2 at(std::uint32_t k) const;

 private:
  double u_, v_;
};

class SensorPaths {
 public:
  // All arguments must outlive the object.
  SensorPaths(const RadiationModel& model, const CounterLayout& layout, const SensorLight& light, const SensorRays& rays,
              Tracer& tracer);

  // Returns a path's weight at a sensor. The mean of exitance over cosine-distributed rays is irradiance; the
  // cross-section of a sphere receives four times the mean over all directions (radiance is exitance / pi).
  [[nodiscard]] static double start_weight(SensorResponse response) {
    return response == SensorResponse::spherical ? 4.0 : 1.0;
  }

  // Returns the light that has left a surface and reaches the points of the batch, W m-2: [slot of the batch * bands + band].
  // Returns nothing if stopped.
  [[nodiscard]] std::optional<std::vector<double>> run(const SensorBatch& batch, const SensorSettings& settings,
                                                       const StopQuestion& stop);

 private:
  struct Wave;
  struct Path {
    std::size_t slot = 0;  // of the batch
    double start = 1.0;    // weight at the sensor
    RandomStream random{0, 0};
  };
  void begin(Wave& wave, const SensorBatch& batch, std::size_t slot, const SensorSettings& settings) const;
  [[nodiscard]] bool follow(Wave wave, std::vector<double>& sums, const StopQuestion& stop) const;
  void scatter(Wave& next, Path path, std::span<double> weights, const MetSurface& surface, std::vector<double>& sums) const;
  void look_at_light(Wave& next, const Path& path, std::span<const double> weights, const MetSurface& surface,
                     const glm::dvec3& to_light, double strength, std::span<const double> light_w_m2) const;
  void go_on(Wave& next, Path path, std::span<double> weights, const MetSurface& surface) const;

  std::size_t bands_;
  const SensorLight& light_;
  const SensorRays& rays_;
  Tracer& tracer_;
  shared::PacketBlock scene_;
};

}  // namespace sunfleck
