// Compares sensors with light followed forwards: on planes of a canopy, and on leaves (validation.md B14 vi).
#include "physics/transport/receivers/sensors.h"
#include "support/leaf_scenes.h"
#include "support/scattering.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sunfleck::test {
namespace {

// Returns random leaves under sun and a clear sky, in PAR and NIR.
RadiationModel leaves_in_the_open() {
  RadiationModel model = paper_model(random_leaves(80, 0.03, unit_plot, 1.0, 11), unit_plot, beijing_sun());
  model.sky = SkyModel{SkyKind::general, 12, 0.0, 0.0, {}};
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.5;
  model.layers = 4;
  return model;
}

// Means over all points of the model's sensors, by band; their spread gives the error.
struct Readings {
  ReplicateMean direct, sky, indirect;  // indirect: sky and scattered light
};
std::vector<Readings> mean_readings(const RadiationModel& model, const Prepared& prepared, std::uint64_t seed) {
  CpuTracer tracer(prepared.bvh, tracer_scene(model));
  const auto got = measure_sensors(model, prepared.layout, tracer, {64, 8, seed, 0.95}, {});
  std::vector<Readings> readings(model.bands.size());
  for (const std::vector<SensorResult>& points : got.value().points) {
    for (const SensorResult& point : points) {
      for (std::size_t b = 0; b < readings.size(); ++b) {
        readings[b].direct.add(point.direct[b].value);
        readings[b].sky.add(point.sky[b].value);
        readings[b].indirect.add(point.sky[b].value + point.scattered[b].value);
      }
    }
  }
  return readings;
}

void expect_equal(const ReplicateMean& sensors, const Estimate& forwards, std::size_t replicates, std::size_t comparisons,
                  double largest_error, const std::string& what) {
  const double error = std::hypot(sensors.standard_error(), standard_error(forwards, replicates));
  std::printf("%-36s sensors %.5f forwards %.5f error %.1e\n", what.c_str(), sensors.mean(), forwards.value, error);
  EXPECT_LE(error, largest_error) << what;
  EXPECT_NEAR(sensors.mean(), forwards.value, table_quantile(comparisons, replicates) * error) << what;
}

TEST(SensorsForward, ReadTheProfile) {
  RadiationModel model = leaves_in_the_open();
  const Prepared prepared(model);
  constexpr int replicates = 32;
  const RadiationResult forward = simulate(model, prepared, fixed_scatter(model, {2e6, 2e4, replicates, 3, 1e-4}));
  Random random(21);
  constexpr int across = 20;
  for (std::size_t layer = 0; layer < 4; ++layer) {
    const LayerResult& plane = forward.layers[layer];
    for (const glm::dvec3& normal : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
      // Just above the soil each point would see a single point of it.
      if (layer == 0 && normal.y < 0.0) continue;
      Sensor grid{"", {}, SensorResponse::cosine, normal};
      // Puts one point in each cell.
      for (int i = 0; i < across * across; ++i) {
        const double x = random.uniform(), z = random.uniform();
        const int column = i % across, row = i / across;
        grid.points_m.emplace_back((column + x) / across, plane.height_m, (row + z) / across);
      }
      model.sensors = {grid};
      const bool downward = normal.y > 0.0;
      const std::vector<Readings> readings = mean_readings(model, prepared, layer + 1);
      for (std::size_t b = 0; b < model.bands.size(); ++b) {
        const std::string what = fmt::format("{:.2f} m, {}, band {}", plane.height_m, downward ? "down" : "up", b);
        Estimate indirect = downward ? plane.down[b] : plane.up[b];
        if (downward) indirect.value -= plane.sunfleck_ratio.value;
        expect_equal(readings[b].indirect, indirect, replicates, 20, 0.01, what);
        if (downward) expect_equal(readings[b].direct, plane.sunfleck_ratio, replicates, 20, 0.03, what + ", direct");
      }
    }
  }
}

// Puts sensors on both triangles of a leaf, with `count` evenly spread points each.
std::vector<Sensor> sensors_on(const Canopy& canopy, std::size_t leaf, std::size_t side, int count, Random& random) {
  std::vector<Sensor> sensors;
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    if (canopy.organ_of[e] != leaf) continue;
    const Triangle& corners = canopy.corners[e];
    const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
    Sensor sensor{"", {}, SensorResponse::cosine, unit_normal(corners) * (side == 0 ? 1.0 : -1.0)};
    for (int k = 0; k < count; ++k) {
      const double root = std::sqrt(random.uniform()), v = random.uniform();
      sensor.points_m.push_back(canopy.origin_m + a * (1.0 - root) + b * (root * (1.0 - v)) + c * (root * v));
    }
    sensors.push_back(sensor);
  }
  return sensors;
}

TEST(SensorsForward, OnALeafReadWhatItReceives) {
  RadiationModel model = leaves_in_the_open();
  const Prepared prepared(model);
  constexpr std::size_t runs = 16, nir = 1;
  constexpr std::array<std::size_t, 3> leaves{4, 33, 70};
  std::array<std::array<ReplicateMean, 2>, leaves.size()> sky, indirect;  // [leaf][side]
  for (std::uint64_t run = 1; run <= runs; ++run) {
    const RadiationResult result = simulate(model, prepared, fixed_packets(model, 1e5, 1, run));
    for (std::size_t l = 0; l < leaves.size(); ++l) {
      for (std::size_t side = 0; side < 2; ++side) {
        double sky_w = 0.0, indirect_w = 0.0, leaf_m2 = 0.0;
        for (std::size_t e = 0; e < model.canopy.size(); ++e) {
          if (model.canopy.organ_of[e] != leaves[l]) continue;
          const double own_m2 = area_m2(model.canopy.corners[e]);
          sky_w += own_m2 * result.side_sky_w_m2(2 * e + side, own_m2, nir);
          indirect_w += own_m2 * result.side_indirect_w_m2(2 * e + side, own_m2, nir);
          leaf_m2 += own_m2;
        }
        sky[l][side].add(sky_w / leaf_m2);
        indirect[l][side].add(indirect_w / leaf_m2);
      }
    }
  }
  Random random(9);
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    for (std::size_t side = 0; side < 2; ++side) {
      model.sensors = sensors_on(model.canopy, leaves[l], side, 150, random);
      const Readings readings = mean_readings(model, prepared, 10 * l + side)[nir];
      const std::string what = fmt::format("leaf {}, side {}", leaves[l], side);
      expect_equal(readings.sky, estimate_of(sky[l][side]), runs, 12, 0.005, what + ", sky");
      expect_equal(readings.indirect, estimate_of(indirect[l][side]), runs, 12, 0.01, what + ", indirect");
    }
  }
}

}  // namespace
}  // namespace sunfleck::test
