// Tests beams with exact answers: the cases A1 to A5 of the validation table, and checkerboards.
#include "programs/validate/known/beam_scenes.h"
#include "programs/validate/known/known_formulas.h"
#include "support/comparison.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace sunfleck::test {
namespace {

struct Answer {
  std::string what;
  Estimate got;
  double expected = 0.0;
  double largest_standard_error = 0.0;
};

void expect_all(const std::vector<Answer>& answers) {
  for (const Answer& a : answers)
    expect_agrees(a.got, a.expected, usual_replicates, a.largest_standard_error, answers.size(), a.what.c_str());
}

// A1. One triangle, no occluders, in an isolated scene. It is 0.95 m lower than in the table, which changes only the share of
// rays that meet it.
struct TriangleRow {
  double elevation_deg, azimuth_deg;
  bool upper;
  double irradiance;
  double power_m2;
  double rays;  // in the third row the sun sees only a sliver
};
constexpr std::array triangle_rows = {TriangleRow{90.0, 0.0, true, 0.83481207, 9.500000e-4, 1e6},
                                      TriangleRow{53.0176, 120.569, true, 0.42046146, 4.784770127e-4, 1e6},
                                      TriangleRow{30.0, 120.569, false, 0.11818550, 1.344928e-4, 8e6},
                                      TriangleRow{15.0, 120.569, false, 1.21861230, 1.386757e-3, 1e6},
                                      TriangleRow{5.0, 120.569, false, 5.45415590, 6.206724e-3, 1e6},
                                      TriangleRow{20.0, 270.0, true, 2.16270157, 2.461113e-3, 1e6}};

std::vector<Answer> one_triangle_answers(std::uint64_t seed, double work) {
  std::vector<Answer> answers;
  for (const TriangleRow& row : triangle_rows) {
    const RadiationModel model = triangle_under(sun_at(row.elevation_deg, row.azimuth_deg));
    const RadiationResult result = simulate(model, fixed_work(model, work * row.rays, usual_replicates, seed));
    answers.push_back(
        {"A1 h " + std::to_string(row.elevation_deg), result.organs[0].direct[0], row.irradiance, 0.001 * row.irradiance});
  }
  return answers;
}

TEST(Beam, OneTriangleTakesTheCosineOfTheSun) {
  expect_all(one_triangle_answers(1, 1.0));
}

TEST(Beam, OneTriangleIsLitOnOneSideOnly) {
  for (const TriangleRow& row : triangle_rows) {
    const RadiationModel model = triangle_under(sun_at(row.elevation_deg, row.azimuth_deg));
    const RadiationResult result = simulate(model, fixed_work(model, 1e4, 8));
    const double area = area_m2(model.canopy.corners[0]);
    EXPECT_NEAR(area, 1.137980668e-3, 1e-9);
    const BeamLandings& element = result.elements[0];
    EXPECT_EQ(result.irradiance_w_m2(row.upper ? element.lower : element.upper, area, 1.0), 0.0);
    const double lit = result.irradiance_w_m2(row.upper ? element.upper : element.lower, area, 1.0);
    EXPECT_GT(lit, 0.0);
    EXPECT_NEAR(lit, result.organs[0].direct[0].value, 1e-9 * lit);
    EXPECT_NEAR(lit * area, result.bands[0].absorbed_vegetation.value * model.plot.area_m2(), 1e-9 * lit * area);
    EXPECT_NEAR(row.irradiance * area, row.power_m2, 1e-6 * row.power_m2);
  }
}

// A3. Shadow of one plate on periodic soil.
std::vector<Answer> plate_answers(std::uint64_t seed) {
  const RadiationModel model = level_plate_case();
  const RadiationResult result = simulate(model, fixed_work(model, 4e5, usual_replicates, seed));
  const RadiationModel tilted_model = tilted_plate_case();
  const RadiationResult tilted_result = simulate(tilted_model, fixed_work(tilted_model, 4e5, usual_replicates, seed));
  return {{"A3 sunlit soil", result.bands[0].absorbed_soil, 0.88, 2e-4},
          {"A3 lit share of the plate", result.sunlit_leaf_fraction, 1.0, 2e-3},
          {"A3 shadow of a tilted plate", tilted_result.bands[0].absorbed_vegetation, 0.0605517934, 2e-4}};
}

TEST(Beam, PlateShadesPeriodicSoil) {
  expect_all(plate_answers(1));
}

// A4. Plate over plate with partial overlap, wrapped around the plot's border.
RadiationModel two_plates() {
  RadiationModel model = two_plates_case();
  model.layers = 10;
  return model;
}

std::vector<Answer> two_plates_answers(std::uint64_t seed) {
  const RadiationModel model = two_plates();
  const RadiationResult result = simulate(model, fixed_work(model, 4e5, usual_replicates, seed));
  return {{"A4 lit share of the lower plate", result.organs[1].sunlit_fraction, 0.47011006, 2e-3},
          {"A4 sunlit soil", result.bands[0].absorbed_soil, 0.76948351, 2e-4},
          {"A4 lit share of the upper plate", result.organs[0].sunlit_fraction, 1.0, 2e-3}};
}

TEST(Beam, PlateShadesPlateAcrossTheBorder) {
  expect_all(two_plates_answers(1));
}

TEST(Beam, ProfileShowsWhatPassesEachHeight) {
  const RadiationModel model = two_plates();
  const RadiationResult result = simulate(model, fixed_work(model, 4e5, usual_replicates));
  EXPECT_EQ(result.layers[10].sunfleck_ratio.value, 1.0);
  std::vector<Answer> answers;
  for (std::size_t k = 0; k <= 8; ++k) {
    EXPECT_NEAR(result.layers[k].height_m, 0.1 * static_cast<double>(k), 1e-6);
    // The lower plate lies on this border; float rounding decides which layer it falls into.
    if (k == 4) continue;
    answers.push_back(
        {"A4 through height 0." + std::to_string(k), result.layers[k].sunfleck_ratio, k > 4 ? 0.84 : 0.76948351, 2e-4});
  }
  expect_all(answers);
}

// A5. Venetian blind: one strip of width 0.8 m, its middle 0.5 m above the ground, with a period of 1 m across. It is endless
// along y because it spans the plot there, or reaches beyond it on both sides.
struct BlindRow {
  double tilt_deg, elevation_deg, azimuth_deg;
  double transmittance;
};
constexpr std::array blind_rows = {BlindRow{0, 40, 90, 0.2}, BlindRow{30, 40, 90, 0.78388111}, BlindRow{30, 40, 270, 0.0},
                                   BlindRow{1, 2, 90, 0.59994}};

RadiationModel blind(const BlindRow& row, double beyond) {
  return blind_under(sun_at(row.elevation_deg, row.azimuth_deg), row.tilt_deg, beyond);
}

std::vector<Answer> blind_answers(std::uint64_t seed) {
  std::vector<Answer> answers;
  for (const BlindRow& row : blind_rows) {
    // The value 0.59994 is rounded; the others have all their digits.
    const double towards = row.azimuth_deg == 90.0 ? 1.0 : -1.0;
    const double expected = passed_by_blind(0.8, radians(row.tilt_deg), radians(row.elevation_deg), towards);
    EXPECT_NEAR(expected, row.transmittance, 5e-6);
    for (const double beyond : {0.0, 0.9}) {
      const RadiationModel model = blind(row, beyond);
      const RadiationResult result = simulate(model, fixed_work(model, 4e5, usual_replicates, seed));
      EXPECT_EQ(result.lost_rays, 0U);
      answers.push_back({"A5 tilt " + std::to_string(row.tilt_deg) + " h " + std::to_string(row.elevation_deg),
                         result.bands[0].absorbed_soil, expected, 2e-4});
    }
  }
  return answers;
}

TEST(Beam, VenetianBlindIsEndless) {
  expect_all(blind_answers(1));
}

TEST(Beam, FullyClosedBlindLetsNothingThrough) {
  const RadiationModel model = blind(blind_rows[2], 0.0);
  EXPECT_EQ(simulate(model, fixed_work(model, 1e6, usual_replicates)).bands[0].ledger.absorbed_soil, 0);
}

// Judges the reported errors by the whole table, with separate seeds.
TEST(Beam, ErrorsOfTheWholeTableArePlausible) {
  ZScores scores(usual_replicates);
  for (std::uint64_t seed = 11; seed < 15; ++seed) {
    for (const auto& answers :
         {one_triangle_answers(seed, 0.1), plate_answers(seed), two_plates_answers(seed), blind_answers(seed)})
      for (const Answer& a : answers) scores.add(a.got, a.expected, a.what.c_str());
  }
  scores.expect_plausible();
}

TEST(Beam, CheckerboardsHalveTheBeamFromAnyDirection) {
  std::vector<Answer> answers;
  for (const auto& [elevation, azimuth] : {std::pair(90.0, 0.0), std::pair(60.0, 33.0), std::pair(53.0176, 120.569),
                                           std::pair(25.0, 270.0), std::pair(5.0, 200.0)}) {
    const RadiationModel model = checkerboards_under(sun_at(elevation, azimuth));
    const RadiationResult result = simulate(model, fixed_work(model, 8e5, usual_replicates));
    for (std::size_t layer = 0; layer < 3; ++layer) {
      const double expected = std::ldexp(1.0, -1 - static_cast<int>(layer));
      answers.push_back({"board " + std::to_string(layer) + " h " + std::to_string(elevation),
                         share_of_beam(model, result, layer), expected, 1.5e-4});
      EXPECT_NEAR(share_of_beam(model, result, layer).value, expected, 5e-4);
    }
    answers.push_back({"soil below the boards", result.bands[0].absorbed_soil, 0.125, 1.5e-4});
    EXPECT_NEAR(result.bands[0].absorbed_soil.value, 0.125, 5e-4);
  }
  expect_all(answers);
}

}  // namespace
}  // namespace sunfleck::test
