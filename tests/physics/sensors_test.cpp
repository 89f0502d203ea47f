// Tests sensors: rays followed backwards must give the values of closed forms.
#include "physics/transport/receivers/sensors.h"

#include "physics/light/sky.h"
#include "support/leaf_scenes.h"
#include "support/scattering.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr int sensor_replicates = 16;
const glm::dvec3 up{0, 1, 0}, down{0, -1, 0};

SensorSettings settings_of(std::uint32_t rays, std::uint64_t seed = 1) {
  return {rays, sensor_replicates, seed, 0.95};
}

Sensor cosine_sensor(const glm::dvec3& point_m, const glm::dvec3& normal) {
  return {"", {point_m}, SensorResponse::cosine, normal};
}

Sensor sphere(const glm::dvec3& point_m) {
  return {"", {point_m}, SensorResponse::spherical, up};
}

// Returns the only reading of each sensor.
std::vector<SensorResult> read(const RadiationModel& model, const SensorSettings& settings, CpuWalk walk = CpuWalk::tree) {
  const Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, tracer_scene(model), walk);
  const auto got = measure_sensors(model, prepared.layout, tracer, settings, {});
  std::vector<SensorResult> readings;
  for (const auto& points : got.value().points) readings.insert(readings.end(), points.begin(), points.end());
  return readings;
}

void give_sky(RadiationModel& model, double diffuse_w_m2, const SkyModel& sky = {}) {
  model.sky = sky;
  for (Waveband& band : model.bands) band.diffuse_w_m2 = diffuse_w_m2;
}

RadiationModel bare_ground(double soil_reflectance) {
  RadiationModel model = black_model(MeshMaker().mesh(), unit_plot, beijing_sun());
  model.soil->reflectance = {soil_reflectance};
  return model;
}

void expect_exactly(const Estimate& got, double expected, const char* what) {
  EXPECT_NEAR(got.value, expected, 1e-12 * (1.0 + expected)) << what;
  EXPECT_NEAR(got.half_width, 0.0, 1e-12) << what;
}

// Expects the same of sampled light on which all rays agree: the half-width is as small as their number allows, if one ray adds
// at most `largest` to a replicate.
void expect_agreed(const Estimate& got, double expected, double largest, const char* what) {
  EXPECT_NEAR(got.value, expected, 1e-12 * (1.0 + expected)) << what;
  EXPECT_GT(got.half_width, 0.0) << what;
  EXPECT_LE(got.half_width, unseen_events(0.95) * largest / sensor_replicates * (1.0 + 1e-9)) << what;
}

TEST(Sensors, AboveABlackCanopyTheyReadWhatComesIn) {
  for (const bool periodic : {true, false}) {
    RadiationModel model = black_model(random_leaves(60, 0.02, unit_plot, 1.0, 3), {1.0, 1.0, periodic}, beijing_sun());
    give_sky(model, 0.7, {SkyKind::general, 12, 0.0, 0.0, {}});
    const glm::dvec3 to_sun = direction_to_sun(beijing_sun()), away = -to_sun;
    model.sensors = {cosine_sensor({0.4, 1.5, 0.3}, up), cosine_sensor({0.4, 1.5, 0.3}, to_sun), sphere({0.4, 1.5, 0.3}),
                     cosine_sensor({0.4, 1.5, 0.3}, away)};
    const std::vector<SensorResult> got = read(model, settings_of(64));
    ASSERT_EQ(got.size(), 4U);
    const double normal_w_m2 = 1.0 / std::sin(beijing_sun().elevation_rad);
    expect_exactly(got[0].direct[0], 1.0, "level");
    expect_agreed(got[0].sky[0], 0.7, 0.7 / 64.0, "sky on a level plane");
    expect_exactly(got[1].direct[0], normal_w_m2, "facing the sun");
    expect_exactly(got[2].direct[0], normal_w_m2, "sphere");
    const double on_sphere_w_m2 = 0.7 * Sky(*model.sky, *model.sun).spherical_irradiance();
    expect_agreed(got[2].sky[0], on_sphere_w_m2, on_sphere_w_m2 / 64.0, "sky on a sphere");
    expect_exactly(got[3].direct[0], 0.0, "facing away");
    for (const SensorResult& reading : got) expect_exactly(reading.scattered[0], 0.0, "nothing scatters");
  }
}

