#include "physics/transport/solve/joint_sums.h"

#include "physics/transport/indirect/replicate_maker.h"
#include "physics/transport/solve/result_of.h"
#include "support/light_mix.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <vector>

namespace sunfleck {
namespace {

// Two sums of one light, each of weight 1/2, make that light again: their errors are fully correlated.
TEST(JointSums, OfALightWithItselfHasTheErrorOfTheLight) {
  const RadiationModel model = test::light_mix();
  const test::Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, test::tracer_scene(model));
  ReplicateMaker maker(model, prepared.layout, tracer);
  const Conversion conversion = maker.conversion(maker.incidence(2000.0, false));
  std::vector<std::unique_ptr<RunSums>> lights;
  for (int k = 0; k < 2; ++k) lights.push_back(std::make_unique<RunSums>(conversion, ElementErrors::skip));
  // Every organ is a group of its own.
  std::vector<std::size_t> groups(model.canopy.organs.size());
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  JointSums joint({{0, 0.5}, {1, 0.5}}, groups);
  for (std::uint64_t number = 0; number < 4; ++number) {
    const ReplicateSet made = *maker.make({2000.0, false, 500.0, 300, 0.01, 1, number}, {&conversion, 1}, [] { return false; });
    for (const auto& sums : lights) sums->add(made.front());
    joint.add(lights);
  }
  const double quantile = t_quantile(0.95, 4);
  const RunSums& sums = *lights.front();
  const RadiationResult result = figures_of(sums, 0.95);
  const JointErrors errors = joint.errors(quantile, std::vector{result, result});
  ASSERT_EQ(errors.bands.size(), model.bands.size());
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
    const double area_index = conversion.areas.organ_m2[o] / model.plot.area_m2();
    EXPECT_NEAR(errors.groups[o * model.bands.size()], area_index * errors.organs[o * model.bands.size()], 1e-9);
  }
  // Nothing passes below the soil, and the replicates agree about that.
  EXPECT_EQ(errors.bands[0].transmitted, result.bands[0].transmitted.half_width);
}

// Replicates that agree tell no spread; what may have escaped all of them remains.
TEST(JointSums, KeepTheErrorsOfUnseenEvents) {
  const RadiationModel model = test::light_mix();
  const test::Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, test::tracer_scene(model));
  ReplicateMaker maker(model, prepared.layout, tracer);
  const Conversion conversion = maker.conversion(maker.incidence(2000.0, false));
  std::vector<std::unique_ptr<RunSums>> lights;
  lights.push_back(std::make_unique<RunSums>(conversion, ElementErrors::skip));
  JointSums joint({{0, 600.0}}, {});
  const ReplicateSet made = *maker.make({2000.0, false, 500.0, 300, 0.01, 1, 0}, {&conversion, 1}, [] { return false; });
  for (int twice = 0; twice < 2; ++twice) {
    lights.front()->add(made.front());
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
