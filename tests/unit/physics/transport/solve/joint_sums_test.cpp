#include "physics/transport/solve/joint_sums.h"

#include "physics/transport/indirect/replicate_maker.h"
#include "support/light_mix.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <memory>
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
  JointSums joint({{0, 0.5}, {1, 0.5}});
  for (std::uint64_t number = 0; number < 4; ++number) {
    const ReplicateSet made = *maker.make({2000.0, false, 500.0, 300, 0.01, 1, number}, {&conversion, 1}, [] { return false; });
    for (const auto& sums : lights) sums->add(made.front());
    joint.add(lights);
  }
  const double quantile = t_quantile(0.95, 4);
  const JointErrors errors = joint.errors(quantile);
  const RunSums& sums = *lights.front();
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
}

}  // namespace
}  // namespace sunfleck
