// Compares the sky's models with E1 to E4 of the validation table.

#include "support/skies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace sunfleck::test {
namespace {

TEST(Sky, EverySkyGivesOneOnTheHorizontal) {
  for (const auto& [model, sun] : many_skies()) {
    const Sky sky(model, sun);
    EXPECT_NEAR(irradiance(sky, {0, 1, 0}), 1.0, 1e-9) << model.cie_type;
    EXPECT_NEAR(integral([&](const glm::dvec3& d) { return sky.radiance(d); }), sky.spherical_irradiance(), 1e-9);
    EXPECT_FALSE(sky.is_list());
    EXPECT_EQ(sky.radiance({1, -1e-9, 0}), 0.0);
  }
}

// E1. The plane's own horizon cuts through cells, hence the tolerance is larger than 1e-9.
TEST(Sky, UniformSkyOnTiltedPlanes) {
  const Sky sky({SkyKind::uniform, 1, 0, 0, {}}, {});
  EXPECT_NEAR(sky.radiance({0, 1, 0}), 1.0 / pi, 1e-12);
  EXPECT_NEAR(sky.spherical_irradiance(), 2.0, 1e-12);
  for (const double tilt : {30.0, 60.0, 90.0, 150.0})
    for (const double azimuth : {0.0, 77.0, 200.0})
      EXPECT_NEAR(irradiance(sky, to_sky(tilt * degree, azimuth * degree)), (1.0 + std::cos(tilt * degree)) / 2.0, 1e-5);
}

TEST(Sky, OvercastSkyOnTiltedPlanes) {  // E2
  const Sky sky({SkyKind::overcast, 1, 0, 0, {}}, {});
  EXPECT_NEAR(zenith_radiance(sky), 0.409255568, 4e-5);  // the mean over a cap of one degree: 5e-5 lower at its edge
  const std::array<double, 4> tilts{30.0, 60.0, 90.0, 150.0}, expected{0.903201, 0.669427, 0.396177, 0.037176};
  for (std::size_t i = 0; i < tilts.size(); ++i)
    EXPECT_NEAR(irradiance(sky, to_sky(tilts[i] * degree, 1.0)), expected[i], 4e-5) << tilts[i];
}

struct TableRow {
  int type;
  double horizontal_by_zenith;  // under the paper's sun
  std::array<double, 4> vertical;
  double low_horizontal_by_zenith;  // sun 30 degrees high
};

TEST(Sky, StandardTypesGiveTheTable) {  // E3
  const std::vector<TableRow> table{{1, 2.44954, {0.37918, 0.37918, 0.37918, 0.37918}, 2.44954},
                                    {3, 2.76999, {0.44665, 0.44665, 0.44665, 0.44665}, 2.76999},
                                    {4, 2.47889, {0.33892, 0.49337, 0.44326, 0.31672}, 2.89015},
                                    {5, 3.14159, {0.5, 0.5, 0.5, 0.5}, 3.14159},
                                    {6, 2.77633, {0.37873, 0.54707, 0.49244, 0.35456}, 3.27783},
                                    {7, 2.77107, {0.31939, 0.56812, 0.48199, 0.29284}, 3.67305},
                                    {9, 3.74645, {0.48345, 0.68693, 0.62086, 0.45429}, 4.55275},
                                    {10, 3.68132, {0.41112, 0.70070, 0.60015, 0.38067}, 5.14491},
                                    {11, 3.67380, {0.34370, 0.71249, 0.58119, 0.31042}, 5.81763},
                                    {12, 3.94219, {0.39034, 0.78120, 0.64176, 0.35554}, 6.39411},
                                    {14, 4.15311, {0.38965, 0.89532, 0.71540, 0.34382}, 7.70810}};
  for (const TableRow& row : table) {
    const Sky sky(general(row.type), paper_sun);
    EXPECT_NEAR(zenith_radiance(sky) * row.horizontal_by_zenith, 1.0, 3e-4) << row.type;
    EXPECT_NEAR(zenith_radiance(Sky(general(row.type), low_sun)) * row.low_horizontal_by_zenith, 1.0, 3e-4) << row.type;
    for (std::size_t side = 0; side < 4; ++side)
      EXPECT_NEAR(irradiance(sky, north_east_south_west[side]), row.vertical[side], 6e-5) << row.type << ' ' << side;
  }
  const std::array<double, 4> low_clear{0.39661, 0.55904, 1.23457, 0.55904};
  for (std::size_t side = 0; side < 4; ++side)
    EXPECT_NEAR(irradiance(Sky(general(12), low_sun), north_east_south_west[side]), low_clear[side], 6e-5);
}

// Computes the standard's formula independently.
double standard_luminance(int type, const SunPosition& sun, const glm::dvec3& d) {
  struct Group {
    double a, b;
  };
  constexpr std::array<Group, 6> gradations{{{4, -0.7}, {1.1, -0.8}, {0, -1}, {-1, -0.55}, {-1, -0.32}, {-1, -0.15}}};
  struct Indicatrix {
    double c, d, e;
  };
  constexpr std::array<Indicatrix, 6> indicatrices{
      {{0, -1, 0}, {2, -1.5, 0.15}, {5, -2.5, 0.3}, {10, -3, 0.45}, {16, -3, 0.3}, {24, -2.8, 0.15}}};
  // Roman and Arabic group of each type.
  constexpr std::array<std::array<std::size_t, 2>, 15> groups{
      {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}, {2, 2}, {2, 3}, {3, 1}, {3, 2}, {3, 3}, {4, 3}, {4, 4}, {5, 4}, {5, 5}}};
  const auto [gradation, indicatrix] = groups[static_cast<std::size_t>(type - 1)];
  const auto [a, b] = gradations[gradation];
  const auto [c, fall, e] = indicatrices[indicatrix];
  const double cos_chi = std::clamp(glm::dot(d, direction_to_sun(sun)), -1.0, 1.0);
  return (1 + a * std::exp(b / d.y)) *
         (1 + c * (std::exp(fall * std::acos(cos_chi)) - std::exp(fall * pi / 2)) + e * cos_chi * cos_chi);
}

