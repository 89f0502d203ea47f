#include "files/results/tables/day_tables.h"

#include "base/units.h"
#include "files/results/tables/day_receivers.h"
#include "files/results/tables/plane_day.h"
#include "files/results/tables/table_text.h"
#include "support/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace sunfleck {
namespace {

// Returns two triangles of 0.5 and 4.5 m2, each an organ; photons are requested for band A.
RadiationModel two_organs(bool periodic = true) {
  RadiationModel model;
  model.plot = {2.0, 3.0, periodic};
  model.canopy.corners = {{{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}}},
                          {{{0.0F, 3.0F, 0.0F}, {0.0F, 3.0F, 3.0F}, {3.0F, 3.0F, 0.0F}}}};
  model.canopy.organ_of = {0, 1};
  model.canopy.optics_of = {0, 0};
  model.optics.resize(1);
  model.optics[0].upper = model.optics[0].lower = {{0.1, 0.1}, {0.4, 0.4}};
  model.canopy.optics_names = {"leaf"};
  model.canopy.organs = {{1, "leaf", 7}, {2, "a \"tip\", dry", 0}};
  model.bands = {{"A", 0.0, 0.0, 4.0}, {"B", 0.0, 0.0, 0.0}};
  return model;
}

// Returns two steps of one date and one of the next.
DayCourse three_steps() {
  DayCourse course;
  course.offset_minutes = -210;
  course.dates = {"2002-12-31", "2003-01-01"};
  course.steps = {{{2003, 1, 1, 2, 0, 0.0}, {2003, 1, 1, 2, 15, 0.0}, 1800.0, 0, {0.5, 1.0}},
                  {{2003, 1, 1, 2, 30, 0.0}, {2003, 1, 1, 2, 35, 0.0}, 600.0, 0, {-0.1, 1.0}},
                  {{2003, 1, 1, 14, 0, 0.0}, {2003, 1, 1, 14, 5, 0.0}, 600.0, 1, {0.5, 1.0}}};
  return course;
}

// Returns a table of these steps as its file has it.
std::string text_of(Table (*table)(const DayStand&, const DayPart&), const RadiationModel& model,
                    const std::vector<StepLight>& lights) {
  const DayCourse course = three_steps();
  return day_text({"", table}, {}, DayStand(model), DayPart(course, lights));
}

StepLight light(double w_m2, double half_width, double unshot) {
  const BandFluxes band{{w_m2, 0.0},
                        {0.5 * w_m2, half_width},
                        {0.0625 * w_m2, half_width},
                        {0.25 * w_m2, half_width},
                        {0.125 * w_m2, half_width},
                        {0.0625 * w_m2, half_width},
                        unshot};
  StepLight step{{band, band}, {{w_m2, half_width}, {2.0 * w_m2, half_width}, {0.0, 0.0}, {3.0 * w_m2, no_value}}, {0.5, 0.01}};
  step.kind_absorbed.resize(4, {{0.0, 0.0}});
  return step;
}

TEST(DayTables, LocalTimeCarriesItsOffset) {
  EXPECT_EQ(local_time_text({2002, 8, 7, 21, 0, 0.0}, 480), "2002-08-08T05:00:00+08:00");
  EXPECT_EQ(local_time_text({2003, 1, 1, 2, 0, 0.0}, -210), "2002-12-31T22:30:00-03:30");
  EXPECT_EQ(local_time_text({2003, 1, 1, 2, 0, 0.0}, 0), "2003-01-01T02:00:00+00:00");
}

TEST(DayTables, IncidentFluxOfAnIsolatedPlotHasAnError) {
  RadiationResult result;
  result.bands = {{{{100.0, 0.0}, {60.0, 1.5}, {0.0, 0.0}, {30.0, 2.0}, {0.0, 1.0}, {9.0, 3.0}, 1.0}, "A"}};
  const StepLight endless = step_light(two_organs(), result);
  EXPECT_EQ(endless.bands[0].incident.value, 100.0);
  EXPECT_EQ(endless.bands[0].incident.half_width, 0.0);
  EXPECT_EQ(endless.bands[0].unshot, 1.0);
  result.bands[0].incident.half_width = 2.5;
  const StepLight isolated = step_light(two_organs(false), result);
  EXPECT_EQ(isolated.bands[0].incident.half_width, 2.5);
  DayCourse course = three_steps();
  const std::vector<DateSums> sums = sum_dates(course, std::vector<StepLight>(3, isolated));
  double squares = 0.0;
  for (const DayStep& step : course.steps) {
    if (step.date == 0) squares += std::pow(2.5 * step.length_s, 2.0);
  }
  EXPECT_NEAR(sums[0].bands[0].incident.half_width, std::sqrt(squares), 1e-9) << "unshot flux has arrived";
}