TEST(Sensors, UnderAPlateThatCoversAllTheyReadNothing) {
  MeshMaker maker;
  maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
  RadiationModel model = black_model(maker.mesh(), unit_plot, beijing_sun());
  give_sky(model, 1.0);
  model.soil->reflectance = {0.5};
  model.sensors = {cosine_sensor({0.3, 0.2, 0.3}, up), sphere({0.3, 0.2, 0.3}), cosine_sensor({0.3, 0.2, 0.3}, down)};
  const std::vector<SensorResult> got = read(model, settings_of(256));
  const double spherical = Sky(*model.sky, *model.sun).spherical_irradiance();
  const double brightest_w_m2 = 0.5 * (1.0 / std::sin(beijing_sun().elevation_rad) + spherical);
  for (const SensorResult& reading : got) {
    expect_exactly(reading.direct[0], 0.0, "dark");
    expect_agreed(reading.scattered[0], 0.0, 4.0 * brightest_w_m2 / 256.0, "dark");
  }
  for (const std::size_t sensor : {0, 1}) expect_agreed(got[sensor].sky[0], 0.0, spherical / 256.0, "dark");
  expect_exactly(got[2].sky[0], 0.0, "no sky below the horizon");
}

TEST(Sensors, UprightOnesReadTheTableOfSkies) {  // validation.md E1 to E4
  struct Row {
    SkyModel sky;
    std::array<double, 4> north_east_south_west;
  };
  const auto general = [](int type) { return SkyModel{SkyKind::general, type, 0.0, 0.0, {}}; };
  const std::vector<Row> table{{{SkyKind::uniform, 1, 0, 0, {}}, {0.5, 0.5, 0.5, 0.5}},
                               {{SkyKind::overcast, 1, 0, 0, {}}, {0.396177, 0.396177, 0.396177, 0.396177}},
                               {general(1), {0.37918, 0.37918, 0.37918, 0.37918}},
                               {general(3), {0.44665, 0.44665, 0.44665, 0.44665}},
                               {general(4), {0.33892, 0.49337, 0.44326, 0.31672}},
                               {general(6), {0.37873, 0.54707, 0.49244, 0.35456}},
                               {general(7), {0.31939, 0.56812, 0.48199, 0.29284}},
                               {general(9), {0.48345, 0.68693, 0.62086, 0.45429}},
                               {general(10), {0.41112, 0.70070, 0.60015, 0.38067}},
                               {general(11), {0.34370, 0.71249, 0.58119, 0.31042}},
                               {general(12), {0.39034, 0.78120, 0.64176, 0.35554}},
                               {general(14), {0.38965, 0.89532, 0.71540, 0.34382}},
                               {{SkyKind::all_weather, 1, 850, 100, {}}, {0.43355, 0.80890, 0.66418, 0.41844}}};
  RadiationModel model = bare_ground(0.0);
  for (const glm::dvec3& normal :
       {from_east_north_up(0, 1, 0), from_east_north_up(1, 0, 0), from_east_north_up(0, -1, 0), from_east_north_up(-1, 0, 0)})
    model.sensors.push_back(cosine_sensor({0.5, 0.5, 0.5}, normal));
  for (const Row& row : table) {
    give_sky(model, 1.0, row.sky);
    const std::vector<SensorResult> got = read(model, settings_of(4096));
    for (std::size_t side = 0; side < 4; ++side) {
      const double error = standard_error(got[side].sky[0], sensor_replicates);
      EXPECT_LE(error, 3e-4);
      // Tolerates 1e-4 for the sky's cells and the table's last digit.
      EXPECT_NEAR(got[side].sky[0].value, row.north_east_south_west[side],
                  table_quantile(4 * table.size(), sensor_replicates) * error + 1e-4)
          << row.sky.cie_type << ' ' << side;
    }
  }
}

