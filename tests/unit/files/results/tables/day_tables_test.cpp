#include "files/results/tables/day_tables.h"

#include "base/units.h"
#include "support/table.h"

#include <gtest/gtest.h>

#include <cmath>
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

StepLight light(double w_m2, double half_width, double unshot) {
  const StepBand band{{w_m2, 0.0},
                      {0.5 * w_m2, half_width},
                      {0.0625 * w_m2, half_width},
                      {0.25 * w_m2, half_width},
                      {0.125 * w_m2, half_width},
                      {0.0, half_width},
                      unshot};
  return {{band, band}, {{w_m2, half_width}, {2.0 * w_m2, half_width}, {0.0, 0.0}, {3.0 * w_m2, no_value}}, {0.5, 0.01}};
}

TEST(DayTables, LocalTimeCarriesItsOffset) {
  EXPECT_EQ(local_time_text({2002, 8, 7, 21, 0, 0.0}, 480), "2002-08-08T05:00:00+08:00");
  EXPECT_EQ(local_time_text({2003, 1, 1, 2, 0, 0.0}, -210), "2002-12-31T22:30:00-03:30");
  EXPECT_EQ(local_time_text({2003, 1, 1, 2, 0, 0.0}, 0), "2003-01-01T02:00:00+00:00");
}

TEST(DayTables, IncidentFluxOfAnIsolatedPlotHasAnError) {
  RadiationResult result;
  result.bands = {{"A", {}, 100.0, 1.0, {60.0, 1.5}, {30.0, 2.0}, {0.0, 1.0}, {9.0, 3.0}}};
  const StepLight endless = step_light(two_organs(), result);
  EXPECT_EQ(endless.bands[0].incident.value, 100.0);
  EXPECT_EQ(endless.bands[0].incident.half_width, 0.0);
  EXPECT_EQ(endless.bands[0].unshot, 1.0);
  EXPECT_EQ(step_light(two_organs(false), result).bands[0].incident.half_width, 7.5);
}

TEST(DayTables, RandomErrorsAddAsSquaresAndUnshotFluxAsItIs) {
  const std::vector<StepLight> lights{light(100.0, 3.0, 1.0), light(200.0, 13.0, 1.0), light(10.0, 5.0, 0.0)};
  const std::vector<DateSums> dates = sum_dates(two_organs(), three_steps(), lights);
  ASSERT_EQ(dates.size(), 2U);
  EXPECT_EQ(dates[0].steps, 2U);
  const StepBand& band = dates[0].bands[1];
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

TEST(DayTables, DayIsWrittenStepByStep) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 3.0, 1.0), night_light(model), light(10.0, no_value, 0.0)};
  const regression::Table table(day_csv({}, model, three_steps(), lights));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table.comments().size(), 4U);
  EXPECT_EQ(table.cell(0, "time"), "2002-12-31T22:30:00-03:30");
  EXPECT_EQ(table.number(0, "step_s"), 1800.0);
  EXPECT_NEAR(table.number(0, "elevation_deg"), 28.6478898, 1e-7);
  EXPECT_EQ(table.number(0, "B_absorbed_soil"), 25.0);
  EXPECT_EQ(table.number(0, "B_absorbed_soil_error"), 3.0);
  EXPECT_EQ(table.number(0, "sunlit_leaf_fraction"), 0.5);
  EXPECT_EQ(table.cell(1, "A_incident"), "0");
  EXPECT_EQ(table.cell(1, "sunlit_leaf_fraction_error"), "0");
  EXPECT_EQ(table.cell(2, "A_reflected_error"), "");
}

TEST(DayTables, DatesHaveSums) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 4.0, 1.0), night_light(model), light(10.0, 5.0, 0.0)};
  const regression::Table table(day_sums_csv({}, model, three_steps(), lights));
  std::string header = "date,steps";
  for (const char* name : {"incident", "absorbed_vegetation", "absorbed_structure", "absorbed_soil", "reflected"}) {
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
  EXPECT_EQ(table.cell(1, "date"), "2003-01-01");
  EXPECT_EQ(table.number(1, "A_incident_mj_m2"), 0.006);
}

TEST(DayTables, OrgansHaveSumsOfEachDate) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 3.0, 0.0), night_light(model), light(10.0, 5.0, 0.0)};
  const regression::Table table(organs_day_csv({}, model, three_steps(), lights));
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
  model.canopy.optics_names = {"leaf"};
  model.optics[0].upper = model.optics[0].lower = {{0.1, 0.1}, {0.4, 0.4}};
  model.canopy.plants = {{1, {0.5, 0.0, 0.25}}, {2, {1.0, 0.0, 1.0}}};
  const auto of_plants = [](double w, double half_width) {
    StepLight step = light(w, half_width, 0.0);
    step.plant_absorbed_w = {{w, half_width}, {2.0 * w, half_width}, {0.0, 0.0}, {3.0 * w, no_value}};
    return step;
  };
  const std::vector<StepLight> lights{of_plants(100.0, 3.0), night_light(model), of_plants(10.0, 5.0)};
  EXPECT_EQ(lights[1].plant_absorbed_w.size(), 4U);
  const regression::Table table(plants_day_csv({}, model, three_steps(), lights));
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

TEST(DayTables, SaysWhatIsMissing) {
  const RadiationModel model = two_organs();
  const std::vector<StepLight> lights{light(100.0, 3.0, 0.0)};
  for (const std::string& text :
       {day_csv({}, model, three_steps(), lights), organs_day_csv({}, model, three_steps(), lights)}) {
    EXPECT_EQ(regression::Table(text).comments().back(), "# incomplete: the first 1 of 3 steps");
  }
  EXPECT_EQ(regression::Table(organs_day_csv({}, model, three_steps(), lights)).size(), 2U);
  EXPECT_EQ(regression::Table(day_csv({}, model, three_steps(), {})).size(), 0U);
}

}  // namespace
}  // namespace sunfleck