TEST(DayTables, RandomErrorsAddAsSquaresAndUnshotFluxAsItIs) {
  const std::vector<StepLight> lights{light(100.0, 3.0, 1.0), light(200.0, 13.0, 1.0), light(10.0, 5.0, 0.0)};
  const std::vector<DateSums> dates = sum_dates(three_steps(), lights);
  ASSERT_EQ(dates.size(), 2U);
  EXPECT_EQ(dates[0].steps, 2U);
  const BandFluxes& band = dates[0].bands[1];
  EXPECT_EQ(band.incident.value, 100.0 * 1800.0 + 200.0 * 600.0);
  EXPECT_EQ(band.incident.half_width, 0.0);
  EXPECT_EQ(band.absorbed_soil.value, 0.25 * band.incident.value);
  EXPECT_NEAR(band.absorbed_soil.half_width, std::hypot(2.0 * 1800.0, 12.0 * 600.0) + 2400.0, 1e-8);
  EXPECT_EQ(dates[1].bands[0].reflected.value, 1250.0 * 0.6);
  EXPECT_EQ(dates[1].bands[0].reflected.half_width, 3000.0);
  // Unshot flux counts by its share of the absorbed flux: 1 / 81.25 and 1 / 162.5.
  const double first = 3.0 - 100.0 / 81.25, second = 13.0 - 200.0 / 162.5;
  EXPECT_NEAR(dates[0].organ_absorbed[0].half_width, std::hypot(1800.0 * first, 600.0 * second) + 2400.0 * 100.0 / 81.25, 1e-8);
}

// Steps that share packets have one error of their sum, which the first of them holds; unshot flux adds as it is.
TEST(DayTables, ErrorsOfStepsThatSharePacketsAreThoseOfTheirSum) {
  std::vector<StepLight> lights{light(100.0, 3.0, 1.0), light(200.0, 13.0, 1.0), light(10.0, 5.0, 0.0)};
  for (std::size_t k = 0; k < 2; ++k) {
    lights[k].shares_packets = true;
    lights[k].kind_absorbed[1] = {{20.0, 3.0}, 1.0};
    lights[k].plane_down = {{30.0, 2.0}};
    lights[k].of_shared = no_joint_errors(lights[k]);
  }
  lights[0].of_shared.bands[1].soil = 5000.0;
  lights[0].of_shared.organs[0] = 700.0;
  lights[0].of_shared.groups[1] = 900.0;
  lights[0].of_shared.planes[0] = 60.0;
  const std::vector<DateSums> dates = sum_dates(three_steps(), lights);
  EXPECT_NEAR(dates[0].bands[1].absorbed_soil.half_width, 5000.0 + 2400.0, 1e-8);
  EXPECT_NEAR(dates[0].bands[1].reflected.half_width, 2400.0, 1e-8);
  EXPECT_NEAR(dates[0].organ_absorbed[0].half_width, 700.0 + 2400.0 * 100.0 / 81.25, 1e-8);
  EXPECT_NEAR(dates[0].kind_absorbed[1].value, 20.0 * 2400.0, 1e-8);
  EXPECT_NEAR(dates[0].kind_absorbed[1].half_width, 900.0 + 2400.0, 1e-8);
  EXPECT_NEAR(dates[0].plane_down[0].half_width, 60.0, 1e-8);
  EXPECT_EQ(dates[1].bands[0].reflected.half_width, 3000.0);
}