// The radiance from below is rho E / pi everywhere.
TEST(Sensors, SunlitSoilShinesBack) {
  RadiationModel model = bare_ground(0.3);
  give_sky(model, 0.5);
  model.sensors = {cosine_sensor({0.4, 0.7, 0.3}, down), cosine_sensor({0.4, 0.7, 0.3}, {0, 0, 1}), sphere({0.4, 0.7, 0.3}),
                   cosine_sensor({0.4, 0.7, 0.3}, up)};
  const std::vector<SensorResult> got = read(model, settings_of(4096));
  expect_agrees(got[0].scattered[0], 0.45, sensor_replicates, 1e-3, 4, "facing down");
  expect_agrees(got[1].scattered[0], 0.45 / 2.0, sensor_replicates, 1e-3, 4, "upright");
  expect_agrees(got[2].scattered[0], 0.45 * 2.0, sensor_replicates, 2e-3, 4, "sphere");
  const double from_beam_w_m2 = 0.3 / std::sin(beijing_sun().elevation_rad);
  const double from_sky_w_m2 = 0.3 * 0.5 * Sky(*model.sky, *model.sun).spherical_irradiance();
  expect_agreed(got[3].scattered[0], 0.0, (from_beam_w_m2 + from_sky_w_m2) / 4096.0, "facing up");
  give_sky(model, 0.0);
  expect_agreed(read(model, settings_of(64))[0].scattered[0], 0.3, from_beam_w_m2 / 64.0, "of the beam alone");
}

TEST(Sensors, BareSoilPlaneEndsAtAnIsolatedPlot) {
  RadiationModel model = bare_ground(0.4);
  model.plot.periodic = false;
  model = black_model(MeshMaker().mesh(), model.plot, beijing_sun());
  model.soil->reflectance = {0.4};
  model.sensors = {cosine_sensor({0.5, 0.25, 0.5}, down)};
  // Four times the view factor from a point to a rectangle with a corner below it (Siegel & Howell); a side is twice the
  // height.
  const double x = 2.0, root = std::sqrt(1.0 + x * x);
  const double factor = 4.0 / (2.0 * std::numbers::pi) * 2.0 * (x / root * std::atan(x / root));
  expect_agrees(read(model, settings_of(4096))[0].scattered[0], 0.4 * factor, sensor_replicates, 1e-3, 1, "ground seen");
}

// A plate with two different faces lies over soil: light goes to and fro below it.
TEST(Sensors, AboveAndBelowAPlate) {
  struct Case {
    FaceOptics top, bottom;
    double soil;
  };
  const std::vector<Case> cases{
      {{0.12, 0.06}, {0.12, 0.06}, 0.15}, {{0.45, 0.45}, {0.45, 0.45}, 0.20}, {{0.3, 0.1}, {0.05, 0.55}, 0.4}};
  MeshMaker maker;
  maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
  RadiationModel model = black_model(maker.mesh(), unit_plot, beijing_sun());
  set_bands(model, cases.size());
  for (std::size_t b = 0; b < cases.size(); ++b) {
    model.optics[0].upper[b] = cases[b].top;
    model.optics[0].lower[b] = cases[b].bottom;
    model.soil->reflectance[b] = cases[b].soil;
  }
  model.sensors = {cosine_sensor({0.3, 0.25, 0.6}, up), cosine_sensor({0.3, 0.25, 0.6}, down),
                   cosine_sensor({0.3, 0.75, 0.6}, down), cosine_sensor({0.3, 0.5, 0.6}, down),
                   cosine_sensor({0.9, 0.0, 0.9}, up)};
  for (const double diffuse : {0.0, 0.6}) {
    give_sky(model, diffuse);
    const std::vector<SensorResult> got = read(model, settings_of(8192, 5));
    for (std::size_t b = 0; b < cases.size(); ++b) {
      const auto& [top, bottom, soil] = cases[b];
      const double below = (1.0 + diffuse) * top.transmittance / (1.0 - soil * bottom.reflectance);
      const double back = (1.0 + diffuse) * top.reflectance + soil * below * bottom.transmittance;
      const auto agrees = [&](std::size_t sensor, double expected, const char* what) {
        expect_agrees(got[sensor].scattered[b], expected, sensor_replicates, 3e-3, 30, what);
        expect_exactly(got[sensor].direct[b], 0.0, what);
      };
      agrees(0, below, "below the plate, facing up");
      agrees(1, soil * below, "below the plate, facing down");
      agrees(2, back, "above the plate, facing down");
      agrees(3, soil * below, "on the plate's lower side");
      agrees(4, below, "on the soil");
    }
  }
}

