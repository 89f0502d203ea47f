// Tests runs with a time limit, using a clock that advances by one second with each reported replicate.
#include "support/light_mix.h"
#include "support/models.h"
#include "support/solve_states.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>

namespace sunfleck::test {
namespace {

struct Timed {
  RadiationResult result;
  std::optional<SolveState> state;  // the last one
};

Timed timed(const SolveSettings& settings) {
  const RadiationModel model = light_mix();
  const Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, tracer_scene(model));
  Timed run;
  std::atomic<int> now_s = 0;
  Monitor monitor;
  monitor.clock_s = [&] { return now_s.load(); };
  monitor.report = [&](const Progress&) { ++now_s; };
  monitor.wants_state = [] { return true; };
  monitor.receive_state = [&](const SolveStateView& state) { run.state = copy_of(state); };
  run.result = solve(model, prepared.layout, tracer, settings, monitor);
  return run;
}

// The pilots take 16 seconds of this clock and forecast the packets that the bound needs in 16 replicates. The other half of 32
// seconds has room for a quarter of them.
SolveSettings settings_for(std::optional<double> max_seconds, bool fit_to_time) {
  SolveSettings settings;
  settings.accuracy.direct = 0.01;
  settings.accuracy.indirect = 0.006;
  settings.max_seconds = max_seconds;
  settings.fit_to_time = fit_to_time;
  return settings;
}

TEST(TimeLimit, ShrinksTheWorkAndKeepsNoState) {
  const Timed free = timed(settings_for(std::nullopt, true));
  ASSERT_EQ(free.result.stop, StopReason::bound_reached);
  const Timed fitted = timed(settings_for(32.0, true));
  EXPECT_EQ(fitted.result.stop, StopReason::time_spent);
  EXPECT_GT(fitted.result.direct.replicates, 2U);
  EXPECT_LT(fitted.result.work.packets, 0.6 * free.result.work.packets);
  EXPECT_FALSE(fitted.state) << "of work that depends on the machine's speed";
}

TEST(TimeLimit, LeavesTheWorkOfARunThatMayBeContinued) {
  const Timed free = timed(settings_for(std::nullopt, false));
  const Timed stopped = timed(settings_for(24.0, false));
  EXPECT_EQ(stopped.result.stop, StopReason::time_spent);
  EXPECT_EQ(stopped.result.work.rays, free.result.work.rays);
  EXPECT_EQ(stopped.result.work.packets, free.result.work.packets);
  ASSERT_TRUE(stopped.state);
  EXPECT_EQ(stopped.state->work.packets, free.result.work.packets);
}

TEST(TimeLimit, ThatFitsChangesNothing) {
  const Timed free = timed(settings_for(std::nullopt, true));
  const Timed limited = timed(settings_for(1e6, true));
  EXPECT_EQ(limited.result.stop, StopReason::bound_reached);
  EXPECT_EQ(limited.result.work.packets, free.result.work.packets);
  EXPECT_EQ(limited.result.direct.replicates, free.result.direct.replicates);
  EXPECT_TRUE(limited.state);
}

}  // namespace
}  // namespace sunfleck::test