TEST(Sky, CellsKeepTheVerticalPlanesOfEveryTypeAndSun) {
  const auto onto_planes = [](const glm::dvec3& d) { return glm::max(glm::dvec4(-d.x, -d.z, d.x, d.z), 0.0); };
  for (int type = 1; type <= 15; ++type)
    for (const double elevation : {type % 2 == 0 ? 1.0 : 21.3, type % 3 == 0 ? 90.0 : 50.0}) {
      const SunPosition sun{elevation * degree, 251.7 * degree};
      const Sky sky(general(type), sun);
      const auto luminance = [&](const glm::dvec3& d) { return standard_luminance(type, sun, d); };
      const double horizontal = integral([&](const glm::dvec3& d) { return luminance(d) * d.y; });
      const glm::dvec4 expected = integral([&](const glm::dvec3& d) { return luminance(d) * onto_planes(d); }) / horizontal;
      const glm::dvec4 got = integral([&](const glm::dvec3& d) { return sky.radiance(d) * onto_planes(d); });
      for (int side = 0; side < 4; ++side)
        EXPECT_NEAR(got[side] / expected[side], 1.0, 3e-4) << type << ' ' << elevation << ' ' << side;
    }
}

TEST(Sky, AllWeatherGivesTheTable) {  // E4
  struct Row {
    double dhi, dni, clearness, brightness;
    int bin;
    std::array<double, 5> shape;
    double zenith;
    std::array<double, 4> vertical;
  };
  const std::vector<Row> table{{100,
                                850,
                                7.64093,
                                0.09150,
                                8,
                                {-0.97116, -0.17904, 20.75418, -5.7114, 1.28838},
                                0.21815,
                                {0.43355, 0.80890, 0.66418, 0.41844}},
                               {250,
                                400,
                                2.25006,
                                0.22876,
                                5,
                                {-1.05877, -0.70200, 14.05534, -3.21974, 0.01853},
                                0.26241,
                                {0.31613, 0.69144, 0.55646, 0.28457}},
                               {300,
                                5,
                                1.01302,
                                0.27451,
                                1,
                                {0.85784, -0.43884, 1.33426, -0.81891, -0.02570},
                                0.37293,
                                {0.39093, 0.47206, 0.44760, 0.37611}}};
  for (const Row& row : table) {
    const AllWeather w = all_weather(row.dni, row.dhi, paper_sun);
    EXPECT_NEAR(w.clearness, row.clearness, 2e-5);
    EXPECT_NEAR(w.brightness, row.brightness, 1e-5);
    EXPECT_EQ(w.bin, row.bin);
    const std::array<double, 5> shape{w.shape.a, w.shape.b, w.shape.c, w.shape.d, w.shape.e};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(shape[i], row.shape[i], 2e-5 * (1.0 + std::abs(row.shape[i]))) << row.bin;
    const Sky sky(all_weather_model(row.dni, row.dhi), paper_sun);
    EXPECT_NEAR(zenith_radiance(sky) / row.zenith, 1.0, 3e-4);
    for (std::size_t side = 0; side < 4; ++side)
      EXPECT_NEAR(irradiance(sky, north_east_south_west[side]), row.vertical[side], 1e-4) << row.bin << ' ' << side;
  }
}

