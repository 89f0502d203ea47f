// Tests whether the reported errors are true, with seeds 1 to 400 on a small scene whose answer is known (G2 of the validation
// table).
#include "support/coverage.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace sunfleck::test {
namespace {

const SunPosition high_sun = sun_at(60.0, 75.0);

// Returns four tilted leaves whose shadows do not overlap, one organ each.
RadiationModel tilted_leaves() {
  MeshMaker maker;
  int rank = 1;
  for (const auto& [x, z, inclination, angle] : {std::array{0.2, 0.2, 20.0, 40.0}, std::array{0.25, 0.75, 50.0, 130.0},
                                                 std::array{0.75, 0.3, 35.0, 250.0}, std::array{0.7, 0.8, 60.0, 310.0}}) {
    maker.organ("leaf", 1, rank++);
    maker.polygon({x, 0.3, z}, inclined(radians(inclination), radians(angle)), 0.1, 4, radians(10.0 * rank));
  }
  return black_model(maker.mesh(), {}, high_sun);
}

// Returns the area that a leaf in full sun shades on level ground.
double shadow_m2(const Canopy& canopy, std::uint32_t organ) {
  double sum = 0.0;
  const glm::dvec3 to_sun = direction_to_sun(high_sun);
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    if (canopy.organ_of[e] != organ) continue;
    sum += area_m2(canopy.corners[e]) * std::abs(glm::dot(unit_normal(canopy.corners[e]), to_sun)) / to_sun.y;
  }
  return sum;
}

struct Counted {
  const char* what;
  std::function<Estimate(const RadiationResult&)> estimate;
  double truth;
  int covered = 0;
};

std::vector<Counted> counted_aggregates(const RadiationModel& model) {
  std::vector<Counted> counted;
  double vegetation = 0.0;
  for (std::uint32_t organ = 0; organ < 4; ++organ) {
    const double shadow = shadow_m2(model.canopy, organ);
    vegetation += shadow;
    if (organ > 1) continue;
    counted.push_back({organ == 0 ? "first leaf" : "second leaf",
                       [&model, organ](const RadiationResult& r) { return share_of_beam(model, r, organ); }, shadow});
  }
  counted.push_back({"vegetation", [](const RadiationResult& r) { return r.bands[0].absorbed_vegetation; }, vegetation});
  counted.push_back({"soil", [](const RadiationResult& r) { return r.bands[0].absorbed_soil; }, 1.0 - vegetation});
  counted.push_back({"sunlit leaf area", [](const RadiationResult& r) { return r.sunlit_leaf_fraction; }, 1.0});
  return counted;
}

void expect_covered(const char* mode, const std::function<SolveSettings(const RadiationModel&)>& settings_of) {
  const RadiationModel model = tilted_leaves();
  const Prepared prepared(model);
  std::vector<Counted> counted = counted_aggregates(model);
  ReplicateMean replicates;
  for (std::uint64_t seed = 1; seed <= coverage_seeds; ++seed) {
    SolveSettings settings = settings_of(model);
    settings.seed = seed;
    const RadiationResult result = simulate(model, prepared, settings);
    replicates.add(static_cast<double>(result.direct.replicates));
    for (Counted& aggregate : counted) {
      const Estimate got = aggregate.estimate(result);
      aggregate.covered += std::abs(got.value - aggregate.truth) <= got.half_width ? 1 : 0;
    }
  }
  for (const Counted& aggregate : counted) {
    std::printf("%s, %.1f replicates on average: %s covered %d of %d times\n", mode, replicates.mean(), aggregate.what,
                aggregate.covered, coverage_seeds);
    EXPECT_GE(aggregate.covered, least_covered) << mode << ", " << aggregate.what;
    EXPECT_LE(aggregate.covered, most_covered) << mode << ", " << aggregate.what;
  }
}

TEST(Coverage, LeavesAreAllInFullSun) {
  const RadiationModel model = tilted_leaves();
  double shadows = 0.0;
  for (std::uint32_t organ = 0; organ < 4; ++organ) shadows += shadow_m2(model.canopy, organ);
  const RadiationResult result = simulate(model, fixed_work(model, 4e6));
  expect_agrees(result.bands[0].absorbed_vegetation, shadows, 32, 4e-5, 1, "shadow of all leaves");
}

TEST(Coverage, RunToTheDefaultBound) {
  expect_covered("bound 0.001", [](const RadiationModel&) { return SolveSettings{}; });
}

TEST(Coverage, RunToACoarseBound) {
  expect_covered("bound 0.01", [](const RadiationModel&) {
    SolveSettings settings;
    settings.accuracy.direct = 0.01;
    return settings;
  });
}

TEST(Coverage, EightReplicates) {
  expect_covered("fixed work", [](const RadiationModel& model) { return fixed_work(model, 8000.0, 8); });
}

TEST(Coverage, SixteenReplicates) {
  expect_covered("fixed work", [](const RadiationModel& model) { return fixed_work(model, 16000.0, 16); });
}

// Jittered cells beat plain random rays (slope -0.5): for shadow edges theory gives -0.75 (G3).
TEST(Coverage, ErrorFallsFasterThanRandom) {
  const RadiationModel model = tilted_leaves();
  const Prepared prepared(model);
  const std::vector<Counted> counted = counted_aggregates(model);
  const Counted& vegetation = counted[2];
  constexpr int steps = 6;
  ReplicateMean mean_x, mean_y;
  std::vector<std::pair<double, double>> points;
  for (int step = 0; step < steps; ++step) {
    const double rays = 8.0 * 32.0 * std::pow(4.0, step);
    double squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
      const Estimate got = vegetation.estimate(simulate(model, prepared, fixed_work(model, rays, 8, seed)));
      squares += (got.value - vegetation.truth) * (got.value - vegetation.truth);
    }
    const double error = std::sqrt(squares / 64.0);
    std::printf("%9.0f rays: error %.3e\n", rays, error);
    points.emplace_back(std::log(rays), std::log(error));
    mean_x.add(points.back().first);
    mean_y.add(points.back().second);
  }
  double above = 0.0;
  double below = 0.0;
  for (const auto& [x, y] : points) {
    above += (x - mean_x.mean()) * (y - mean_y.mean());
    below += (x - mean_x.mean()) * (x - mean_x.mean());
  }
  std::printf("slope of log error against log rays: %.3f\n", above / below);
  EXPECT_LE(above / below, -0.68);
}

}  // namespace
}  // namespace sunfleck::test