TEST(DayTables, DatesAddUpLikeSteps) {
  const std::vector<StepLight> lights{light(100.0, 4.0, 1.0), light(200.0, 4.0, 1.0), light(10.0, 5.0, 1.0)};
  const std::vector<DateSums> dates = sum_dates(three_steps(), lights);
  const BandFluxes all = sum_over_dates(dates, 1);
  EXPECT_EQ(all.absorbed_soil.value, dates[0].bands[1].absorbed_soil.value + dates[1].bands[1].absorbed_soil.value);
  const double first = std::hypot(3.0 * 1800.0, 3.0 * 600.0), second = 4.0 * 600.0;
  EXPECT_NEAR(all.absorbed_soil.half_width, std::hypot(first, second) + 3000.0, 1e-8);
  EXPECT_EQ(all.unshot, 3000.0);
}

TEST(DayTables, DayIsWrittenStepByStep) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 3.0, 1.0), no_light(model), light(10.0, no_value, 0.0)};
  const regression::Table table(text_of(steps_table, model, lights));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table.comments().size(), 4U);
  EXPECT_EQ(table.cell(0, "time"), "2002-12-31T22:30:00-03:30");
  EXPECT_EQ(table.number(0, "step_s"), 1800.0);
  EXPECT_NEAR(table.number(0, "elevation_deg"), 28.6478898, 1e-7);
  EXPECT_EQ(table.number(0, "B_absorbed_soil"), 25.0);
  EXPECT_EQ(table.number(0, "B_absorbed_soil_error"), 3.0);
  EXPECT_EQ(table.number(0, "B_transmitted"), 6.25);
  EXPECT_EQ(table.number(0, "B_unshot"), 1.0);
  EXPECT_EQ(table.number(0, "sunlit_leaf_fraction"), 0.5);
  EXPECT_EQ(table.cell(1, "A_incident"), "0");
  EXPECT_EQ(table.cell(1, "sunlit_leaf_fraction"), "");
  EXPECT_EQ(table.cell(1, "sunlit_leaf_fraction_error"), "");
  EXPECT_EQ(table.cell(1, "sunlit_leaf_area_index"), "0");
  EXPECT_GT(table.number(1, "shaded_leaf_area_index"), 0.0);
  for (const char* name :
       {"A_absorbed_sunlit", "A_absorbed_sunlit_error", "A_absorbed_sunlit_sd", "A_absorbed_sunlit_sd_error"})
    EXPECT_EQ(table.cell(1, name), "") << name;
  for (const char* name :
       {"A_absorbed_shaded", "A_absorbed_shaded_error", "A_absorbed_shaded_sd", "A_absorbed_shaded_sd_error"})
    EXPECT_EQ(table.cell(1, name), "0") << name;
  EXPECT_EQ(table.cell(2, "A_reflected_error"), "");
}

TEST(DayTables, DatesHaveSums) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 4.0, 1.0), no_light(model), light(10.0, 5.0, 0.0)};
  const regression::Table table(text_of(day_sums_table, model, lights));
  std::string header = "date,steps";
  for (const char* name :
       {"incident", "absorbed_vegetation", "absorbed_structure", "absorbed_soil", "reflected", "transmitted"}) {
    for (const char* unit : {"_mj_m2", "_mol_m2"}) header += std::string(",A_") + name + unit + ",A_" + name + unit + "_error";
  }
  EXPECT_EQ(table.header().substr(0, header.size()), header);
  EXPECT_EQ(table.header().find("B_incident_mol"), std::string::npos);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table.cell(0, "date"), "2002-12-31");
  EXPECT_EQ(table.number(0, "steps"), 2.0);
  EXPECT_EQ(table.number(0, "A_incident_mj_m2"), 0.18);
  EXPECT_EQ(table.number(0, "A_incident_mol_m2"), 0.72);
  EXPECT_EQ(table.number(0, "A_absorbed_vegetation_mj_m2"), 0.09);
  EXPECT_EQ(table.number(0, "A_absorbed_vegetation_mj_m2_error"), 0.0072);
  EXPECT_EQ(table.number(0, "A_absorbed_soil_mj_m2"), 0.045);
  EXPECT_EQ(table.number(0, "B_reflected_mj_m2"), 0.0225);
  EXPECT_EQ(table.number(0, "B_transmitted_mj_m2"), 0.01125);
  EXPECT_EQ(table.number(0, "B_unshot_mj_m2"), 0.0018);
  EXPECT_EQ(table.cell(1, "date"), "2003-01-01");
  EXPECT_EQ(table.number(1, "A_incident_mj_m2"), 0.006);
}