double rectangle_factor(double width_m, double depth_m, double distance_m) {  // centred over the point
  const double x = width_m / 2.0 / distance_m, y = depth_m / 2.0 / distance_m;
  const double a = std::sqrt(1.0 + x * x), b = std::sqrt(1.0 + y * y);
  return 4.0 / (2.0 * std::numbers::pi) * (x / a * std::atan(y / a) + y / b * std::atan(x / b));
}

TEST(Sensors, ASquareHidesItsViewFactorOfTheSkyAndALampFillsIt) {
  MeshMaker maker;
  maker.quad({0.3, 0.6, 0.35}, {0.7, 0.6, 0.35}, {0.7, 0.6, 0.65}, {0.3, 0.6, 0.65});  // facing down
  RadiationModel model = black_model(maker.mesh(), {1.0, 1.0, false}, beijing_sun());
  model.sun.reset();
  model.soil.reset();
  give_sky(model, 2.0);
  model.optics[0].emission_w_m2 = {10.0};
  model.sensors = {cosine_sensor({0.5, 0.4, 0.5}, up), cosine_sensor({0.5, 0.8, 0.5}, down),
                   cosine_sensor({0.5, 0.8, 0.5}, up)};
  const std::vector<SensorResult> got = read(model, settings_of(8192));
  const double factor = rectangle_factor(0.4, 0.3, 0.2);
  expect_agrees(got[0].sky[0], 2.0 * (1.0 - factor), sensor_replicates, 1e-3, 2, "sky beside the square");
  expect_agrees(got[0].scattered[0], 10.0 * factor, sensor_replicates, 1e-2, 2, "lamp overhead");
  expect_agreed(got[1].scattered[0], 0.0, 10.0 / 8192.0, "a lamp's lower side is dark");
  expect_agreed(got[2].sky[0], 2.0, 2.0 / 8192.0, "above the square");
}

TEST(Sensors, ListedLightsAreExact) {
  MeshMaker maker;
  maker.level(0.3, 0.7, 0.3, 0.7, 0.6);
  RadiationModel model = black_model(maker.mesh(), {1.0, 1.0, false}, beijing_sun());
  model.sun.reset();
  SkyModel sky{SkyKind::lights, 1, 0, 0, {}};
  sky.lights = {{1.0, up}, {3.0, {0.6, 0.8, 0.0}}};
  give_sky(model, 8.0, sky);
  model.sensors = {cosine_sensor({0.5, 0.1, 0.5}, up), cosine_sensor({0.9, 0.1, 0.5}, up),
                   cosine_sensor({0.9, 0.1, 0.5}, {1, 0, 0}), sphere({0.9, 0.1, 0.5})};
  const std::vector<SensorResult> got = read(model, settings_of(16));
  expect_exactly(got[0].sky[0], 6.0, "the square hides the zenith");
  expect_exactly(got[1].sky[0], 8.0, "both lights");
  expect_exactly(got[2].sky[0], 6.0 * 0.6 / 0.8, "upright");
  expect_exactly(got[3].sky[0], 2.0 + 6.0 / 0.8, "sphere");
  model.soil->reflectance = {0.5};
  model.sensors = {cosine_sensor({0.95, 0.001, 0.05}, down)};  // the shadows are far away
  expect_agrees(read(model, settings_of(4096))[0].scattered[0], 4.0, sensor_replicates, 2e-2, 1, "soil under listed lights");
}

TEST(Sensors, AnEndlessPlotHasNoEdge) {
  RadiationModel model = paper_model(random_leaves(60, 0.03, unit_plot, 1.0, 5), unit_plot, beijing_sun());
  give_sky(model, 1.0);
  Sensor inside{"", {}, SensorResponse::cosine, up}, outside = inside;
  for (int i = 0; i < 64; ++i) {
    const int row = i / 8;
    inside.points_m.emplace_back((i % 8 + 0.37) / 8.0, 0.3, (row + 0.41) / 8.0);
    outside.points_m.push_back(inside.points_m.back() +
                               glm::dvec3(-7.0 * model.canopy.period_m.x, 0, 3.0 * model.canopy.period_m.y));
  }
  model.sensors = {inside, outside};
  const std::vector<SensorResult> got = read(model, settings_of(256));
  int agreeing = 0;
  ReplicateMean scores;
  for (std::size_t i = 0; i < 64; ++i) {
    agreeing += got[i].direct[0].value == got[64 + i].direct[0].value ? 1 : 0;
    const double error =
        std::hypot(standard_error(got[i].sky[0], sensor_replicates), standard_error(got[64 + i].sky[0], sensor_replicates));
    scores.add(error > 0.0 ? (got[i].sky[0].value - got[64 + i].sky[0].value) / error : 0.0);
  }
  EXPECT_GE(agreeing, 63);  // a point on a shadow's very edge may round to either side
  EXPECT_LE(std::abs(scores.mean()), 4.0 / 8.0);
}

