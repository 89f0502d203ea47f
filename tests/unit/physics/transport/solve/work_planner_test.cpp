// Tests the planner with pilots whose errors follow a known law.

#include "physics/transport/solve/work_planner.h"

#include "physics/transport/model/statistics.h"
#include "support/light_mix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sunfleck {
namespace {

class WorkPlannerTest : public ::testing::Test {
 protected:
  // Returns the errors of a series, with slopes of -0.7 (rays) and -0.5 (packets).
  [[nodiscard]] SeriesOutcome outcome(const Work& work, std::size_t replicates) const {
    const double half_width =
        t_quantile(settings_.accuracy.confidence, replicates) / std::sqrt(static_cast<double>(replicates));
    return {replicates,
            direct_of_one_ray_ * half_width * std::pow(work.rays, -0.7),
            indirect_of_one_packet_ * half_width / std::sqrt(work.packets),
            0.0,
            0.0,
            work.rays + rays_per_packet_ * work.packets};
  }

  // Returns the chosen work, and records the pilots.
  std::optional<Work> choose() {
    pilots_.clear();
    WorkPlanner planner(model_, settings_, maker_);
    return planner.choose([&](const Work& pilot) {
      SeriesOutcome pilots = outcome(pilot, glanced_pilots);
      if (!planner.far_too_small(pilots)) pilots = outcome(pilot, pilot_replicates);
      pilots_.push_back({pilot, pilots.replicates});
      return pilots;
    });
  }

  struct Pilots {
    Work each;
    std::size_t replicates = 0;
  };

