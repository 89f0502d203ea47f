// Tests how a run reports its progress: pilots are reported as pilots, then one measure never decreases and reaches 1 only at
// the end.
#include "support/models.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck::test {
namespace {

// Returns leaves that scatter, under beam and sky; the bounds of the tests differ in how hard they are to reach.
RadiationModel scattering_leaves() {
  RadiationModel model = black_model(random_leaves(60, 0.01, unit_plot, 1.0, 7), unit_plot, beijing_sun());
  for (SurfaceOptics& optics : model.optics) optics.upper = optics.lower = {{0.45, 0.45}};
  model.soil->reflectance = {0.3};
  model.bands[0].diffuse_w_m2 = 0.5;
  model.sky = SkyModel{};
  return model;
}

struct Told {
  std::vector<Progress> news;
  RadiationResult result;
};

Told told_by(const RadiationModel& model, const SolveSettings& settings) {
  const Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, tracer_scene(model));
  Told told;
  Monitor monitor;
  monitor.report = [&](const Progress& progress) { told.news.push_back(progress); };
  told.result = solve(model, prepared.layout, tracer, settings, monitor);
  return told;
}

void expect_one_way(const std::vector<Progress>& news) {
  double last = 0.0;
  bool running = false;
  std::uint64_t rays = 0;
  for (const Progress& progress : news) {
    EXPECT_GE(progress.rays, rays);
    rays = progress.rays;
    if (progress.stage == Progress::Stage::pilot) {
      EXPECT_FALSE(running) << "a pilot after the run began";
      EXPECT_EQ(progress.fraction, 0.0);
      continue;
    }
    running = true;
    EXPECT_GT(progress.fraction, last);
    last = progress.fraction;
    EXPECT_EQ(progress.fraction == 1.0, &progress == &news.back());
  }
}

TEST(Progress, OfARunToItsBoundsNeverGoesBack) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    SolveSettings settings;
    settings.accuracy.direct = 0.004;
    settings.accuracy.indirect = 0.01;
    settings.seed = seed;
    const Told told = told_by(scattering_leaves(), settings);
    ASSERT_EQ(told.result.stop, StopReason::bound_reached);
    EXPECT_EQ(told.news.front().stage, Progress::Stage::pilot);
    expect_one_way(told.news);
  }
}

// The run begins with the work that pilots chose for another scene, which is far too little: many more replicates follow.
TEST(Progress, OfARunThatTakesFarLongerThanPlannedNeverGoesBack) {
  SolveSettings settings;
  settings.accuracy.direct = 0.004;
  settings.accuracy.indirect = 0.005;
  settings.begin_with = {Work{16384.0, 4096.0}};
  const Told told = told_by(scattering_leaves(), settings);
  ASSERT_EQ(told.result.stop, StopReason::bound_reached);
  ASSERT_GE(told.result.direct.replicates, 40U);
  expect_one_way(told.news);
  double at_16 = 0.0;
  for (const Progress& progress : told.news) at_16 = &progress == &told.news[15] ? progress.fraction : at_16;
  EXPECT_LT(at_16, 0.6) << "the errors told by then how much was left";
}

TEST(Progress, OfFixedWorkIsTheShareOfItsReplicates) {
  SolveSettings settings = fixed_work(scattering_leaves(), 40'000.0, 8);
  settings.packets = 1000.0;
  const Told told = told_by(scattering_leaves(), settings);
  ASSERT_EQ(told.news.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(told.news[k].fraction, static_cast<double>(k + 1) / 8.0, 1e-12);
}

TEST(Progress, OfARunThatRaysWillStopEndsThere) {
  SolveSettings settings;
  settings.accuracy.indirect = 1e-6;
  settings.max_rays = 3'000'000;
  const Told told = told_by(scattering_leaves(), settings);
  ASSERT_EQ(told.result.stop, StopReason::rays_spent);
  EXPECT_GT(told.news.back().fraction, 0.8);
  EXPECT_LE(told.news.back().fraction, 1.0);
}

// The progress names the pass that lags, with its error; the result names the figure that was judged.
TEST(Progress, NamesThePassThatLagsAndTheFigure) {
  RadiationModel model = scattering_leaves();
  SolveSettings settings;
  settings.accuracy.direct = 0.5;
  settings.accuracy.indirect = 0.01;
  const Told told = told_by(model, settings);
  EXPECT_EQ(told.news.back().pass, Progress::Pass::indirect);
  EXPECT_EQ(told.news.back().bound, 0.01);
  ASSERT_TRUE(told.result.indirect.judged && told.result.direct.judged);
  EXPECT_EQ(told.result.indirect.judged->band, 0U);
  EXPECT_FALSE(told.result.direct.judged->band);

  model.bands[0].direct_w_m2 = 0.0;
  const Told of_sky = told_by(model, settings);
  EXPECT_FALSE(of_sky.result.direct.judged) << "there is no beam to be judged";
}

}  // namespace
}  // namespace sunfleck::test