TEST(DayTables, OrgansHaveSumsOfEachDate) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 3.0, 0.0), no_light(model), light(10.0, 5.0, 0.0)};
  const regression::Table table(text_of(organs_day_table, model, lights));
  EXPECT_EQ(table.header(),
            "date,plant,organ,rank,area_m2,A_absorbed_mj_m2,A_absorbed_mj_m2_error,A_absorbed_mol_m2,A_absorbed_mol_m2_error,"
            "B_absorbed_mj_m2,B_absorbed_mj_m2_error,role");
  ASSERT_EQ(table.size(), 4U);
  EXPECT_EQ(table.cell(0, "date"), "2002-12-31");
  EXPECT_EQ(table.cell(1, "organ"), "a \"tip\", dry");
  EXPECT_EQ(table.number(1, "area_m2"), 4.5);
  EXPECT_EQ(table.number(0, "A_absorbed_mj_m2"), 0.18);
  EXPECT_EQ(table.number(0, "A_absorbed_mol_m2"), 0.72);
  EXPECT_EQ(table.number(0, "A_absorbed_mj_m2_error"), 0.0054);
  EXPECT_EQ(table.number(0, "A_absorbed_mol_m2_error"), 0.0216);
  EXPECT_EQ(table.number(1, "A_absorbed_mj_m2"), 0.0);
  EXPECT_EQ(table.cell(1, "B_absorbed_mj_m2_error"), "");  // the error of one step is unknown
  EXPECT_EQ(table.cell(3, "date"), "2003-01-01");
}

TEST(DayTables, PlantsHaveSumsOfEachDate) {
  RadiationModel model = two_organs();
  model.canopy.plants = {{1, {0.5, 0.0, 0.25}}, {2, {1.0, 0.0, 1.0}}};
  const auto of_plants = [](double w, double half_width) {
    StepLight step = light(w, half_width, 0.0);
    step.plant_absorbed_w = {{w, half_width}, {2.0 * w, half_width}, {0.0, 0.0}, {3.0 * w, no_value}};
    return step;
  };
  const std::vector<StepLight> lights{of_plants(100.0, 3.0), no_light(model), of_plants(10.0, 5.0)};
  EXPECT_EQ(lights[1].plant_absorbed_w.size(), 4U);
  const regression::Table table(text_of(plants_day_table, model, lights));
  EXPECT_EQ(table.header(),
            "date,plant,x,y,z,height_m,leaf_area_m2,A_absorbed_mj,A_absorbed_mj_error,A_absorbed_mol,A_absorbed_mol_error,"
            "B_absorbed_mj,B_absorbed_mj_error");
  ASSERT_EQ(table.size(), 4U);
  EXPECT_EQ(table.cell(0, "date"), "2002-12-31");
  EXPECT_EQ(table.number(1, "plant"), 2.0);
  EXPECT_EQ(table.number(0, "z"), 0.25);
  EXPECT_EQ(table.number(1, "leaf_area_m2"), 4.5);
  EXPECT_EQ(table.number(0, "A_absorbed_mj"), 0.18);
  EXPECT_EQ(table.number(0, "A_absorbed_mj_error"), 0.0054);
  EXPECT_EQ(table.number(0, "A_absorbed_mol"), 0.72);
  EXPECT_EQ(table.number(0, "A_absorbed_mol_error"), 0.0216);
  EXPECT_EQ(table.number(1, "B_absorbed_mj"), 0.54);
  EXPECT_EQ(table.cell(1, "B_absorbed_mj_error"), "");
  EXPECT_EQ(table.cell(3, "date"), "2003-01-01");
  EXPECT_EQ(table.number(2, "A_absorbed_mj"), 0.006);
}

