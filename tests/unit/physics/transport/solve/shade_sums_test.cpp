// Wide sums, of many columns, get a replicate's landings while these are summed: nothing is lost, and no sum sees them too early.

#include "physics/transport/solve/shade_sums.h"

#include "physics/canopy/triangle.h"
#include "physics/transport/indirect/replicate_maker.h"
#include "support/models.h"
#include "support/scattering.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace sunfleck {
namespace {

// Leaves in so many parts that some begin with the second side of a triangle.
RadiationModel wide_light() {
  constexpr std::size_t bands = 2 * PlaceSums::least_indexed_width;
  const Plot plot{1.0, 1.0, true};
  RadiationModel model = black_model(test::random_leaves(2501, 0.0008, plot, 1.0, 3), plot, sun_at(50.0, 120.0));
  set_bands(model, bands);
  std::vector<FaceOptics> faces;
  for (std::size_t b = 0; b < bands; ++b) faces.push_back({0.02 * static_cast<double>(b), 0.3});
  for (std::size_t k = 0; k < model.optics.size(); ++k) test::set_faces(model, k, faces);
  return model;
}

class WideShadeSums : public ::testing::Test {
 protected:
  [[nodiscard]] Replicate made(std::uint64_t number) {
    return maker_.make({4000.0, false, 6000.0, 300, 0.01, 1, number}, {&conversion_, 1}, [] { return false; })->front();
  }

  // Returns the flux that a side absorbs, W.
  [[nodiscard]] double absorbed_w(std::size_t side, std::size_t band, std::int64_t quanta) const {
    return static_cast<double>(quanta) * conversion_.quanta[band].w_m2_per_quantum * model_.plot.area_m2() *
           conversion_.absorptances(model_.canopy.optics_of[side / 2], side % 2)[band];
  }

  const RadiationModel model_ = wide_light();
  const test::Prepared prepared_{model_};
  CpuTracer tracer_{prepared_.bvh, test::tracer_scene(model_)};
  ReplicateMaker maker_{{&model_, 1}, prepared_.layout, tracer_};
  const Conversion conversion_ = maker_.conversion(maker_.incidence(4000.0, false));
};

TEST_F(WideShadeSums, SeeTheLandingsOfEarlierReplicatesAlone) {
  const std::size_t bands = model_.bands.size();
  std::vector<std::int64_t> expected_landed(2 * model_.canopy.size() * bands);
  PlaceSums landed;
  for (std::uint64_t number = 0; number < 4; ++number) {
    const Replicate replicate = made(number);
    const std::vector<std::int64_t> own = replicate.packets->side_landed.all();
    std::vector<double> squares(bands);
    for (std::size_t side = 0; side < 2 * model_.canopy.size(); ++side) {
      const std::size_t other = side ^ 1U;
      for (std::size_t b = 0; b < bands; ++b) {
        const double earlier_w =
            absorbed_w(side, b, expected_landed[side * bands + b]) + absorbed_w(other, b, expected_landed[other * bands + b]);
        squares[b] += absorbed_w(side, b, own[side * bands + b]) * earlier_w / area_m2(model_.canopy.corners[side / 2]);
      }
    }
    const ShadeGroupSums sums = sum_shade_and_add(conversion_, replicate, true, landed);
    for (std::size_t b = 0; b < bands; ++b) {
      EXPECT_NEAR(sums.leaves.indirect_square[b], squares[b], 1e-10 * squares[b]) << number;
      EXPECT_EQ(squares[b] > 0.0, number > 0);
    }
    for (std::size_t k = 0; k < own.size(); ++k) expected_landed[k] += own[k];
    EXPECT_EQ(landed.all(), expected_landed);
  }
}

}  // namespace
}  // namespace sunfleck
