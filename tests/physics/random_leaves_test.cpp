// Tests leaves placed at random: the mean share of the beam that passes over many scenes, and how much it scatters (A6 and A7
// of the validation table).
#include "support/comparison.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace sunfleck::test {
namespace {

constexpr double pi = std::numbers::pi;

// Angle between a leaf's normal and the vertical, drawn from a leaf angle distribution.
using Inclination = std::function<double(Random&)>;

Inclination fixed(double inclination_deg) {
  return [=](Random&) { return radians(inclination_deg); };
}

double spherical(Random& random) {
  return std::acos(random.uniform());
}

// Draws by rejection from the density 2/pi (1 + sign cos 2 theta), theta in 0..pi/2: planophile with sign 1, erectophile with
// -1.
Inclination de_wit(double sign) {
  return [=](Random& random) {
    while (true) {
      const double theta = random.uniform(0.0, pi / 2.0);
      if (2.0 * random.uniform() < 1.0 + sign * std::cos(2.0 * theta)) return theta;
    }
  };
}

// Draws by exponential waiting times (Knuth 1969, The Art of Computer Programming 2, 3.4.1).
int poisson(Random& random, double mean) {
  int count = -1;
  for (double sum = 0.0; sum < mean; ++count) sum -= std::log(1.0 - random.uniform());
  return count;
}

struct Leaves {
  double area_m2;
  int corners;
  Inclination inclination;
  double height_m;
};

// Returns `count` leaves over a plot of 1 m2.
Mesh scattered(const Leaves& leaves, int count, Random& random) {
  MeshMaker maker;
  for (int leaf = 0; leaf < count; ++leaf) {
    const double x_m = random.uniform();
    const double y_m = random.uniform(0.1, 0.1 + leaves.height_m);
    const double z_m = random.uniform();
    const glm::dvec3 normal = inclined(leaves.inclination(random), random.uniform(0.0, 2.0 * pi));
    maker.polygon({x_m, y_m, z_m}, normal, leaves.area_m2, leaves.corners, random.uniform(0.0, 2.0 * pi));
  }
  return maker.mesh();
}

struct Scatter {
  ReplicateMean passed;        // share of the beam that reaches the soil, one value per scene
  ReplicateMean sunlit_index;  // sunlit leaf area per ground area
  ReplicateMean noise;         // squared standard error within a scene
};

Scatter simulate_scenes(const Leaves& leaves, const std::function<int(Random&)>& count, int scenes, double rays,
                        std::uint32_t seed) {
  Scatter scatter;
  for (int scene = 0; scene < scenes; ++scene) {
    Random random(seed + static_cast<std::uint32_t>(scene));
    const RadiationModel model = black_model(scattered(leaves, count(random), random), {}, beijing_sun());
    const RadiationResult result = simulate(model, fixed_work(model, rays, 8, seed + static_cast<std::uint32_t>(scene)));
    scatter.passed.add(result.bands[0].absorbed_soil.value);
    scatter.sunlit_index.add(result.sunlit_leaf_fraction.value * result.leaf_area_index);
    const double error = standard_error(result.bands[0].absorbed_soil, 8);
    scatter.noise.add(error * error);
  }
  return scatter;
}

// A6. If the number of leaves is drawn from Poisson's distribution, exp(-K L) is the exact expectation.
struct Extinction {
  const char* what;
  Inclination inclination;
  double projection;  // G at the paper sun's zenith angle, 36.9824 degrees
};

TEST(RandomLeaves, BeerNilsonExtinctionOfEveryLeafAngleDistribution) {
  const double cosine = std::cos(radians(36.9824));
  const std::array rows = {Extinction{"spherical", spherical, 0.5},
                           Extinction{"horizontal", fixed(0.0), cosine},
                           Extinction{"vertical", fixed(90.0), 0.382971},
                           Extinction{"planophile", de_wit(1.0), 0.684976},
                           Extinction{"erectophile", de_wit(-1.0), 0.463769},
                           Extinction{"inclination 15", fixed(15.0), 0.771601},
                           Extinction{"inclination 30", fixed(30.0), 0.691799},
                           Extinction{"inclination 45", fixed(45.0), 0.564851},
                           Extinction{"inclination 60", fixed(60.0), 0.435083},
                           Extinction{"inclination 75", fixed(75.0), 0.393595}};
  constexpr double leaf_m2 = 0.0025;
  constexpr int scenes = 150;
  std::uint32_t seed = 1;
  for (const Extinction& row : rows) {
    const Leaves leaves{leaf_m2, 4, row.inclination, 2.0};
    const Scatter got = simulate_scenes(
        leaves, [](Random& random) { return poisson(random, 1.0 / leaf_m2); }, scenes, 4096, seed);
    expect_agrees(estimate_of(got.passed), std::exp(-row.projection / cosine), scenes, 0.003, rows.size(), row.what);
    seed += scenes;
  }
}

// Compares T_0 and the sunlit leaf area index at the paper sun with the table.
TEST(RandomLeaves, PassedAndSunlitByLeafAreaIndex) {
  struct Row {
    const char* what;
    Inclination inclination;
    double index, passed, sunlit;
  };
  const std::array rows = {
      Row{"spherical 0.5", spherical, 0.5, 0.731278, 0.429321},   Row{"spherical 3", spherical, 3.0, 0.152931, 1.353312},
      Row{"horizontal 0.5", fixed(0.0), 0.5, 0.606531, 0.393469}, Row{"horizontal 3", fixed(0.0), 3.0, 0.049787, 0.950213},
      Row{"vertical 0.5", fixed(90.0), 0.5, 0.786856, 0.444587},  Row{"vertical 3", fixed(90.0), 3.0, 0.237340, 1.590795}};
  constexpr double leaf_m2 = 0.0025;
  constexpr int scenes = 100;
  std::uint32_t seed = 100001;
  for (const Row& row : rows) {
    // The canopy is tall, so that it matters little how far leaves of different inclination extend above and below their
    // centres.
    const Leaves leaves{leaf_m2, 4, row.inclination, 5.0};
    const auto count = [&](Random& random) { return poisson(random, row.index / leaf_m2); };
    const Scatter got = simulate_scenes(leaves, count, scenes, 4096, seed);
    expect_agrees(estimate_of(got.passed), row.passed, scenes, 0.003, 2 * rows.size(), row.what);
    expect_agrees(estimate_of(got.sunlit_index), row.sunlit, scenes, 0.015, 2 * rows.size(), row.what);
    seed += scenes;
  }
}

// A7. With a fixed number of leaves, expectation and spread are exact for that number.
TEST(RandomLeaves, FiniteNumberOfDiscs) {
  struct Row {
    const char* what;
    Inclination inclination;
    int count;
    double passed;
    double spread;        // spread of one scene; 0 where the table has none
    double sunlit_share;  // sunlit share of the leaf area
  };
  const std::array rows = {Row{"127 horizontal discs", fixed(0.0), 127, 0.367367, 0.01727, 0.634247},
                           Row{"382 horizontal discs", fixed(0.0), 382, 0.049190, 0.00899, 0.316913},
                           Row{"382 spherical discs", spherical, 382, 0.152203, 0.0, 0.0}};
  constexpr int scenes = 200;
  std::uint32_t seed = 200001;
  for (const Row& row : rows) {
    const Leaves discs{pi * 0.05 * 0.05, 8, row.inclination, 1.0};
    const Scatter got = simulate_scenes(
        discs, [&](Random&) { return row.count; }, scenes, 8192, seed);
    seed += scenes;
    const double per_scene = got.passed.standard_error() * std::sqrt(double{scenes});
    EXPECT_LE(std::abs(got.passed.mean() - row.passed), 3.0 * got.passed.standard_error()) << row.what;
    expect_agrees(estimate_of(got.passed), row.passed, scenes, 0.0015, 5, row.what);
    const double spread = std::sqrt(per_scene * per_scene - got.noise.mean());
    std::printf("%s: spread %.5f, expected %.5f; sampling noise %.5f\n", row.what, spread, row.spread,
                std::sqrt(got.noise.mean()));
    if (row.spread == 0.0) continue;
    EXPECT_NEAR(spread, row.spread, 0.15 * row.spread) << row.what;
    const double index = row.count * discs.area_m2;
    expect_agrees(estimate_of(got.sunlit_index), row.sunlit_share * index, scenes, 0.0015, 5, "sunlit leaf area");
  }
}

}  // namespace
}  // namespace sunfleck::test