  RadiationModel model_ = test::light_mix();
  test::Prepared prepared_{model_};
  CpuTracer tracer_{prepared_.bvh, test::tracer_scene(model_)};
  ReplicateMaker maker_{model_, prepared_.layout, tracer_};
  SolveSettings settings_;
  double direct_of_one_ray_ = 1.0, indirect_of_one_packet_ = 0.5;
  double rays_per_packet_ = 4.5;  // the packet's own, those of later rounds, and the sky's
  std::vector<Pilots> pilots_;
};

TEST_F(WorkPlannerTest, ChoosesWorkThatMeetsBothBoundsAtTheSameTime) {
  for (const double tighter : {1.0, 0.3, 0.2}) {
    settings_.accuracy.direct = 0.001 * tighter;
    settings_.accuracy.indirect = 0.003 * tighter;
    const std::optional<Work> work = choose();
    ASSERT_TRUE(work);
    const SeriesOutcome run = outcome(*work, planned_replicates);
    EXPECT_NEAR(run.direct_error, settings_.accuracy.direct, 1e-6 * settings_.accuracy.direct);
    EXPECT_NEAR(run.indirect_error, settings_.accuracy.indirect, 1e-6 * settings_.accuracy.indirect);
  }
}

TEST_F(WorkPlannerTest, SpendsAtMostATenthOfTheRunOnPilots) {
  for (const double tighter : {1.0, 0.5, 0.2}) {
    settings_.accuracy.direct = 0.0002 * tighter;
    settings_.accuracy.indirect = 0.001 * tighter;
    const std::optional<Work> work = choose();
    ASSERT_TRUE(work);
    Work of_pilots;
    for (const Pilots& pilots : pilots_) {
      of_pilots.rays += pilots.each.rays * static_cast<double>(pilots.replicates);
      of_pilots.packets += pilots.each.packets * static_cast<double>(pilots.replicates);
    }
    EXPECT_LE(of_pilots.rays, 0.1 * work->rays * planned_replicates) << tighter;
    EXPECT_LE(of_pilots.packets, 0.1 * work->packets * planned_replicates) << tighter;
  }
}

// A run never has fewer rays than the pilots that were sufficient for it.
TEST_F(WorkPlannerTest, KeepsThePilotsWorkWhereTheBoundsAreWide) {
  settings_.accuracy.direct = settings_.accuracy.indirect = 0.5;
  const std::optional<Work> work = choose();
  ASSERT_TRUE(work);
  EXPECT_EQ(pilots_.size(), 1U);
  EXPECT_EQ(work->rays, first_pilot.rays);
  EXPECT_EQ(work->packets, first_pilot.packets);
}

// Eight replicates take half of the rays, however many rays each packet brings along.
TEST_F(WorkPlannerTest, LeavesEnoughReplicatesForALimitOfRays) {
  settings_.accuracy.direct = 1e-5;
  settings_.accuracy.indirect = 1e-4;
  const std::optional<Work> free = choose();
  ASSERT_TRUE(free);
  settings_.max_rays = 4'000'000;
  const std::optional<Work> limited = choose();
  ASSERT_TRUE(limited);
  const double rays_each = limited->rays + rays_per_packet_ * limited->packets;
  EXPECT_NEAR(rays_each, 4e6 / 16.0, 2.0);
  EXPECT_LT(limited->rays, free->rays);
  EXPECT_LT(limited->packets, free->packets);
}

TEST_F(WorkPlannerTest, LeavesTheGridAsItIs) {
  settings_.grid_m = std::sqrt(model_.plot.area_m2() / (fixed_grid_replicates * 1e5));
  const std::optional<Work> work = choose();
  ASSERT_TRUE(work);
  EXPECT_NEAR(work->rays, 1e5, 1.0);
  EXPECT_LE(work->packets, work->rays);
  for (const Pilots& pilots : pilots_) {
    EXPECT_LT(pilots.each.rays, 0.1 * work->rays);
    EXPECT_EQ(pilots.replicates, pilot_replicates);
  }
}

TEST_F(WorkPlannerTest, EndsPilotsThatAreFarTooSmallEarly) {
  settings_.accuracy.direct = 2e-5;
  const std::optional<Work> work = choose();
  ASSERT_TRUE(work);
  ASSERT_EQ(pilots_.size(), 2U);
  EXPECT_EQ(pilots_.front().replicates, glanced_pilots);
  EXPECT_EQ(pilots_.back().replicates, pilot_replicates);
  EXPECT_GT(pilots_.back().each.rays, pilots_.front().each.rays);

  settings_.accuracy.direct = 0.05;
  ASSERT_TRUE(choose());
  EXPECT_EQ(pilots_.front().replicates, pilot_replicates);
}

// A light whose error is half as large needs 2^(-1/0.7) of the rays, and gets a half more.
TEST_F(WorkPlannerTest, GivesEachLightTheRaysThatItsErrorNeeds) {
  const WorkPlanner planner(model_, settings_, maker_);
  const std::vector<double> rays{8000.0, 8000.0, 4000.0, 8000.0, 8000.0};
  std::vector<SeriesOutcome> lights;
  for (const double error : {0.02, 0.01, 0.02, 0.015, 0.5}) lights.push_back({pilot_replicates, error, 0.0});
  const std::vector<double> needs = planner.ray_needs(rays, lights, {true, true, true, true, false});
  ASSERT_EQ(needs.size(), 5U);
  EXPECT_EQ(needs[0], 1.0);
  EXPECT_NEAR(needs[1], std::pow(0.5, 1.0 / 0.7), 1e-12);
  EXPECT_NEAR(needs[2], 0.5, 1e-12);
  EXPECT_NEAR(needs[3], std::pow(0.75, 1.0 / 0.7), 1e-12);
  EXPECT_EQ(needs[4], 1.0) << "a faint light gets no more than the others";
  const std::vector<double> shares = planner.ray_shares(needs);
  for (std::size_t k = 0; k < needs.size(); ++k) EXPECT_NEAR(shares[k], std::min(1.0, 1.5 * needs[k]), 1e-12);
  for (SeriesOutcome& light : lights) light.direct_error = 0.0;
  EXPECT_EQ(planner.ray_needs(rays, lights, std::vector(5, true)), std::vector(5, 1.0));
}

// Two lights: two rays of both together for each packet are cheap.
TEST_F(WorkPlannerTest, AddsRaysWhereTheyCostLittleBesidePackets) {
  const WorkPlanner planner(model_, settings_, maker_);
  const std::vector<double> needs{1.0, 0.4};
  Work cheap{100000.0, 200000.0};
  EXPECT_EQ(planner.spare_rays(needs, cheap), needs);
  EXPECT_EQ(cheap.rays, 200000.0) << "twice what each of them asks for";
  EXPECT_EQ(cheap.packets, 200000.0);

  Work few{100000.0, 200000.0};
  EXPECT_EQ(planner.spare_rays(std::vector{1.0, 0.1}, few), (std::vector{1.0, 0.25})) << "a quarter of a ray for each packet";

  Work between{100000.0, 100000.0};
  EXPECT_NEAR(planner.spare_rays(needs, between)[1], 0.6 / 1.25, 1e-12) << "still a half more than it asks for";
  EXPECT_NEAR(between.rays, 125000.0, 1e-6) << "what pilots would give both is 160,000, and 200,000 are cheap";

  Work dear{400000.0, 100000.0};
  EXPECT_NEAR(planner.spare_rays(needs, dear)[1], 0.6, 1e-12);
  EXPECT_EQ(dear.rays, 400000.0);
}

TEST_F(WorkPlannerTest, AddsNoRaysBeyondALimit) {
  const std::vector<double> needs{1.0, 0.4};
  Work work{100000.0, 200000.0};
  settings_.max_rays = 1000000;
  const WorkPlanner limited(model_, settings_, maker_);
  EXPECT_EQ(limited.spare_rays(needs, work), limited.ray_shares(needs));
  EXPECT_EQ(work.rays, 100000.0);
  settings_.max_rays.reset();
  settings_.memory_bytes = 1e6;
  const WorkPlanner short_of_memory(model_, settings_, maker_);
  EXPECT_EQ(short_of_memory.spare_rays(needs, work), short_of_memory.ray_shares(needs));
  EXPECT_EQ(work.rays, 100000.0);
}

TEST_F(WorkPlannerTest, ChoosesNothingIfStopped) {
  WorkPlanner planner(model_, settings_, maker_);
  EXPECT_FALSE(planner.choose([](const Work&) { return std::optional<SeriesOutcome>(); }));
}

}  // namespace
}  // namespace sunfleck