// Returns four organs on 10 m2 of ground: two leaves, a stem and a pot.
RadiationModel four_organs() {
  RadiationModel model = two_organs();
  model.plot = {2.0, 5.0, true};
  model.soil = Soil{};
  model.canopy.corners = std::vector<Triangle>(4, Triangle{{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 2.0F}, {1.0F, 0.0F, 0.0F}}});
  model.canopy.organ_of = {0, 1, 2, 3};
  model.canopy.optics_of = {0, 0, 0, 0};
  model.canopy.organs = {
      {1, "stem", 0, Role::stem}, {1, "leaf", 1, Role::leaf}, {1, "pot", 0, Role::structure}, {2, "leaf", 1, Role::leaf}};
  model.bands.resize(1);
  return model;
}

TEST(OrganKinds, AreOrderedByRoleAndEndWithTheSoil) {
  const OrganKinds kinds(four_organs());
  ASSERT_EQ(kinds.of.size(), 4U);
  EXPECT_EQ(kinds.of[0].name, "leaf");
  EXPECT_EQ(kinds.of[0].organs, 2U);
  EXPECT_EQ(kinds.of[0].area_m2, 2.0);
  EXPECT_EQ(kinds.of[1].name, "stem");
  EXPECT_EQ(kinds.of[2].name, "pot");
  EXPECT_EQ(kinds.of[3].name, "soil");
  EXPECT_EQ(kinds.of[3].organs, 0U);
  EXPECT_EQ(kinds.of[3].area_m2, 10.0) << "the ground of [soil]";
  EXPECT_EQ(kinds.number_of, (std::vector<std::size_t>{1, 0, 2, 0}));
}

// Organs of 1 m2 on 10 m2 of ground; 2 of 1000 quanta absorbed are unshot.
RadiationResult result_of_four(double vegetation_half_width) {
  RadiationResult result;
  BandResult band{{{100.0, 0.0}, {30.0, vegetation_half_width}, {10.0, 0.7}, {40.0, 2.5}, {20.0, 1.0}, {}, 0.1}, "A"};
  band.ledger.absorbed_vegetation = 1000;
  band.ledger.unshot = 2;
  result.bands = {band};
  const auto organ = [](double w_m2, double half_width) {
    OrganResult of;
    of.area_m2 = 1.0;
    of.absorbed = {{w_m2, half_width}};
    return of;
  };
  result.organs = {organ(100.0, 4.2), organ(50.0, 3.1), organ(100.0, 9.0), organ(150.0, 4.3)};
  return result;
}

TEST(OrganKinds, ErrorsAddInQuadratureAndAreRaisedWhereTheWholeErrsMore) {
  // Without their unshot parts of 0.2, 0.1 and 0.3 the vegetation's organs have half-widths of 4, 3 and 4 W m-2.
  const double leaves = std::hypot(0.3, 0.4), all = std::hypot(leaves, 0.4), unshot = 0.04;
  const std::vector<KindFlux> usual = absorbed_by_kinds(four_organs(), result_of_four(0.2));
  ASSERT_EQ(usual.size(), 4U);
  EXPECT_DOUBLE_EQ(usual[0].absorbed.value, 20.0);
  EXPECT_NEAR(usual[0].absorbed.half_width, leaves + unshot, 1e-12);
  EXPECT_DOUBLE_EQ(usual[1].absorbed.value, 10.0);
  EXPECT_NEAR(usual[1].absorbed.half_width, 0.4 + 0.02, 1e-12);
  EXPECT_EQ(usual[2].absorbed.value, 10.0) << "the pot is all that the structures are";
  EXPECT_EQ(usual[2].absorbed.half_width, 0.7);
  EXPECT_EQ(usual[3].absorbed.value, 40.0);
  EXPECT_EQ(usual[3].absorbed.half_width, 2.5);
  EXPECT_EQ(usual[3].unshot, 0.1) << "all of it may end on the soil";
  const std::vector<KindFlux> raised = absorbed_by_kinds(four_organs(), result_of_four(0.1 + 3.0 * all));
  EXPECT_NEAR(raised[0].absorbed.half_width, 3.0 * leaves + unshot, 1e-12);
}