TEST(Sensors, LieOnLeavesAndOnTheSoil) {
  MeshMaker maker;
  const glm::dvec3 normal = inclined(0.6, 0.4);
  maker.polygon({0.5, 0.5, 0.5}, normal, 0.04, 4);
  RadiationModel model = black_model(maker.mesh(), {1.0, 1.0, false}, sun_at(80.0, 30.0));
  give_sky(model, 1.0);
  model.sensors = {cosine_sensor({0.5, 0.5, 0.5}, normal), cosine_sensor({0.1, 0.0, 0.1}, up),
                   cosine_sensor({0.1, -3.0, 0.1}, up)};
  const std::vector<SensorResult> got = read(model, settings_of(1024));
  const double facing = glm::dot(normal, direction_to_sun(*model.sun)) / std::sin(model.sun->elevation_rad);
  expect_exactly(got[0].direct[0], facing, "on the leaf");
  expect_agrees(got[0].sky[0], (1.0 + std::cos(0.6)) / 2.0, sensor_replicates, 2e-3, 1, "a leaf's upper side sees the sky");
  expect_exactly(got[1].direct[0], 1.0, "on the soil");
  EXPECT_EQ(got[1].sky[0].value > 0.9, true);
  EXPECT_EQ(got[2].direct[0].value, got[1].direct[0].value);
}

TEST(Sensors, SameBytesForEverySeedAndNumberOfThreads) {
  RadiationModel model = paper_model(random_leaves(60, 0.03, unit_plot, 1.0, 5), unit_plot, beijing_sun());
  give_sky(model, 1.0, {SkyKind::general, 12, 0, 0, {}});
  model.sensors = {cosine_sensor({0.4, 0.3, 0.3}, up), sphere({0.2, 0.6, 0.8})};
  const auto numbers = [&](std::uint64_t seed, CpuWalk walk) {
    std::vector<double> all;
    for (const SensorResult& reading : read(model, settings_of(512, seed), walk))
      for (std::size_t b = 0; b < 2; ++b)
        for (const Estimate& e : {reading.direct[b], reading.sky[b], reading.scattered[b]})
          all.insert(all.end(), {e.value, e.half_width});
    return all;
  };
  const std::vector<double> expected = numbers(1, CpuWalk::tree);
  EXPECT_EQ(numbers(1, CpuWalk::every_element), expected);
  EXPECT_NE(numbers(2, CpuWalk::tree), expected);
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(numbers(1, CpuWalk::tree), expected);
}

TEST(Sensors, IntervalsCoverTheTruth) {
  RadiationModel model = bare_ground(0.4);
  MeshMaker maker;
  maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
  model = leaf_model(maker.mesh(), unit_plot, beijing_sun(), std::array{nir_band});
  model.sensors = {cosine_sensor({0.3, 0.25, 0.6}, up)};
  ZScores scores(8);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const SensorResult got = read(model, {128, 8, seed, 0.95}).at(0);
    scores.add(got.scattered[0], 0.45 / (1.0 - 0.45 * 0.20), "below a plate");
  }
  scores.expect_plausible();
}

// Returns leaves under sun and sky, with a line of four points below them and a ball above.
RadiationModel line_and_ball() {
  RadiationModel model = leaf_model(random_leaves(60, 0.03, unit_plot, 1.0, 5), unit_plot, beijing_sun(), std::array{nir_band});
  give_sky(model, 0.5);
  Sensor line = cosine_sensor({0.1, 0.2, 0.3}, up);
  for (const double x : {0.3, 0.5, 0.7}) line.points_m.emplace_back(x, 0.2, 0.3);
  line.name = "line";
  Sensor ball = sphere({0.5, 1.5, 0.5});
  ball.name = "ball";
  model.sensors = {line, ball};
  return model;
}

