// Tests that sensors read the same numbers, bit by bit, on the CPU path and on the device.

#include "agreement/scenes.h"
#include "devices/tracers/vulkan_tracer.h"
#include "physics/transport/receivers/sensors.h"
#include "support/device.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sunfleck::test {
namespace {

class SensorsAgreement : public DeviceTest {
 protected:
  static std::vector<double> read(const RadiationModel& model, const Prepared& prepared, Tracer& tracer) {
    std::vector<double> numbers;
    const auto readings = measure_sensors(model, prepared.layout, tracer, {.rays = 256, .replicates = 8, .seed = 3}, {});
    for (const std::vector<SensorResult>& points : readings.value().points) {
      for (const SensorResult& reading : points) {
        for (const auto* column : {&reading.direct, &reading.sky, &reading.scattered, &reading.total}) {
          for (const Estimate& estimate : *column) numbers.insert(numbers.end(), {estimate.value, estimate.half_width});
        }
      }
    }
    return numbers;
  }
};

TEST_F(SensorsAgreement, InMaize) {
  RadiationModel model = maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun());
  set_leaf_bands(model, std::array{par_band, nir_band});
  model.sky = SkyModel{SkyKind::general, 12, 0.0, 0.0, {}};
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.3;
  Sensor line{"line", {}, SensorResponse::cosine, {0, 1, 0}}, ball{"ball", {{0.3, 1.0, 0.2}}, SensorResponse::spherical, {}};
  for (int i = 0; i < 8; ++i) line.points_m.emplace_back(0.1 * i, 0.5, 0.15 * i);
  model.sensors = {line, ball};
  for (const bool periodic : {true, false}) {
    model.plot.periodic = periodic;
    if (!periodic) model.canopy.period_m = glm::dvec2(0.0);
    const Prepared prepared(model);
    const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
    VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words());
    CpuTracer cpu(prepared.bvh, tracer_scene(model));
    const std::vector<double> expected = read(model, prepared, cpu);
    EXPECT_EQ(expected.size(), 9U * 4U * 2U * 2U);
    EXPECT_TRUE(read(model, prepared, device) == expected);
  }
}

}  // namespace
}  // namespace sunfleck::test