TEST(Sky, AllWeatherIsNeverNegativeNorInfinite) {
  for (const double elevation : {-5.0, 0.0, 0.5, 3.0, 10.0, 40.0, 89.9, 90.0})
    for (const double dhi : {1e-3, 1.0, 20.0, 150.0, 500.0, 1e4})
      for (const double dni : {0.0, 10.0, 100.0, 300.0, 900.0, 1e5}) {
        const SunPosition sun{elevation * degree, 10.0 * degree};
        const AllWeather w = all_weather(dni, dhi, sun);
        EXPECT_GE(w.clearness, 1.0);
        EXPECT_LE(w.clearness, 12.01);
        EXPECT_LT(w.shape.b, 0.0);
        EXPECT_GE(1.0 + w.shape.a * std::exp(w.shape.b), -1e-12);
        const Sky sky(all_weather_model(dni, dhi), sun);
        EXPECT_TRUE(std::isfinite(sky.spherical_irradiance()));
        EXPECT_GE(sky.spherical_irradiance(), 1.0);
        for (int zenith = 0; zenith < 90; zenith += 3)
          for (int azimuth = 0; azimuth < 360; azimuth += 30)
            EXPECT_GE(sky.radiance(to_sky((zenith + 0.5) * degree, (azimuth + 0.5) * degree)), 0.0);
      }
}

TEST(Sky, FollowsTheSunWhereItShould) {
  for (int type = 1; type <= 15; ++type) {
    const bool expected = type != 1 && type != 3 && type != 5;
    EXPECT_EQ(general(type).follows_sun(), expected) << type;
    const glm::dvec3 east = to_sky(50.5 * degree, 120.5 * degree), west = to_sky(50.5 * degree, 240.5 * degree);
    const Sky sky(general(type), paper_sun);
    EXPECT_EQ(sky.radiance(east) > 1.05 * sky.radiance(west), expected) << type;
  }
  EXPECT_FALSE(SkyModel{}.follows_sun());
  EXPECT_TRUE(all_weather_model(1, 1).follows_sun());
}

TEST(Sky, TurnsWithTheSun) {
  const Sky before(general(12), SunPosition{0.7, 20.0 * degree}), after(general(12), SunPosition{0.7, 275.0 * degree});
  for (int azimuth = 0; azimuth < 360; ++azimuth)
    EXPECT_NEAR(before.radiance(to_sky(0.9, (azimuth + 0.5) * degree)), after.radiance(to_sky(0.9, (azimuth + 255.5) * degree)),
                1e-12);
}

TEST(Sky, IsContinuousAtTheZenithAndEndsAtTheHorizon) {
  const auto furthest = [](const Sky& a, const Sky& b) {
    double worst = 0.0;
    for (int row = 0; row < 90; ++row)
      for (int column = 0; column < 360; column += 5) {
        const glm::dvec3 d = to_sky((row + 0.5) * degree, (column + 0.5) * degree);
        worst = std::max(worst, std::abs(a.radiance(d) / b.radiance(d) - 1.0));
      }
    return worst;
  };
  for (const SkyModel& model : {general(12), general(15), all_weather_model(900, 80)}) {
    const Sky zenith(model, SunPosition{pi / 2.0, 0.0});
    EXPECT_LT(furthest(zenith, Sky(model, SunPosition{pi / 2.0 - 1e-7, 4.0})), 1e-5);
    EXPECT_EQ(furthest(Sky(model, SunPosition{0.0, 1.0}), Sky(model, SunPosition{-0.3, 1.0})), 0.0);
  }
}

// The mean of several skies has the mean of their radiances everywhere, and draws directions accordingly.
TEST(MeanSky, HasTheMeanRadiance) {
  const std::vector<Sky> skies{Sky(SkyModel{}, low_sun), Sky(general(12), low_sun), Sky(general(12), paper_sun)};
  const Sky mean = Sky::mean_of(skies);
  double sum = 0.0;
  for (std::size_t cell = 0; cell < std::size_t{Sky::rows} * Sky::columns; cell += 97) {
    double radiance = 0.0;
    for (const Sky& sky : skies) radiance += sky.radiance_of_cell(cell) / 3.0;
    EXPECT_NEAR(mean.radiance_of_cell(cell), radiance, 1e-12);
    sum += radiance;
  }
  EXPECT_GT(sum, 0.0);
  double spherical = 0.0;
  for (const Sky& sky : skies) spherical += sky.spherical_irradiance() / 3.0;
  EXPECT_NEAR(mean.spherical_irradiance(), spherical, 1e-12);
  const glm::dvec3 drawn = mean.draw_by_horizontal_irradiance(0.4, 0.7);
  EXPECT_EQ(mean.radiance(drawn), mean.radiance_of_cell(Sky::cell_of(drawn)));
}

}  // namespace
}  // namespace sunfleck::test
