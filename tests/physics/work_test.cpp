// Tests that a run does about as much work as its bounds need: both errors end close below their bounds.
#include "support/models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr std::size_t work_seeds = 20;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

RadiationModel leaves_that_scatter() {
  RadiationModel model = black_model(random_leaves(150, 0.01, unit_plot, 1.0, 7), unit_plot, beijing_sun());
  for (SurfaceOptics& optics : model.optics) optics.upper = optics.lower = {{0.45, 0.45}};
  model.soil->reflectance = {0.3};
  return model;
}

TEST(Work, EndsCloseBelowBothBounds) {
  const RadiationModel model = leaves_that_scatter();
  const Prepared prepared(model);
  SolveSettings settings;
  settings.accuracy.direct = 0.002;
  settings.accuracy.indirect = 0.006;
  std::vector<double> direct, indirect;
  for (settings.seed = 1; settings.seed <= work_seeds; ++settings.seed) {
    const RadiationResult result = simulate(model, prepared, settings);
    ASSERT_EQ(result.stop, StopReason::bound_reached);
    direct.push_back(*result.direct.relative_error / settings.accuracy.direct);
    indirect.push_back(*result.indirect.relative_error / settings.accuracy.indirect);
    EXPECT_LE(direct.back(), 1.0);
    EXPECT_LE(indirect.back(), 1.0);
  }
  std::printf("error / bound %.3f (direct), %.3f (indirect)\n", median(direct), median(indirect));
  EXPECT_GE(median(direct), 0.85);
  EXPECT_GE(median(indirect), 0.85);
}

// The run is stopped after its first replicate, so that the pilots before it are its result.
TEST(Work, IsThatOfTheReplicatesInTheResult) {
  const RadiationModel model = leaves_that_scatter();
  SolveSettings settings;
  settings.accuracy.direct = settings.accuracy.indirect = 1e-3;
  settings.replicates_at_once = 1;  // nor is the second one made meanwhile
  std::atomic<bool> begun = false;
  Monitor monitor;
  monitor.report = [&](const Progress& progress) { begun = begun || progress.stage != Progress::Stage::pilot; };
  monitor.interrupted = [&] { return bool{begun}; };
  const Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, tracer_scene(model));
  const RadiationResult result = solve(model, prepared.layout, tracer, settings, monitor);
  ASSERT_EQ(result.stop, StopReason::interrupted);
  const double rays = static_cast<double>(result.direct.rays) / static_cast<double>(result.direct.replicates);
  EXPECT_NEAR(result.work.rays, rays, 0.05 * rays);
}

}  // namespace
}  // namespace sunfleck::test