SensorReadings readings_of(const RadiationModel& model, const SensorSettings& settings, CpuWalk walk = CpuWalk::tree) {
  const Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, tracer_scene(model), walk);
  return measure_sensors(model, prepared.layout, tracer, settings, {}).value();
}

TEST(Sensors, TotalsAndMeansAreThoseOfTheParts) {
  const SensorReadings got = readings_of(line_and_ball(), settings_of(256));
  ASSERT_EQ(got.points.size(), 2U);
  ASSERT_EQ(got.means.size(), 2U);
  EXPECT_EQ(got.summary.replicates, 16U);
  EXPECT_FALSE(got.summary.bound);
  EXPECT_EQ(got.stop, StopReason::work_done);
  for (std::size_t s = 0; s < 2; ++s) {
    double total = 0.0, squares = 0.0;
    for (const SensorResult& point : got.points[s]) {
      const double sum = point.direct[0].value + point.sky[0].value + point.scattered[0].value;
      EXPECT_NEAR(point.total[0].value, sum, 1e-12 * sum);
      EXPECT_GT(point.total[0].half_width, 0.0);
      EXPECT_LE(point.total[0].half_width, point.sky[0].half_width + point.scattered[0].half_width + 1e-12);
      total += sum;
      squares += point.total[0].half_width * point.total[0].half_width;
    }
    const auto n = static_cast<double>(got.points[s].size());
    EXPECT_NEAR(got.means[s].total[0].value, total / n, 1e-12 * total);
    // The points have random numbers of their own; with 15 degrees of freedom a spread is known to a factor of two.
    const double independent = std::sqrt(squares) / n;
    EXPECT_GT(got.means[s].total[0].half_width, 0.5 * independent);
    EXPECT_LT(got.means[s].total[0].half_width, 2.0 * independent);
  }
}

TEST(Sensors, IntervalsOfTotalsAndMeansCoverTheTruth) {
  const RadiationModel model = line_and_ball();
  const SensorReadings truth = readings_of(model, {4096, 64, 1001, 0.95});
  ZScores of_totals(8), of_means(8);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const SensorReadings got = readings_of(model, {64, 8, seed, 0.95});
    of_totals.add(got.points[0][1].total[0], truth.points[0][1].total[0].value, "total at a point");
    of_means.add(got.means[0].total[0], truth.means[0].total[0].value, "mean of a line");
  }
  of_totals.expect_plausible();
  of_means.expect_plausible();
}

SensorSettings bounded(double relative) {
  SensorSettings settings{256, 8, 1, 0.95};
  settings.bound = SensorBound{relative, {0.015}, {}, {}};
  return settings;
}

TEST(Sensors, GoOnUntilTheBoundHoldsForEach) {
  const RadiationModel model = line_and_ball();
  const SensorReadings got = readings_of(model, bounded(0.01));
  EXPECT_EQ(got.stop, StopReason::bound_reached);
  for (const SensorResult& mean : got.means) EXPECT_LE(mean.total[0].half_width, 0.01 * mean.total[0].value);
  EXPECT_GT(got.summary.replicates, 15U) << "eight to begin with, checks at 12 and 15";
  EXPECT_EQ(got.summary.bound, 0.01);
  ASSERT_TRUE(got.summary.judged);
  EXPECT_EQ(got.summary.judged->of, JudgedFigure::Of::sensor);
  const Estimate& worst = got.means[got.summary.judged->sensor].total[0];
  EXPECT_EQ(got.summary.relative_error, worst.half_width / worst.value);
  EXPECT_GT(readings_of(model, bounded(0.005)).summary.replicates, 2 * got.summary.replicates);
  const SensorReadings again = readings_of(model, bounded(0.01), CpuWalk::every_element);
  EXPECT_EQ(again.means[0].total[0].value, got.means[0].total[0].value);
  EXPECT_EQ(again.summary.replicates, got.summary.replicates);
}

