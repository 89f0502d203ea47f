// Compares directions drawn from a sky with its radiance.

#include "base/error.h"
#include "support/skies.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <random>

namespace sunfleck::test {
namespace {

// Locates a draw by the areas of the square degrees and their radiance.
struct Square {
  double u, v;
};

template <class Share>
// `below` returns the share of a uniform sky that lies within a zenith angle.
Square inverse(const Sky& sky, const glm::dvec3& d, const Share& below) {
  const auto radiance = [&](int row, int column) {
    return sky.radiance(to_sky((row + 0.5) * row_height, (column + 0.5) * column_width));
  };
  const double zenith = std::atan2(std::hypot(d.x, d.z), d.y);
  double azimuth = std::atan2(-d.z, -d.x);
  if (azimuth < 0.0) azimuth += 2.0 * pi;
  const int row_of = std::min(static_cast<int>(zenith / row_height), Sky::rows - 1);
  const int column_of = std::min(static_cast<int>(azimuth / column_width), Sky::columns - 1);
  double under = 0.0, total = 0.0, before = 0.0, ring_of = 0.0;
  for (int row = 0; row < Sky::rows; ++row) {
    double ring = 0.0;
    for (int column = 0; column < Sky::columns; ++column) {
      const double value = radiance(row, column);
      if (row == row_of && column < column_of) before += value;
      ring += value;
    }
    const double whole = below((row + 1) * row_height) - below(row * row_height);
    if (row < row_of) under += ring * whole;
    if (row == row_of) under += ring * (below(zenith) - below(row * row_height));
    if (row == row_of) ring_of = ring;
    total += ring * whole;
  }
  return {under / total, (before + (azimuth / column_width - column_of) * radiance(row_of, column_of)) / ring_of};
}

TEST(Sky, DrawsGoThereAndBack) {
  for (const SkyModel& model : {general(5), general(15), all_weather_model(850, 100)}) {
    const Sky sky(model, paper_sun);
    for (const double u : {0.0, 1e-7, 0.123, 0.5, 0.77, 0.999, 1.0 - 1e-5})
      for (const double v : {0.0, 0.31, 0.6180, 0.9999}) {
        const glm::dvec3 by_irradiance = sky.draw_by_horizontal_irradiance(u, v), by_radiance = sky.draw_by_radiance(u, v);
        EXPECT_NEAR(glm::length(by_irradiance), 1.0, 1e-14);
        EXPECT_GE(by_irradiance.y, least_sky_sine);
        EXPECT_GE(by_radiance.y, least_sky_sine);
        const Square back = inverse(sky, by_irradiance, [](double zenith) { return std::pow(std::sin(zenith), 2); });
        EXPECT_NEAR(back.u, u, 1e-10);
        if (u > 0.0) {  // the zenith itself has no azimuth
          EXPECT_NEAR(back.v, v, 1e-9);
        }
        const Square plain = inverse(sky, by_radiance, [](double zenith) { return 1.0 - std::cos(zenith); });
        EXPECT_NEAR(plain.u, u, 1e-10);
      }
  }
}

// Returns Pearson's chi-square of drawn directions in patches of 10 by 30 degrees; the radiance gives the expectations.
template <class Draw, class Density>
void expect_distributed(const Draw& draw, const Density& density) {
  constexpr int patches = 9 * 12, draws = 200'000;
  std::vector<double> expected(patches, 0.0);
  std::vector<int> counted(patches, 0);
  const auto patch = [](const glm::dvec3& d) {
    const int row = std::min(8, static_cast<int>(std::acos(std::min(1.0, d.y)) / (10.0 * degree)));
    const double azimuth = std::atan2(-d.z, -d.x) / degree;
    return static_cast<std::size_t>(12 * row + std::min(11, static_cast<int>((azimuth < 0 ? azimuth + 360 : azimuth) / 30.0)));
  };
  const double total = integral([&](const glm::dvec3& d) {
    expected[patch(d)] += density(d) * std::sqrt(1.0 - d.y * d.y);
    return density(d);
  });
  EXPECT_GT(total, 0.0);
  double scale = 0.0;
  for (const double value : expected) scale += value;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < draws; ++i) {
    const double u = uniform(random), v = uniform(random);
    ++counted[patch(draw(u, v))];
  }
  double chi_square = 0.0;
  for (std::size_t i = 0; i < patches; ++i) {
    const double mean = expected[i] / scale * draws;
    chi_square += (counted[i] - mean) * (counted[i] - mean) / mean;
  }
  const boost::math::chi_squared law(patches - 1);
  EXPECT_GE(chi_square, boost::math::quantile(law, 1e-4));
  EXPECT_LE(chi_square, boost::math::quantile(boost::math::complement(law, 1e-4)));
}

TEST(Sky, DrawsStayAboveTheHorizon) {
  const Sky sky(general(5), paper_sun);
  const double last = std::nextafter(1.0, 0.0);
  EXPECT_EQ(sky.draw_by_radiance(last, last).y, least_sky_sine);
  EXPECT_GE(sky.draw_by_horizontal_irradiance(last, last).y, least_sky_sine);
  EXPECT_NEAR(glm::length(sky.draw_by_radiance(last, last)), 1.0, 1e-15);
}

TEST(Sky, DrawsFollowTheirDensities) {
  for (const SkyModel& model : {general(1), general(12), all_weather_model(850, 100)}) {
    const Sky sky(model, paper_sun);
    expect_distributed([&](double u, double v) { return sky.draw_by_horizontal_irradiance(u, v); },
                       [&](const glm::dvec3& d) { return sky.radiance(d) * d.y; });
    expect_distributed([&](double u, double v) { return sky.draw_by_radiance(u, v); },
                       [&](const glm::dvec3& d) { return sky.radiance(d); });
  }
}

TEST(Sky, MeansOverDrawsAreIntegrals) {
  const Sky sky(general(14), paper_sun);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  constexpr int draws = 100'000;
  for (const glm::dvec3& normal : north_east_south_west) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < draws; ++i) {
      const double u = uniform(random), v = uniform(random);
      const double value = std::max(0.0, glm::dot(normal, sky.draw_by_radiance(u, v))) * sky.spherical_irradiance();
      sum += value;
      squares += value * value;
    }
    const double mean = sum / draws;
    const double standard_error = std::sqrt((squares / draws - mean * mean) / draws);
    EXPECT_NEAR(mean, irradiance(sky, normal), 4.0 * standard_error);
  }
}

