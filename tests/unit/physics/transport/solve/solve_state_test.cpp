// Tests that a run that is stopped after any of its replicates and resumed from its state gives the same result as an
// uninterrupted run.

#include "physics/transport/solve/solve_state.h"

#include "physics/transport/solve/work_planner.h"
#include "support/light_mix.h"
#include "support/result_numbers.h"
#include "support/solve_states.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace sunfleck {
namespace {

class SolveStateTest : public ::testing::Test {
 protected:
  // Returns the result of a run from the beginning, or from a state.
  RadiationResult solve_from(const SolveState* state, const Monitor& monitor = {}) {
    settings_.resume_from = state;
    return solve(model_, prepared_.layout, tracer_, settings_, monitor);
  }

  // Returns the state of a run that was interrupted after this many replicates.
  SolveState stopped_after(std::size_t replicates, const SolveState* from = nullptr) {
    SolveState last;
    Monitor monitor;
    monitor.interrupted = [&] { return last.replicates() >= replicates; };
    monitor.wants_state = [] { return true; };
    monitor.receive_state = [&](const SolveStateView& state) { last = test::copy_of(state); };
    settings_.replicates_at_once = 1;  // otherwise other finished replicates would be added
    EXPECT_EQ(solve_from(from, monitor).stop, StopReason::interrupted);
    settings_.replicates_at_once = 2;
    EXPECT_EQ(last.replicates(), replicates);
    EXPECT_TRUE(is_state_of(last, state_shape({&model_, 1}, prepared_.layout, settings_, {})));
    return last;
  }