TEST(DayTables, KindsOfOrgansHaveARowOnEachDate) {
  const RadiationModel model = four_organs();
  StepLight first = no_light(model), last = first;
  EXPECT_EQ(first.kind_absorbed.size(), 4U);
  first.bands[0].incident = {100.0, 0.0};
  first.kind_absorbed[0] = {{20.0, 1.0}};
  first.kind_absorbed[3] = {{40.0, 2.0}};
  const regression::Table table(text_of(season_table, model, {first, last, last}));
  EXPECT_EQ(table.header(),
            "date,organ,role,organs,area_m2,area_index,A_absorbed_ground_mj_m2,A_absorbed_ground_mj_m2_error,"
            "A_absorbed_ground_mol_m2,A_absorbed_ground_mol_m2_error,A_absorbed_share,A_absorbed_share_error,A_absorbed_mj_m2,"
            "A_absorbed_mj_m2_error,A_absorbed_mol_m2,A_absorbed_mol_m2_error");
  ASSERT_EQ(table.size(), 8U);
  EXPECT_EQ(table.cell(0, "organ"), "leaf");
  EXPECT_EQ(table.cell(2, "role"), "structure");
  EXPECT_EQ(table.number(0, "area_index"), 0.2);
  EXPECT_EQ(table.number(0, "A_absorbed_ground_mj_m2"), 0.036);
  EXPECT_EQ(table.number(0, "A_absorbed_ground_mol_m2"), 0.144);
  EXPECT_EQ(table.number(0, "A_absorbed_share"), 0.2);
  EXPECT_EQ(table.number(0, "A_absorbed_share_error"), 0.01);
  EXPECT_EQ(table.number(0, "A_absorbed_mj_m2"), 0.18);
  EXPECT_EQ(table.number(3, "A_absorbed_mj_m2"), 0.072) << "per area of ground";
  EXPECT_EQ(table.cell(4, "date"), "2003-01-01");
  EXPECT_EQ(table.cell(4, "A_absorbed_share"), "") << "no light arrived";
}

TEST(DayTables, SensorsAndPlanesHaveStepsAndSums) {
  RadiationModel model = two_organs();
  model.sensors = {{"a", {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}}, {"b", {{0.7, 0.8, 0.9}}}};
  model.planes = {{0.25, 1, 1}, {0.5, 2, 1}};
  StepLight step = no_light(model);
  ASSERT_EQ(step.points.size(), 6U);
  step.points[2].direct = {7.0, 0.0};
  step.sensors[0].total = {10.0, 3.0};
  step.plane_sunfleck[1] = {0.75, 0.125};
  step.plane_down[2] = {50.0, 4.0};
  const std::vector<StepLight> lights{step, step, no_light(model)};
  const regression::Table points(text_of(sensors_day_table, model, lights));
  ASSERT_EQ(points.size(), 9U);
  EXPECT_EQ(points.cell(1, "time"), "2002-12-31T22:30:00-03:30");
  EXPECT_EQ(points.cell(1, "sensor"), "a");
  EXPECT_EQ(points.cell(1, "point"), "1");
  EXPECT_EQ(points.number(1, "z"), 0.6);
  EXPECT_EQ(points.number(1, "A_direct"), 7.0);
  EXPECT_EQ(points.cell(5, "sensor"), "b");
  const regression::Table means(text_of(sensor_means_day_table, model, lights));
  ASSERT_EQ(means.size(), 6U);
  EXPECT_EQ(means.number(0, "points"), 2.0);
  EXPECT_EQ(means.number(0, "A_total_umol_m2_s"), 40.0);
  const regression::Table sums(text_of(sensor_day_sums_table, model, lights));
  ASSERT_EQ(sums.size(), 4U);
  EXPECT_NEAR(sums.number(0, "A_total_mj_m2"), 0.024, 1e-12);
  EXPECT_NEAR(sums.number(0, "A_total_mj_m2_error"), 3e-6 * std::hypot(1800.0, 600.0), 1e-11);
  EXPECT_NEAR(sums.number(0, "A_total_mol_m2"), 0.096, 1e-12);
  EXPECT_EQ(sums.cell(2, "date"), "2003-01-01");
  const regression::Table planes(text_of(planes_day_table, model, lights));
  ASSERT_EQ(planes.size(), 6U);
  EXPECT_EQ(planes.number(1, "height_m"), 0.5);
  EXPECT_EQ(planes.number(1, "sunfleck_ratio"), 0.75);
  EXPECT_EQ(planes.cell(5, "sunfleck_ratio"), "") << "at night";
  EXPECT_EQ(planes.number(1, "A_down_umol_m2_s"), 200.0);
  const regression::Table plane_sums(text_of(plane_day_sums_table, model, lights));
  EXPECT_NEAR(plane_sums.number(1, "A_down_mj_m2"), 0.12, 1e-12);
}

