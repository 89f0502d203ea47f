#include "programs/viewer/live_light.h"

#include "base/error.h"
#include "support/live_scene.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <thread>
#include <vector>

namespace sunfleck {
namespace {

bool wait_until_done(const LiveLight& light, std::uint64_t request) {
  return test::wait_for([&] {
    const LightNews news = light.news();
    return news.result_request == request && news.complete;
  });
}

RadiationResult result_of(const LiveLight& light) {
  RadiationResult copy;
  EXPECT_TRUE(light.with_result([&](const Scene&, const RadiationResult& result, const LightStamp&) { copy = result; }));
  return copy;
}

// Returns what `run` would compute for the model as it is, by default with the light of triangles.
RadiationResult run_of(const test::LiveScene& live, const RadiationModel& model, ElementErrors errors = ElementErrors::refine) {
  CpuTracer tracer(live.simulation.tracing().tree.bvh, {model.plot.periodic, model.soil.has_value()});
  SolveSettings settings = solve_settings(live.options, live.scene);
  settings.element_errors = errors;
  return solve(model, live.simulation.layout(), tracer, settings, {});
}

void expect_same(const RadiationResult& live, const RadiationResult& run) {
  ASSERT_EQ(live.elements.size(), run.elements.size());
  for (std::size_t e = 0; e < run.elements.size(); ++e) {
    EXPECT_EQ(live.elements[e].upper, run.elements[e].upper);
    EXPECT_EQ(live.elements[e].lower, run.elements[e].lower);
  }
  EXPECT_EQ(live.side_direct, run.side_direct);
  EXPECT_EQ(live.side_indirect, run.side_indirect);
  EXPECT_EQ(live.side_error, run.side_error);
  EXPECT_EQ(live.cell_sky, run.cell_sky);
  EXPECT_EQ(live.direct.rays, run.direct.rays);
  EXPECT_EQ(live.direct.relative_error, run.direct.relative_error);
  for (std::size_t b = 0; b < run.bands.size(); ++b) {
    EXPECT_EQ(live.bands[b].ledger.absorbed_vegetation, run.bands[b].ledger.absorbed_vegetation);
    EXPECT_EQ(live.bands[b].absorbed_soil.half_width, run.bands[b].absorbed_soil.half_width);
  }
}

// Expects what `run` would compute for the requested light.
void expect_run_of(const test::LiveScene& live, const LiveLight& light, const LightRequest& request) {
  RadiationModel model = live.scene.model;
  grant(request, live.scene, model);
  expect_same(result_of(light), run_of(live, model));
}

class LiveLightTest : public ::testing::Test {
 protected:
  const TempFolder folder_;
  test::LiveScene live_{test::write_live_scene(folder_)};
  LiveLight light_{live_.simulation, live_.options, [] {}};
};

TEST_F(LiveLightTest, EndsWithWhatRunComputes) {
  ASSERT_TRUE(wait_until_done(light_, 1));
  expect_same(result_of(light_), run_of(live_, live_.scene.model));
  EXPECT_EQ(light_.news().problem, "");
}

TEST_F(LiveLightTest, AnotherSunBeginsAnew) {
  LightRequest request = request_of(live_.scene);
  std::uint64_t number = 0;
  for (const double hour : {8.0, 11.5, 14.0}) {  // without waiting for the previous one
    request.sun.hour = hour;
    number = light_.ask(request);
  }
  EXPECT_EQ(number, 4U);
  ASSERT_TRUE(wait_until_done(light_, number));
  RadiationModel model = live_.scene.model;
  grant(request, live_.scene, model);
  expect_same(result_of(light_), run_of(live_, model));
  const std::optional<SunPosition> sun = light_.news().sun;
  ASSERT_TRUE(sun);
  EXPECT_EQ(sun->azimuth_rad, model.sun->azimuth_rad);
}

TEST_F(LiveLightTest, OtherOpticsKeepTheBeams) {
  ASSERT_TRUE(wait_until_done(light_, 1));
  const RadiationResult before = result_of(light_);
  EXPECT_EQ(light_.news().spared_beams, 0U);
  LightRequest request = request_of(live_.scene);
  request.optics.at(0).upper[0] = request.optics.at(0).lower[0] = {0.3, 0.3};
  ASSERT_TRUE(wait_until_done(light_, light_.ask(request)));
  EXPECT_GE(light_.news().spared_beams, 8U);
  RadiationModel model = live_.scene.model;
  grant(request, live_.scene, model);
  EXPECT_EQ(model.optics[0].upper[0].reflectance, 0.3);
  const RadiationResult after = result_of(light_);
  expect_same(after, run_of(live_, model));
  EXPECT_NE(after.side_indirect, before.side_indirect);
}

// The moments of a played day share the packets of one simulation; a pause refines the moment that is shown to what `run`
// computes.
TEST(LiveLight, PlaysADayAsMomentsOfOneSimulation) {
  const TempFolder folder;
  test::LiveScene live(test::write_live_scene(folder));
  constexpr double no_limit_s = 1e6;
  LiveLight light(
      live.simulation, live.options, [] {}, no_limit_s);
  ASSERT_TRUE(wait_until_done(light, 1));
  LightRequest moment = request_of(live.scene);
  constexpr double step_min = 30.0;
  std::vector<std::uint64_t> packets;
  for (int k = 0; k < 9; ++k) {
    moment.sun.hour = next_played_hour(moment.sun, step_min);
    ASSERT_TRUE(wait_until_done(light, light.ask(moment, moments_after(moment, step_min, 11))));
    const RadiationResult shown = result_of(light);
    RadiationModel model = live.scene.model;
    grant(moment, live.scene, model);
    EXPECT_EQ(light.news().sun->azimuth_rad, model.sun->azimuth_rad);
    EXPECT_EQ(light.news().problem, "");
    packets.push_back(shown.indirect.packets);
    const RadiationResult run = run_of(live, model);
    for (std::size_t b = 0; b < run.bands.size(); ++b) {
      const Estimate& played = shown.bands[b].absorbed_vegetation;
      const Estimate& alone = run.bands[b].absorbed_vegetation;
      // Three half-widths of 95 % are 5.9 standard errors.
      EXPECT_NEAR(played.value, alone.value, 3.0 * std::hypot(played.half_width, alone.half_width)) << moment.sun.hour;
      EXPECT_EQ(shown.bands[b].ledger.residual(), 0);
    }
  }
  for (int k = 1; k < 6; ++k) EXPECT_EQ(packets[static_cast<std::size_t>(k)], packets[0]) << "the first six share packets";
  light.save(folder / "saved");  // not before the moment has a simulation of its own
  ASSERT_TRUE(wait_until_done(light, light.ask(moment)));
  expect_run_of(live, light, moment);
  ASSERT_TRUE(test::wait_for([&] { return light.news().saved.has_value(); }));
  EXPECT_TRUE(light.news().saved->done) << light.news().saved->text;
}

// The user may change anything while moments are being simulated ahead.
TEST_F(LiveLightTest, ForgetsMomentsThatAreNoLongerPlayed) {
  LightRequest moment = request_of(live_.scene);
  moment.sun.hour = 9.0;
  light_.ask(moment, moments_after(moment, 20.0, 11));
  LightRequest other = moment;
  other.optics.at(0).upper[0] = other.optics.at(0).lower[0] = {0.3, 0.3};
  ASSERT_TRUE(wait_until_done(light_, light_.ask(other, moments_after(other, 20.0, 11))));
  EXPECT_EQ(live_.simulation.model().optics[0].upper[0].reflectance, 0.3);
  moment.sun.hour = 15.0;
  ASSERT_TRUE(wait_until_done(light_, light_.ask(moment)));
  expect_run_of(live_, light_, moment);
}

// The pause may come while the moment is being simulated with those ahead.
TEST_F(LiveLightTest, RefinesAMomentThatIsPausedAtOnce) {
  LightRequest moment = request_of(live_.scene);
  for (const double hour : {8.0, 9.0, 10.0, 13.0, 15.0}) {
    moment.sun.hour = hour;
    light_.ask(moment, moments_after(moment, 20.0, 11));
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(2.0 * hour)));
    ASSERT_TRUE(wait_until_done(light_, light_.ask(moment)));
    expect_run_of(live_, light_, moment);
  }
}