  RadiationModel model_ = test::light_mix();
  test::Prepared prepared_{model_};
  CpuTracer tracer_{prepared_.bvh, test::tracer_scene(model_)};
  SolveSettings settings_ = test::to_a_wide_bound();
};

TEST_F(SolveStateTest, GoesOnToABoundAsIfNeverStopped) {
  settings_.begin_with = {first_pilot};  // so little that the first checks fail
  settings_.accuracy.direct = settings_.accuracy.indirect = 0.007;
  const RadiationResult whole = solve_from(nullptr);
  ASSERT_EQ(whole.stop, StopReason::bound_reached);
  ASSERT_GE(whole.direct.replicates, 16U);
  SolveState state = stopped_after(2);
  for (const std::size_t replicates : {5, 12, 13, 15}) {  // the bounds are checked after 12
    state = stopped_after(replicates, &state);
    EXPECT_TRUE(replicates < 12 ? state.next_check == 12U : state.next_check >= replicates) << state.next_check;
    const RadiationResult resumed = solve_from(&state);
    EXPECT_EQ(resumed.stop, StopReason::bound_reached);
    EXPECT_TRUE(test::all_numbers(resumed) == test::all_numbers(whole)) << replicates;
    EXPECT_EQ(resumed.next_work.rays, whole.next_work.rays);
  }
}

TEST_F(SolveStateTest, GoesOnWithFixedWork) {
  settings_.passes = 9;
  settings_.grid_m = 0.02;
  for (const ElementErrors errors : {ElementErrors::skip, ElementErrors::keep}) {
    settings_.element_errors = errors;
    const RadiationResult whole = solve_from(nullptr);
    const SolveState state = stopped_after(4);
    EXPECT_TRUE(test::all_numbers(solve_from(&state)) == test::all_numbers(whole));
  }
}

TEST_F(SolveStateTest, GoesOnWithoutPacketsAndReceivers) {
  model_.sky.reset();
  model_.planes.clear();
  model_.soil.reset();
  for (std::size_t k = 0; k < model_.optics.size(); ++k) test::set_faces(model_, k, {{}, {}});
  const test::Prepared prepared(model_);
  CpuTracer tracer(prepared.bvh, test::tracer_scene(model_));
  settings_.passes = 8;
  SolveState state;
  Monitor monitor;
  monitor.interrupted = [&] { return state.replicates() >= 3; };
  monitor.wants_state = [] { return true; };
  monitor.receive_state = [&](const SolveStateView& now) { state = test::copy_of(now); };
  const RadiationResult stopped = solve(model_, prepared.layout, tracer, settings_, monitor);
  ASSERT_EQ(stopped.stop, StopReason::interrupted);
  const RadiationResult whole = solve(model_, prepared.layout, tracer, settings_, {});
  settings_.resume_from = &state;
  EXPECT_TRUE(test::all_numbers(solve(model_, prepared.layout, tracer, settings_, {})) == test::all_numbers(whole));
}

// A limit on rays includes those sent before.
TEST_F(SolveStateTest, KeepsToItsLimitOfRays) {
  const RadiationResult unlimited = solve_from(nullptr);
  settings_.max_rays = unlimited.direct.rays + unlimited.indirect.packets + unlimited.indirect.sky_rays;
  settings_.accuracy.direct = 0.001;
  const RadiationResult whole = solve_from(nullptr);
  ASSERT_EQ(whole.stop, StopReason::rays_spent);
  const SolveState state = stopped_after(3);
  const RadiationResult resumed = solve_from(&state);
  EXPECT_EQ(resumed.stop, StopReason::rays_spent);
  EXPECT_TRUE(test::all_numbers(resumed) == test::all_numbers(whole));
}

// Lights that share packets, each with rays of its own, and their sum, whose error is that of the replicates' sums.
TEST_F(SolveStateTest, GoesOnWithSeveralLights) {
  std::vector<RadiationModel> lights(3, model_);
  lights[1].sun = sun_at(15.0, 60.0);
  lights[2].sky.reset();
  const WantedSums wanted{{{{0, 600.0}, {1, 600.0}, {2, 300.0}}}, {}};
  settings_.shade_groups = ShadeGroups::leaves;
  const auto solve_all = [&](const SolveState* from, const Monitor& monitor = {}) {
    settings_.resume_from = from;
    std::vector<std::uint64_t> numbers;
    const auto take = [&](std::size_t, const RadiationResult& result, const SharedOutcome& outcome) {
      for (const std::uint64_t number : test::all_numbers(result)) numbers.push_back(number);
      for (const double error : outcome.sum_errors.front().organs) numbers.push_back(std::bit_cast<std::uint64_t>(error));
    };
    static_cast<void>(solve_lights(lights, prepared_.layout, tracer_, settings_, monitor, nullptr, wanted, take));
    return numbers;
  };
  const std::vector<std::uint64_t> whole = solve_all(nullptr);
  ASSERT_FALSE(whole.empty());
  SolveState state;
  for (const std::size_t replicates : {3, 11}) {
    const SolveState from = state;
    Monitor monitor;
    monitor.interrupted = [&] { return state.replicates() >= replicates; };
    monitor.wants_state = [] { return true; };
    monitor.receive_state = [&](const SolveStateView& now) { state = test::copy_of(now); };
    settings_.replicates_at_once = 1;
    EXPECT_TRUE(solve_all(from.replicates() > 0 ? &from : nullptr, monitor).empty());
    settings_.replicates_at_once = 2;
    ASSERT_EQ(state.replicates(), replicates);
    EXPECT_EQ(state.ray_shares.size(), lights.size());
    EXPECT_TRUE(is_state_of(state, state_shape(lights, prepared_.layout, settings_, wanted)));
    EXPECT_TRUE(solve_all(&state) == whole) << replicates;
  }
}

TEST_F(SolveStateTest, IsHandedOverWhenAskedForAndNotOfPilots) {
  int questions = 0;
  int states = 0;
  Monitor monitor;
  monitor.wants_state = [&] { return ++questions % 5 == 0; };
  monitor.receive_state = [&](const SolveStateView& state) {
    ++states;
    EXPECT_EQ(test::copy_of(state).replicates(), 5U * static_cast<std::size_t>(states));
  };
  const RadiationResult result = solve_from(nullptr, monitor);
  EXPECT_EQ(static_cast<std::size_t>(questions), result.direct.replicates - 1);  // not called again once the run is done
  EXPECT_EQ(states, questions / 5);
}

TEST_F(SolveStateTest, ThatNoRunCanHaveIsRefused) {
  const StateShape shape = state_shape({&model_, 1}, prepared_.layout, settings_, {});
  const SolveState good = stopped_after(3);
  ASSERT_TRUE(is_state_of(good, shape));
  const auto expect_refused = [&](const char* what, const auto& spoil) {
    SolveState bad = good;
    spoil(bad);
    EXPECT_FALSE(is_state_of(bad, shape)) << what;
  };
  expect_refused("no integers", [](SolveState& s) { s.sums.integers.clear(); });
  expect_refused("one integer more", [](SolveState& s) { s.sums.integers.push_back(0); });
  expect_refused("one real less", [](SolveState& s) { s.sums.reals.pop_back(); });
  expect_refused("no replicate", [](SolveState& s) { s.sums.integers.front() = 0; });
  expect_refused("one replicate", [](SolveState& s) { s.sums.integers.front() = 1; });
  expect_refused("replicates below 0", [](SolveState& s) { s.sums.integers.front() = -2; });
  expect_refused("too many replicates", [](SolveState& s) { s.sums.integers.front() = 65537; });
  expect_refused("no rays", [](SolveState& s) { s.work.rays = 0.0; });
  expect_refused("rays that are no number", [](SolveState& s) { s.work.rays = std::numeric_limits<double>::quiet_NaN(); });
  expect_refused("more rays than a grid has", [](SolveState& s) { s.work.rays = 1e12; });
  expect_refused("packets below 0", [](SolveState& s) { s.work.packets = -1.0; });
  expect_refused("endless packets", [](SolveState& s) { s.work.packets = std::numeric_limits<double>::infinity(); });
  expect_refused("shares of rays for two lights", [](SolveState& s) { s.ray_shares = {1.0, 0.5}; });
  expect_refused("a share above 1", [](SolveState& s) { s.ray_shares = {1.5}; });
  expect_refused("no further check", [](SolveState& s) { s.next_check = 0; });
  expect_refused("a check that never comes", [](SolveState& s) { s.next_check = 100000; });
}

}  // namespace
}  // namespace sunfleck
