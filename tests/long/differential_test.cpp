// Compares the program with an independent tracer on random scenes of many kinds, in every total, organ, element, side, row of
// the profile, plane and sensor. Embree finds the triangles of one period; wrapping, sampling, scattering and tallies are the
// tracer's own, in double precision.

#include "long/differential_comparison.h"
#include "long/differential_figures.h"
#include "long/differential_scenes.h"
#include "long/differential_tracer.h"
#include "physics/transport/receivers/sensors.h"
#include "support/leaf_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace sunfleck::test::differential {

// Prints a kind in GoogleTest's messages.
inline void PrintTo(const SceneKind& kind, std::ostream* out) {
  *out << kind.scenes << " scenes";
}

namespace {

constexpr int runs = 5;  // of the program on each scene, with different seeds
constexpr int differential_replicates = 64;

RadiationResult run(const RadiationModel& model, const Prepared& prepared, std::uint64_t seed) {
  const ScatterWork work{.rays = 1500.0 * differential_replicates,
                         .packets = 1000,
                         .replicates = differential_replicates,
                         .seed = seed,
                         .bound = 1e-4};
  SolveSettings settings = fixed_scatter(model, work);
  settings.element_errors = ElementErrors::keep_sides;
  CpuTracer tracer(prepared.bvh, tracer_scene(model));
  RadiationResult result = solve(model, prepared.layout, tracer, settings, {});
  const SensorSettings sensors{.rays = 128, .replicates = differential_replicates, .seed = seed};
  result.sensors = measure_sensors(model, prepared.layout, tracer, sensors, {}).value().points;
  EXPECT_EQ(result.lost_rays, 0U);
  return result;
}

class Differential : public testing::TestWithParam<SceneKind> {};

TEST_P(Differential, AgreesWithAnIndependentTracer) {
  const SceneKind& kind = GetParam();
  const double quantile = t_quantile(SolveSettings{}.accuracy.confidence, differential_replicates);
  Comparison comparison(differential_replicates, quantile);
  for (int scene = 0; scene < kind.scenes; ++scene) {
    const RadiationModel model = make_scene(kind, scene);
    const std::vector<Figure> figures = figures_of(model);
    const std::vector<Stated> traced =
        trace_figures(model, figures, {.batches = differential_replicates, .cells = 64, .sensor_paths = 512, .seed = 1});
    const Prepared prepared(model);
    for (int number = 1; number <= runs; ++number) {
      const RadiationResult result = run(model, prepared, static_cast<std::uint64_t>(number));
      for (std::size_t k = 0; k < figures.size(); ++k) {
        const std::string name = fmt::format("scene {}, run {}, {}", scene, number, name_of(model, figures[k]));
        comparison.add(name, stated(model, result, figures[k], quantile), traced[k]);
      }
    }
  }
  comparison.expect_agreement(kind.name);
}

INSTANTIATE_TEST_SUITE_P(, Differential, testing::ValuesIn(scene_kinds().begin(), scene_kinds().end()),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace sunfleck::test::differential
