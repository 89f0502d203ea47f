#include "physics/transport/solve/run_limits.h"

#include <gtest/gtest.h>

#include <limits>

namespace sunfleck {
namespace {

// A run whose time and interruptions a test decides.
class RunLimitsTest : public testing::Test {
 protected:
  double now_s_ = 100.0;
  bool interrupted_ = false;
  SolveSettings settings_;
  Monitor monitor_{.interrupted = [this] { return interrupted_; }, .clock_s = [this] { return now_s_; }};
};

TEST_F(RunLimitsTest, WithoutLimitsEndNothing) {
  RunLimits limits(settings_, monitor_);
  now_s_ += 1e9;
  EXPECT_DOUBLE_EQ(limits.seconds(), 1e9);
  EXPECT_FALSE(limits.seconds_left());
  EXPECT_FALSE(limits.must_stop());
  EXPECT_FALSE(limits.lacks_rays(1'000'000'000, 1'000'000'000));
  EXPECT_EQ(limits.affordable_replicates(1e6, 1'000'000, 10), std::numeric_limits<double>::infinity());
}

TEST_F(RunLimitsTest, OfTimeBeginWithTheRun) {
  settings_.max_seconds = 8.0;
  RunLimits limits(settings_, monitor_);
  EXPECT_DOUBLE_EQ(limits.seconds_left().value_or(-1.0), 8.0);
  now_s_ += 7.5;
  EXPECT_FALSE(limits.must_stop());
  EXPECT_DOUBLE_EQ(limits.affordable_replicates(0.25, 0, 3), 2.0);
  now_s_ += 0.5;
  EXPECT_TRUE(limits.must_stop());
  EXPECT_EQ(limits.reason(), StopReason::time_spent);
  now_s_ += 10.0;
  EXPECT_DOUBLE_EQ(limits.seconds_left().value_or(-1.0), 0.0);
  EXPECT_DOUBLE_EQ(limits.affordable_replicates(0.25, 0, 3), 0.0);
}

TEST_F(RunLimitsTest, AnInterruptionIsTheReasonEvenIfTimeIsUp) {
  settings_.max_seconds = 1.0;
  RunLimits limits(settings_, monitor_);
  now_s_ += 2.0;
  interrupted_ = true;
  EXPECT_TRUE(limits.must_stop());
  EXPECT_EQ(limits.reason(), StopReason::interrupted);
}

TEST_F(RunLimitsTest, OfRaysAllowWholeReplicates) {
  settings_.max_rays = 1000;
  RunLimits limits(settings_, monitor_);
  EXPECT_FALSE(limits.lacks_rays(600, 400));
  EXPECT_EQ(limits.reason(), StopReason::interrupted) << "nothing has ended the run";
  EXPECT_TRUE(limits.lacks_rays(600, 401));
  EXPECT_EQ(limits.reason(), StopReason::rays_spent);
  EXPECT_DOUBLE_EQ(limits.affordable_replicates(1.0, 600, 4), 2.0) << "150 rays each, and 400 are left";
  EXPECT_DOUBLE_EQ(limits.affordable_replicates(1.0, 1100, 4), 0.0);
}

TEST_F(RunLimitsTest, TheScarcerOfTimeAndRaysCounts) {
  settings_.max_rays = 1000;
  settings_.max_seconds = 10.0;
  RunLimits limits(settings_, monitor_);
  EXPECT_DOUBLE_EQ(limits.affordable_replicates(1.0, 900, 9), 1.0);
  EXPECT_DOUBLE_EQ(limits.affordable_replicates(20.0, 100, 1), 0.5);
}

}  // namespace
}  // namespace sunfleck