TEST(Sky, ListsOfDirectionsKeepTheirWeights) {
  SkyModel model{SkyKind::lights, 1, 0, 0, {}};
  model.lights = {{2.0, to_sky(0.0, 0.0)}, {0.0, to_sky(0.3, 0.0)}, {6.0, to_sky(60.0 * degree, 1.0)}};
  const Sky sky(model, {});
  ASSERT_TRUE(sky.is_list());
  ASSERT_EQ(sky.lights().size(), 2U);  // a light without weight is ignored
  EXPECT_DOUBLE_EQ(sky.lights()[0].weight, 0.25);
  EXPECT_DOUBLE_EQ(sky.lights()[1].weight, 0.75);
  EXPECT_NEAR(sky.spherical_irradiance(), 0.25 + 0.75 / 0.5, 1e-12);
  int by_irradiance = 0, by_radiance = 0;
  constexpr int draws = 7000;
  for (int i = 0; i < draws; ++i) {
    by_irradiance += sky.draw_by_horizontal_irradiance((i + 0.5) / draws, 0.5).y > 0.9 ? 1 : 0;
    by_radiance += sky.draw_by_radiance((i + 0.5) / draws, 0.5).y > 0.9 ? 1 : 0;
  }
  EXPECT_EQ(by_irradiance, draws / 4);
  EXPECT_EQ(by_radiance, draws / 7);  // a share of 0.25 in 1.75
}

TEST(Sky, AListWithoutWeightIsRefused) {
  SkyModel model{SkyKind::lights, 1, 0, 0, {{0.0, {0, 1, 0}}}};
  EXPECT_THROW(Sky(model, {}), Error);
  model.lights.clear();
  EXPECT_THROW(Sky(model, {}), Error);
}

}  // namespace
}  // namespace sunfleck::test