// Night has no moments that share packets with those of the day.
TEST_F(LiveLightTest, PlaysMomentsInTheDark) {
  LightRequest moment = request_of(live_.scene);
  moment.sky.kind = SkyRequestKind::none;
  std::vector<LightRequest> ahead(2, moment);
  moment.sun.hour = 1.0;
  ahead[0].sun.hour = 2.0;
  ASSERT_TRUE(test::wait_for([&] { return light_.news().complete; }));
  ASSERT_TRUE(wait_until_done(light_, light_.ask(moment, ahead)));
  EXPECT_EQ(result_of(light_).direct.rays, 0U);
  ASSERT_TRUE(wait_until_done(light_, light_.ask(ahead[1], {ahead[1]})));
  EXPECT_GT(result_of(light_).direct.rays, 0U);
}

TEST_F(LiveLightTest, ContinuesAfterARequestThatCannotBeMet) {
  ASSERT_TRUE(wait_until_done(light_, 1));
  LightRequest request = request_of(live_.scene);
  request.sun.shines = false;
  request.sky.kind = SkyRequestKind::clear;
  light_.ask(request);
  ASSERT_TRUE(test::wait_for([&] { return !light_.news().problem.empty(); }));
  EXPECT_NE(light_.news().problem.find("sky"), std::string::npos);
  request.sky.kind = SkyRequestKind::uniform;
  const std::uint64_t number = light_.ask(request);
  ASSERT_TRUE(wait_until_done(light_, number));
  EXPECT_EQ(light_.news().problem, "");
  EXPECT_EQ(result_of(light_).direct.rays, 0U);
}