TEST(Sensors, TellHowFarTheSearchIs) {
  SensorSettings settings = bounded(0.005);
  std::vector<std::uint64_t> rays;
  double last_error = 0.0;
  settings.bound->report = [&](double relative_error, std::uint64_t so_far) {
    rays.push_back(so_far);
    last_error = relative_error;
  };
  const SensorReadings got = readings_of(line_and_ball(), settings);
  EXPECT_EQ(got.stop, StopReason::bound_reached);
  ASSERT_GT(rays.size(), 2U);
  EXPECT_TRUE(std::is_sorted(rays.begin(), rays.end()));
  EXPECT_LT(rays.front(), rays.back());
  EXPECT_LE(last_error, 0.005) << "the check before the last is a good one";
}

// A search that ends at a lucky moment must not make the intervals too narrow.
TEST(Sensors, IntervalsAtABoundCoverTheTruth) {
  RadiationModel model = line_and_ball();
  model.sensors.erase(model.sensors.begin());
  const double truth = readings_of(model, {4096, 64, 1001, 0.95}).means[0].total[0].value;
  constexpr int seeds = 200;
  int covered = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    SensorSettings settings = bounded(0.02);
    settings.rays = 64;
    settings.seed = static_cast<std::uint64_t>(seed);
    const Estimate got = readings_of(model, settings).means[0].total[0];
    EXPECT_LE(got.half_width, 0.02 * got.value);
    if (std::abs(got.value - truth) <= got.half_width) ++covered;
  }
  std::printf("%d of %d intervals cover the truth\n", covered, seeds);
  // Three standard deviations of a binomial count with a probability of 95 % are 9.2.
  EXPECT_GT(covered, 0.95 * seeds - 9.2);
}

// The mean of four points is known before the ball, whose further replicates leave the line alone.
TEST(Sensors, OneThatIsGoodEnoughIsLeftAlone) {
  RadiationModel model = line_and_ball();
  const SensorReadings both = readings_of(model, bounded(0.01));
  SensorSettings all = bounded(0.01);
  all.bound.reset();
  all.replicates = static_cast<int>(both.summary.replicates);
  const SensorReadings equal = readings_of(model, all);
  EXPECT_NE(both.means[0].total[0].value, equal.means[0].total[0].value);
  EXPECT_EQ(both.means[1].total[0].value, equal.means[1].total[0].value);
  model.sensors.pop_back();
  EXPECT_LT(readings_of(model, bounded(0.01)).summary.replicates, both.summary.replicates);
}

TEST(Sensors, TimeEndsTheSearchForABound) {
  SensorSettings settings = bounded(1e-6);
  int asked = 0;
  settings.bound->time_is_up = [&] { return ++asked == 3; };
  const SensorReadings got = readings_of(line_and_ball(), settings);
  EXPECT_EQ(got.stop, StopReason::time_spent);
  EXPECT_EQ(got.summary.replicates, 24U) << "8, 12, and twice that";
  EXPECT_GT(got.summary.relative_error.value(), 1e-6);
  settings.bound.reset();
  EXPECT_EQ(readings_of(line_and_ball(), settings).summary.replicates, 8U);
}

// Below a plate no beam and no sky arrive, so the total is compared with the least one.
TEST(Sensors, ADarkOneIsComparedWithTheLeastTotal) {
  MeshMaker maker;
  maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
  RadiationModel model = black_model(maker.mesh(), unit_plot, beijing_sun());
  give_sky(model, 1.0);
  model.sensors = {cosine_sensor({0.3, 0.2, 0.3}, up)};
  const SensorReadings got = readings_of(model, bounded(0.05));
  EXPECT_EQ(got.stop, StopReason::bound_reached);
  EXPECT_EQ(got.means[0].total[0].value, 0.0);
  EXPECT_LE(got.means[0].total[0].half_width, 0.05 * 0.015);
}

TEST(Sensors, StopWhenAsked) {
  RadiationModel model = bare_ground(0.4);
  model.sensors = {cosine_sensor({0.3, 0.25, 0.6}, down)};
  const Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, tracer_scene(model), CpuWalk::tree);
  EXPECT_FALSE(measure_sensors(model, prepared.layout, tracer, {}, [] { return true; }).has_value());
}

TEST(Sensors, WithoutSensorsThereIsNothing) {
  const RadiationModel model = bare_ground(0.4);
  const Prepared prepared(model);
  CpuTracer tracer(prepared.bvh, tracer_scene(model), CpuWalk::tree);
  EXPECT_TRUE(measure_sensors(model, prepared.layout, tracer, {}, {}).value().points.empty());
}

}  // namespace
}  // namespace sunfleck::test
