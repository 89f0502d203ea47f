#include "physics/transport/solve/joint_sums.h"

#include "physics/transport/indirect/replicate_maker.h"
#include "physics/transport/solve/result_of.h"
#include "physics/transport/solve/run_addition.h"
#include "support/light_mix.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <vector>

namespace sunfleck {
namespace {

class JointSumsTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::unique_ptr<RunSums>> no_sums(int lights) const {
    std::vector<std::unique_ptr<RunSums>> sums;
    for (int k = 0; k < lights; ++k) sums.push_back(std::make_unique<RunSums>(conversion_, ElementErrors::skip));
    return sums;
  }
  [[nodiscard]] ReplicateSet made_replicate(std::uint64_t number) {
    return *maker_.make({2000.0, false, 500.0, 300, 0.01, 1, number}, {&conversion_, 1}, [] { return false; });
  }

  const RadiationModel model_ = test::light_mix();
  const test::Prepared prepared_{model_};
  CpuTracer tracer_{prepared_.bvh, test::tracer_scene(model_)};
  ReplicateMaker maker_{{&model_, 1}, prepared_.layout, tracer_};
  const Conversion conversion_ = maker_.conversion(maker_.incidence(2000.0, false));
};

// Two sums of one light, each of weight 1/2, make that light again: their errors are fully correlated.
TEST_F(JointSumsTest, OfALightWithItselfHasTheErrorOfTheLight) {
  const std::vector<std::unique_ptr<RunSums>> lights = no_sums(2);
  // Every organ is a group of its own.
  std::vector<std::size_t> groups(model_.canopy.organs.size());
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  JointSums joint({{0, 0.5}, {1, 0.5}}, groups, *lights.front());
  for (std::uint64_t number = 0; number < 4; ++number) {
    const ReplicateSet made = made_replicate(number);
    for (const auto& sums : lights) add_replicate(made.front(), *sums);
    joint.add(lights);
  }
  const double quantile = t_quantile(0.95, 4);
  const RunSums& sums = *lights.front();
  const RadiationResult result = figures_of(sums, 0.95);
  const JointErrors errors = joint.errors(quantile, std::vector{result, result});
  ASSERT_EQ(errors.bands.size(), model_.bands.size());
  for (std::size_t b = 0; b < errors.bands.size(); ++b) {
    const auto expect_same = [&](double error, const ReplicateMean& mean) {
      EXPECT_NEAR(error, quantile * mean.standard_error(), 1e-12 * mean.mean());
    };
    expect_same(errors.bands[b].vegetation, sums.bands[b].vegetation);
    expect_same(errors.bands[b].soil, sums.bands[b].soil);
    expect_same(errors.bands[b].reflected, sums.bands[b].reflected);
    EXPECT_GT(errors.bands[b].soil, 0.0);
  }
  ASSERT_EQ(errors.organs.size(), sums.organs.size() * errors.bands.size());
  ASSERT_EQ(errors.plants.size(), sums.plants.size() * errors.bands.size());
  EXPECT_NEAR(errors.organs[1], quantile * sums.organs[0].absorbed[1].standard_error(),
              1e-12 * sums.organs[0].absorbed[1].mean());
  ASSERT_EQ(errors.groups.size(), errors.organs.size());
  for (std::size_t o = 0; o < groups.size(); ++o) {
    const double area_index = conversion_.areas.organ_m2[o] / model_.plot.area_m2();
    EXPECT_NEAR(errors.groups[o * model_.bands.size()], area_index * errors.organs[o * model_.bands.size()], 1e-9);
  }
  // Nothing passes below the soil, and the replicates agree about that.
  EXPECT_EQ(errors.bands[0].transmitted, result.bands[0].transmitted.half_width);
}

// Replicates that agree tell no spread; what may have escaped all of them remains.
TEST_F(JointSumsTest, KeepTheErrorsOfUnseenEvents) {
  const std::vector<std::unique_ptr<RunSums>> lights = no_sums(1);
  JointSums joint({{0, 600.0}}, {}, *lights.front());
  const ReplicateSet made = made_replicate(0);
  for (int twice = 0; twice < 2; ++twice) {
    add_replicate(made.front(), *lights.front());
    joint.add(lights);
  }
  const RadiationResult result = figures_of(*lights.front(), 0.95);
  const JointErrors errors = joint.errors(t_quantile(0.95, 2), {&result, 1});
  EXPECT_GT(errors.bands[0].vegetation, 0.0);
  EXPECT_EQ(errors.bands[0].vegetation, 600.0 * result.bands[0].absorbed_vegetation.half_width);
  EXPECT_EQ(errors.organs[0], 600.0 * result.organs[0].absorbed[0].half_width);
}

}  // namespace
}  // namespace sunfleck
