#include "simulate/day_blocks.h"

#include "base/units.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace sunfleck {
namespace {

// A plan whose steps have the sun at these elevations, degrees, and diffuse light where the sun is up.
struct Steps {
  void add(std::size_t date, double elevation_deg, double diffuse_w_m2 = 100.0) {
    DayStep step;
    step.date = date;
    step.sun.elevation_rad = elevation_deg * degree;
    plan.course.steps.push_back(step);
    MomentLight light;
    light.sun = step.sun;
    light.sky = SkyModel{};
    if (elevation_deg > 0.0) light.bands = {Waveband{.name = "PAR", .diffuse_w_m2 = diffuse_w_m2}};
    plan.lights.push_back(light);
  }

  [[nodiscard]] std::vector<std::size_t> sizes(std::size_t most) {
    RadiationModel model;
    model.bands = {Waveband{.name = "PAR"}};
    plan_blocks(model, most, plan);
    std::vector<std::size_t> sizes;
    std::size_t end = 0;
    for (const DayBlock& block : plan.blocks) {
      EXPECT_GE(block.first, end);
      end = block.end;
      sizes.push_back(block.size());
    }
    EXPECT_LE(end, plan.course.steps.size());
    return sizes;
  }

  DayPlan plan;
};

TEST(DayBlocks, HoldNoNightAndNoTwoDates) {
  Steps steps;
  for (std::size_t date = 0; date < 2; ++date) {
    steps.add(date, -5.0);
    for (const double elevation_deg : {5.0, 30.0, 20.0}) steps.add(date, elevation_deg);
  }
  EXPECT_EQ(steps.sizes(10), (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(steps.plan.blocks[0].first, 1U);
  EXPECT_EQ(steps.plan.blocks[1].first, 5U);
}

TEST(DayBlocks, AreOfNearlyTheSameSize) {
  Steps steps;
  for (int k = 0; k < 14; ++k) steps.add(0, 10.0 + k);
  EXPECT_EQ(steps.sizes(5), (std::vector<std::size_t>{4, 5, 5}));
  EXPECT_EQ(steps.sizes(14), (std::vector<std::size_t>{14}));
  EXPECT_EQ(steps.sizes(1), std::vector<std::size_t>(14, 1));
}

TEST(DayBlocks, LeaveDarkStepsAlone) {
  Steps steps;
  steps.add(0, 10.0);
  steps.add(0, 20.0, 0.0);
  steps.add(0, 30.0);
  steps.add(0, 40.0);
  EXPECT_EQ(steps.sizes(8), (std::vector<std::size_t>{1, 1, 2}));
}

TEST(DayBlocks, HoldAsManyStepsAsFitTheMemory) {
  Steps steps;
  steps.add(0, 10.0);
  RadiationModel model;
  model.bands = {Waveband{.name = "PAR"}, Waveband{.name = "NIR"}};
  model.canopy.corners = ElementCorners(std::vector<Triangle>(1000));
  const auto most = [&](double memory_bytes, bool of_triangles) {
    return steps_in_memory(model, steps.plan, of_triangles, memory_bytes);
  };
  EXPECT_EQ(most(1.0, false), 1U);
  EXPECT_EQ(most(1e12, true), 6U);
  // At least the quanta of both sides from the sky and from all light, in a run and its pilots.
  const double least = 2.0 * 1000 * 2 * 2 * 2 * sizeof(std::int64_t);
  EXPECT_LE(most(5.0 * least, false), 5U);
  EXPECT_GE(most(5.0 * least, false), 3U);
  EXPECT_LT(most(5.0 * least, true), most(5.0 * least, false));
  steps.plan.lights.front().sky.reset();
  EXPECT_GT(most(5.0 * least, false), 5U);
}

TEST(DayBlocks, NamedByANumberKeepTheirSteps) {
  const DayBlock block = block_of(number_of({7, 19}));
  EXPECT_EQ(block.first, 7U);
  EXPECT_EQ(block.end, 19U);
}

TEST(DayBlocks, HaveTheLightsOfTheirSteps) {
  Steps steps;
  steps.add(0, 10.0, 50.0);
  steps.add(0, 20.0, 70.0);
  RadiationModel model;
  const std::vector<RadiationModel> lights = lights_of(model, steps.plan, {0, 2});
  ASSERT_EQ(lights.size(), 2U);
  EXPECT_EQ(lights[1].bands[0].diffuse_w_m2, 70.0);
  EXPECT_NEAR(lights[1].sun->elevation_rad, 20.0 * degree, 1e-15);
}

}  // namespace
}  // namespace sunfleck