// A table made date by date has the rows of one made at once.
TEST(DayTables, GrowDateByDate) {
  const RadiationModel model = two_organs();
  const DayStand stand(model);
  const DayCourse course = three_steps();
  const std::vector<StepLight> lights{no_light(model), no_light(model), no_light(model)};
  const DayCourse second = course_of(course, 1);
  EXPECT_EQ(steps_of(course, 0).size(), 2U);
  EXPECT_EQ(second.dates, std::vector<std::string>{"2003-01-01"});
  ASSERT_EQ(second.steps.size(), 1U);
  const DayCourse first = course_of(course, 0);
  for (const DayTable& table : day_tables(model)) {
    std::string grown = day_head(table, {}, stand, DayPart(first, {}), course, lights.size());
    grown += csv_rows(table.make(stand, DayPart(first, std::span(lights).first(2))));
    grown += csv_rows(table.make(stand, DayPart(second, std::span(lights).subspan(2))));
    EXPECT_EQ(grown, day_text(table, {}, stand, DayPart(course, lights))) << table.file;
  }
}

TEST(PlaneDay, SumsMapsOverTime) {
  RadiationModel model = two_organs();
  model.planes = {{0.25, 2, 1}};
  const DayCourse course = three_steps();
  PlaneMapSums sums(model);
  const float none = std::numeric_limits<float>::quiet_NaN();
  sums.add(course.steps[0], std::vector<float>{0.5F, none, 100.0F, 0.0F, 150.0F, 50.0F, 0.0F, 0.0F, 1.0F, 1.0F});
  sums.add_unlit();
  sums.add(course.steps[2], std::vector<float>{0.25F, 1.0F, 60.0F, 120.0F, 90.0F, 150.0F, 0.0F, 0.0F, 1.0F, 1.0F});
  const regression::Table table(csv_text({}, sums.table(course, 0)));
  EXPECT_EQ(table.header(),
            "x_m,z_m,sunlit_h,sunlit_share,A_direct_mj_m2,A_total_mj_m2,A_total_mol_m2,B_direct_mj_m2,B_total_mj_m2");
  EXPECT_EQ(table.comments().back(), "# dates 2, steps 3, hours with a direct beam 0.666666667");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_NEAR(table.number(0, "sunlit_h"), 1050.0 / 3600.0, 1e-9);
  EXPECT_NEAR(table.number(0, "sunlit_share"), 1050.0 / 2400.0, 1e-9);
  EXPECT_NEAR(table.number(0, "A_direct_mj_m2"), 0.216, 1e-9);
  EXPECT_NEAR(table.number(1, "A_total_mol_m2"), 0.72, 1e-9);
  // Where the share was unknown for a time, it counts as elsewhere at that time.
  EXPECT_NEAR(table.number(1, "sunlit_h"), 1500.0 / 3600.0, 1e-9);
  EXPECT_NEAR(table.number(1, "sunlit_share"), 1500.0 / 2400.0, 1e-9);
}

TEST(DayTables, SaysWhatIsMissing) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 3.0, 0.0)};
  for (const std::string& text : {text_of(steps_table, model, lights), text_of(organs_day_table, model, lights)}) {
    EXPECT_EQ(regression::Table(text).comments().back(), "# incomplete: the first 1 of 3 steps");
  }
  EXPECT_EQ(regression::Table(text_of(organs_day_table, model, lights)).size(), 2U);
  EXPECT_EQ(regression::Table(text_of(steps_table, model, {})).size(), 0U);
}

}  // namespace
}  // namespace sunfleck