TEST(LiveLight, SavesWhatRunWrites) {
  const TempFolder folder;
  test::LiveScene live(test::write_live_scene(folder));
  live.options.images = {"none"};
  LiveLight light(live.simulation, live.options, [] {});
  light.save(folder / "out");
  ASSERT_TRUE(test::wait_for([&] { return light.news().saved.has_value(); }));
  EXPECT_TRUE(light.news().saved->done) << light.news().saved->text;
  ASSERT_TRUE(wait_until_done(light, 1));
  light.save(folder / "out");
  ASSERT_TRUE(test::wait_for([&] { return light.news().saved.has_value(); }));
  EXPECT_EQ(light.news().saved->text, "saved in " + (folder / "out").string());
  for (const char* name : {"summary.json", "profile.csv", "organs.csv", "pictures.cbor"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
  light.save("/proc/no/folder");
  ASSERT_TRUE(test::wait_for([&] { return light.news().saved.has_value(); }));
  EXPECT_FALSE(light.news().saved->done);
}

// The half-width of a side belongs to the light that falls on it: on a leaf that absorbs everything, both sides together give
// the absorbed flux.
TEST_F(LiveLightTest, KnowsTheErrorOfEachSide) {
  LightRequest request = request_of(live_.scene);
  for (std::size_t b = 0; b < 2; ++b) {
    request.optics.at(0).upper[b] = request.optics.at(0).lower[b] = {};
    request.soil_reflectance[b] = 0.0;
  }
  request.sky.kind = SkyRequestKind::none;
  ASSERT_TRUE(wait_until_done(light_, light_.ask(request)));
  const RadiationResult result = result_of(light_);
  const std::size_t elements = live_.scene.model.canopy.size();
  ASSERT_EQ(result.side_error.size(), 2 * elements * 2);
  for (std::size_t e = 0; e < elements; ++e) {
    for (std::size_t b = 0; b < 2; ++b) {
      const double lit = result.side_error[2 * e * 2 + b];
      const double dark = result.side_error[(2 * e + 1) * 2 + b];
      EXPECT_EQ(dark, 0.0) << "the sun is above these leaves";
      EXPECT_NEAR(lit, result.element_error[b * elements + e], 1e-9 * lit);
      EXPECT_GT(lit, 0.0);
    }
  }
}

// Watching a run does not change its result.
TEST(Monitor, IsHandedWhatIsKnownAfterEachReplicate) {
  const TempFolder folder;
  test::LiveScene live(test::write_live_scene(folder));
  live.options.direct_error = 0.0005;  // so small that the run traces more rays than its pilots, which are shown until then
  CpuTracer tracer(live.simulation.tracing().tree.bvh, {true, true});
  const SolveSettings settings = solve_settings(live.options, live.scene);
  std::vector<RadiationResult> seen;
  Monitor monitor;
  monitor.wants_result = [] { return true; };
  monitor.receive_result = [&](RadiationResult result) { seen.push_back(std::move(result)); };
  const RadiationResult end = solve(live.scene.model, live.simulation.layout(), tracer, settings, monitor);
  expect_same(end, run_of(live, live.scene.model, settings.element_errors));
  ASSERT_GE(seen.size(), 8U + end.direct.replicates);
  for (const RadiationResult& result : seen) {
    EXPECT_EQ(result.stop, StopReason::interrupted);
    for (const BandResult& band : result.bands) EXPECT_EQ(band.ledger.residual(), 0);
    EXPECT_GT(result.direct.rays + result.indirect.packets, 0U);
  }
  EXPECT_FALSE(seen.front().direct.relative_error) << "a single replicate tells no error";
  expect_same(seen.back(), end);
}

// Sky light is as old as the beam's: no picture shows one without the other.
TEST(Monitor, IsHandedSkyLightFromTheFirstReplicateOn) {
  const TempFolder folder;
  const test::LiveScene live(test::write_live_scene(folder));
  CpuTracer tracer(live.simulation.tracing().tree.bvh, {true, true});
  std::optional<RadiationResult> first;
  Monitor monitor;
  monitor.wants_result = [&] { return !first; };
  monitor.receive_result = [&](RadiationResult result) { first = std::move(result); };
  const SolveSettings settings = solve_settings(live.options, live.scene);
  const RadiationResult end = solve(live.scene.model, live.simulation.layout(), tracer, settings, monitor);
  expect_same(end, run_of(live, live.scene.model, settings.element_errors));
  ASSERT_TRUE(first);
  const auto sky_w = [&](const RadiationResult& result) {
    double sum_w = 0.0;
    for (std::size_t e = 0; e < live.scene.model.canopy.size(); ++e) {
      const double area = area_m2(live.scene.model.canopy.corners[e]);
      for (const std::size_t side : {2 * e, 2 * e + 1}) sum_w += area * result.side_sky_w_m2(side, area, 0);
    }
    return sum_w;
  };
  EXPECT_GT(sky_w(end), 0.0);
  EXPECT_NEAR(sky_w(*first), sky_w(end), 0.3 * sky_w(end));
}

TEST(LightRequest, OfTheSceneChangesNothing) {
  const TempFolder folder;
  const Scene scene = read_scene(test::write_live_scene(folder));
  RadiationModel model = scene.model;
  grant(request_of(scene), scene, model);
  EXPECT_EQ(model.sun->elevation_rad, scene.model.sun->elevation_rad);
  EXPECT_EQ(model.bands[1].diffuse_w_m2, 20.0);
  EXPECT_EQ(model.sky->kind, SkyKind::overcast);
  EXPECT_EQ(first_difference(request_of(scene), request_of(scene)), "");
}

TEST(LightRequest, ByTheClockIsTheSunOfThatMoment) {
  const TempFolder folder;
  const Scene scene = read_scene(test::write_live_scene(folder));
  LightRequest request = request_of(scene);
  EXPECT_TRUE(request.sun.by_clock);
  EXPECT_NEAR(request.sun.hour, 10.0 + 10.0 / 60.0, 1e-9);
  EXPECT_EQ(request.sun.day, 8);
  request.sun.hour = 15.5;
  RadiationModel model = scene.model;
  grant(request, scene, model);
  const SunPosition expected = sun_position({2002, 8, 8, 7, 30, 0.0}, scene.moment->place);
  EXPECT_NEAR(model.sun->elevation_rad, expected.elevation_rad, 1e-9);
  EXPECT_NEAR(model.sun->azimuth_rad, expected.azimuth_rad, 1e-9);
  EXPECT_EQ(model.bands[0].direct_w_m2, 300.0);
  EXPECT_EQ(first_difference(request_of(scene), request), "sun");
  request.sun.hour = 23.0;
  grant(request, scene, model);
  EXPECT_FALSE(model.has_beam());
  EXPECT_EQ(model.bands[0].diffuse_w_m2, 60.0);
}

// Irradiance that the scene states perpendicular to the beam follows the sun to any angle, even if the sun started below the
// horizon.
TEST(LightRequest, IrradianceFollowsTheSun) {
  const TempFolder folder;
  folder.write("leaves.obj", test::live_mesh_text);
  std::string text = test::live_scene_text;
  text.replace(text.find("direct = 300.0"), 14, "direct_normal = 800.0");
  text.replace(text.find("time = 2002-08-08T10:10:00+08:00"), 32, "time = 2002-08-08T23:00:00+08:00");
  const Scene scene = read_scene(folder.write("night.toml", text));
  EXPECT_EQ(scene.model.bands[0].direct_w_m2, 0.0);
  LightRequest request = request_of(scene);
  RadiationModel model = scene.model;
  request.sun.by_clock = false;
  for (const double elevation_deg : {60.0, 10.0}) {
    request.sun.elevation_deg = elevation_deg;
    grant(request, scene, model);
    EXPECT_NEAR(model.bands[0].direct_w_m2, 800.0 * std::sin(test::radians(elevation_deg)), 1e-9);
    EXPECT_EQ(model.bands[1].direct_w_m2, 250.0);
  }
  request.sun.by_clock = true;
  request.sun.hour = 12.0;
  request.sun.latitude_deg = 10.0;  // at the place that was set, not at the scene's
  grant(request, scene, model);
  EXPECT_NEAR(model.bands[0].direct_w_m2, 800.0 * std::sin(model.sun->elevation_rad), 1e-9);
  request.sun.shines = false;
  grant(request, scene, model);
  EXPECT_FALSE(model.has_beam());
  EXPECT_EQ(model.bands[0].diffuse_w_m2, 60.0);
}

TEST(LightRequest, FieldsOutOfUseChangeNothing) {
  const TempFolder folder;
  const Scene scene = read_scene(test::write_live_scene(folder));
  LightRequest request = request_of(scene);
  request.sky.cie_type = 3;
  request.sky.dni_w_m2 = 1.0;
  request.sun.elevation_deg = 1.0;
  request.bands[0].total_w_m2 = 1.0;
  EXPECT_EQ(first_difference(request_of(scene), request), "");
  EXPECT_EQ(digest_of(request_of(scene)), digest_of(request));
  LightRequest other = request;
  other.optics.at(0).lower.at(1).transmittance += 0.01;
  EXPECT_NE(digest_of(other), digest_of(request));
  RadiationModel model = scene.model;
  grant(request, scene, model);
  EXPECT_EQ(model.sun->elevation_rad, scene.model.sun->elevation_rad);
  EXPECT_EQ(model.sky->kind, SkyKind::overcast);
}

TEST(LightRequest, HasItsOwnAnglesSkyAndIrradiance) {
  const TempFolder folder;
  const Scene scene = read_scene(test::write_live_scene(folder));
  LightRequest request = request_of(scene);
  request.sun.by_clock = false;
  request.sun.elevation_deg = 30.0;
  request.sun.azimuth_deg = 90.0;
  request.sky = {SkyRequestKind::general, 5, 0.0, 0.0};
  request.own_irradiance = true;
  request.bands[0] = {500.0, 0.25};
  RadiationModel model = scene.model;
  grant(request, scene, model);
  EXPECT_NEAR(model.sun->elevation_rad, std::numbers::pi / 6, 1e-12);
  EXPECT_EQ(model.sky->cie_type, 5);
  EXPECT_DOUBLE_EQ(model.bands[0].direct_w_m2, 375.0);
  EXPECT_DOUBLE_EQ(model.bands[0].diffuse_w_m2, 125.0);
  request.sky.kind = SkyRequestKind::none;
  grant(request, scene, model);
  EXPECT_FALSE(model.has_sky());
}

TEST(LightRequest, ThatCannotBeLeavesTheModel) {
  const TempFolder folder;
  const Scene scene = read_scene(test::write_live_scene(folder));
  LightRequest request = request_of(scene);
  request.sun.day = 31;
  request.sun.month = 2;
  RadiationModel model = scene.model;
  EXPECT_THROW(grant(request, scene, model), Error);
  EXPECT_EQ(model.sun->elevation_rad, scene.model.sun->elevation_rad);
}

}  // namespace
}  // namespace sunfleck
