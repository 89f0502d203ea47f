#include "files/results/tables/result_writer.h"

#include "base/units.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"
#include "support/table.h"
#include "support/triangles_csv.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace sunfleck {
namespace {

using nlohmann::json;
// Returns two triangles of two organs and two bands: A is black, B scatters.
RadiationModel small_model() {
  RadiationModel model;
  model.plot = {2.0, 3.0, true};
  model.canopy.origin_m = {10.0, 20.0, 30.0};
  model.canopy.corners = {{{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}}},
                          {{{0.0F, 3.0F, 0.0F}, {0.0F, 3.0F, 3.0F}, {3.0F, 3.0F, 0.0F}}}};
  model.canopy.organ_of = {0, 1};
  model.canopy.optics_of = {0, 0};
  model.canopy.organs = {{1, "leaf", 7}, {2, "a \"tip\", dry", 0}};
  model.canopy.optics_names = {"leaf"};
  model.optics = {{"leaf", {{0.0, 0.0}, {0.5, 0.25}}, {{0.0, 0.0}, {0.25, 0.0}}, {}}};
  model.bands = {{"A", 100.0, 0.0}, {"B", 200.0, 0.0}};
  model.sun = SunPosition{0.5, 1.0};
  model.layers = 1;
  return model;
}

RadiationResult small_result() {
  RadiationResult result;
  const BandFluxes a{{100.0, 0.0}, {60.0, 1.0}, {0.0, 0.0}, {30.0, 2.0}, {0.0, 0.0}, {10.0, no_value}};
  const BandFluxes b{{200.0, 0.0}, {100.0, 21.0}, {0.0, 0.0}, {60.0, 22.0}, {0.0, 20.0}, {20.0, 20.0}, 20.0};
  result.bands = {{a, "A", {100, 60, 0, 30, 0, 10, 0}}, {b, "B", {100, 50, 0, 30, 0, 10, 10}}};
  OrganResult leaf{
      0.5, {0.25, no_value}, {{1.0 / 3.0, 0.1}, {2.0, 0.1}}, {{0.0, 0.0}, {0.75, 0.01}}, {{0.0, 0.0}, {1.5, 0.03}}};
  result.organs = {leaf, leaf};
  LayerResult layer{0.0,
                    0.5,
                    {0.4, 0.01},
                    {no_value, no_value},
                    {{40.0, 1.0}, {80.0, 2.0}},
                    {{0.0, 0.0}, {7.0, 0.5}},
                    {{60.0, 1.0}, {90.0, 2.0}},
                    {{0.5, 0.25}, {1.5, 0.75}}};
  LayerResult top = layer;
  top.height_m = 3.0;
  top.absorbed.clear();
  top.absorbed_structure.clear();
  result.layers = {layer, top};
  result.elements = {{20, 4}, {0, 0}};
  result.element_error = {0.5, no_value, 0.75, no_value};
  result.sunlit_leaf_fraction = {0.5, no_value};
  result.ground_sunfleck_ratio = {no_value, no_value};
  result.ground_per_ray_m2 = 0.01;
  result.side_indirect = {0, 100, 0, 300, 0, 0, 0, 0};
  result.w_per_quantum = {0.5, 0.01};
  result.direct.rays = 600;
  return result;
}

RunRecord small_record() {
  RunRecord record;
  record.version = "9.8.7";
  record.title = "Two\nlines";
  record.seed = 42;
  return record;
}

void expect_head(const regression::Table& table) {
  ASSERT_EQ(table.comments().size(), 4U);
  EXPECT_EQ(table.comments()[0], "# Two lines");
  EXPECT_EQ(table.comments()[2], "# seed 42, confidence 0.95");
  EXPECT_NE(table.comments()[3].find("W m-2"), std::string::npos);
}

TEST(ResultWriter, ProfileHasALayerARowAndTheTopPlane) {
  const regression::Table table(csv_text(small_record(), layers_table(small_model(), small_result())));
  expect_head(table);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table.cell(0, "leaf_area_index"), "0.5");
  EXPECT_EQ(table.cell(0, "sunlit_leaf_fraction"), "");
  EXPECT_EQ(table.cell(0, "A_down"), "40");
  EXPECT_EQ(table.cell(0, "A_up"), "0");
  EXPECT_EQ(table.cell(0, "B_up"), "7");
  EXPECT_EQ(table.cell(0, "B_up_error"), "0.5");
  EXPECT_EQ(table.cell(0, "B_absorbed_error"), "2");
  EXPECT_EQ(table.cell(1, "height_m"), "3");
  for (const char* column : {"leaf_area_index", "A_absorbed", "A_absorbed_error"})
    EXPECT_EQ(table.cell(1, column), "") << column;
}

TEST(ResultWriter, OrgansAreQuotedAndUnknownsEmpty) {
  const std::string text = csv_text(small_record(), organs_table(small_model(), small_result()));
  const regression::Table table(text);
  expect_head(table);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_NE(text.find("2,\"a \"\"tip\"\", dry\",0,"), std::string::npos) << text;
  EXPECT_EQ(table.cell(1, "organ"), "a \"tip\", dry");
  EXPECT_EQ(table.cell(0, "sunlit_fraction_error"), "");
  EXPECT_EQ(table.cell(0, "A_direct"), "0.333333333") << "nine digits";
  EXPECT_EQ(table.cell(0, "A_indirect"), "0");
  EXPECT_EQ(table.cell(0, "B_indirect"), "0.75");
  EXPECT_EQ(table.number(0, "B_absorbed_error"), 0.02 * table.number(0, "B_absorbed")) << "in W m-2";
}

TEST(ResultWriter, HeadsTellWhatSunlitSharesAre) {
  const std::string organs = csv_head(small_record(), organs_table(small_model(), small_result()));
  EXPECT_NE(organs.find("; sunlit_fraction: share of the area in direct sun;"), std::string::npos) << organs;
  const std::string plants = csv_head(small_record(), plants_table(small_model(), small_result()));
  EXPECT_NE(plants.find("; sunlit_leaf_fraction: share of the leaf area in direct sun;"), std::string::npos) << plants;
}

TEST(ResultWriter, TrianglesStandInTheScenesFrame) {
  const regression::Table table(triangles_csv(small_record(), small_model(), small_result()));
  expect_head(table);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table.cell(1, "triangle"), "1");
  EXPECT_EQ(table.cell(1, "area_m2"), "4.5");
  EXPECT_EQ(table.number(1, "x"), 11.0);
  EXPECT_EQ(table.number(1, "y"), 23.0);
  EXPECT_EQ(table.number(1, "z"), 31.0);
  // 20 and 4 landings, each of 0.01 m2 of level ground, hit 0.5 m2.
  EXPECT_NEAR(table.number(0, "A_direct_upper"), 40.0, 1e-6);
  EXPECT_NEAR(table.number(0, "A_direct_lower"), 8.0, 1e-6);
  EXPECT_NEAR(table.number(0, "A_absorbed"), 48.0, 1e-6);
  // 100 and 300 quanta of 0.01 W land on 0.5 m2.
  EXPECT_NEAR(table.number(0, "B_indirect_upper"), 2.0, 1e-6);
  EXPECT_NEAR(table.number(0, "B_indirect_lower"), 6.0, 1e-6);
  EXPECT_EQ(table.cell(0, "A_indirect_upper"), "0");
  EXPECT_NEAR(table.number(0, "B_absorbed"), 0.25 * (80.0 + 2.0) + 0.75 * (16.0 + 6.0), 1e-6);
  EXPECT_EQ(table.cell(0, "A_absorbed_error"), "0.5");
  EXPECT_EQ(table.cell(0, "B_absorbed_error"), "0.75");
  EXPECT_EQ(table.cell(1, "B_absorbed_error"), "");
}

TEST(ResultWriter, TrianglesWithoutIntervals) {
  RadiationResult result = small_result();
  result.element_error.clear();
  const regression::Table table(triangles_csv(small_record(), small_model(), result));
  EXPECT_EQ(table.cell(0, "A_absorbed_error"), "");
  EXPECT_EQ(table.cell(0, "B_absorbed_error"), "");
}

TEST(ResultWriter, TheHeadOfTrianglesSaysWhetherErrorsAreMissing) {
  RadiationResult result = small_result();
  const auto text = [&] { return triangles_csv(small_record(), small_model(), result); };
  EXPECT_NE(text().find("half-width of the confidence interval, empty below 20 hits\n"), std::string::npos);
  result.element_error = {0.5, 0.25, 0.75, 0.0};
  EXPECT_NE(text().find("half-width of the confidence interval\n"), std::string::npos) << text();
}

TEST(ResultWriter, SummaryHasNullForUnknowns) {
  RunRecord record = small_record();
  record.complete = false;
  record.grid_m = 0.002;
  const json summary = json::parse(summary_json(record, small_model(), small_result()));
  EXPECT_EQ(summary["sunfleck"], "9.8.7");
  EXPECT_EQ(summary["scene"], "Two\nlines");
  EXPECT_EQ(summary["complete"], false);
  EXPECT_EQ(summary["settings"]["grid_m"], 0.002);
  EXPECT_TRUE(summary["settings"]["passes"].is_null());
  EXPECT_EQ(summary["triangles"], 2);
  EXPECT_EQ(summary["plants"], 2);
  EXPECT_EQ(summary["plot_area_m2"], 6.0);
  EXPECT_TRUE(summary["ground_sunfleck_ratio"].is_null());
  EXPECT_TRUE(summary["direct"]["bound"].is_null());
  EXPECT_NEAR(summary["sun"]["elevation_deg"], 28.64788975654116, 1e-9);
  ASSERT_EQ(summary["bands"].size(), 2U);
  EXPECT_EQ(summary["bands"][1]["unshot"], 20.0);
  EXPECT_EQ(summary["bands"][1]["residual"], 0);
  EXPECT_TRUE(summary["bands"][0]["error"]["transmitted"].is_null());
}

TEST(ResultWriter, PhotonsHaveErrorsOfTheirOwn) {
  RadiationModel model = small_model();
  model.bands[1].umol_per_joule = 2.0;
  const json photons = json::parse(summary_json(small_record(), model, small_result()))["bands"][1]["umol_m2_s"];
  EXPECT_EQ(photons["absorbed_soil"], 120.0);
  EXPECT_EQ(photons["error"]["absorbed_soil"], 44.0);
  const regression::Table organs(csv_text(small_record(), organs_table(model, small_result())));
  EXPECT_EQ(organs.cell(0, "B_absorbed_umol_m2_s"), "3");
  EXPECT_EQ(organs.cell(0, "B_absorbed_umol_m2_s_error"), "0.06");
}

TEST(ResultWriter, SummaryWithoutASun) {
  RadiationModel model = small_model();
  model.sun.reset();
  EXPECT_TRUE(json::parse(summary_json(small_record(), model, small_result()))["sun"].is_null());
}

TEST(ResultWriter, ATitleThatIsNoUtf8IsNoReasonToLoseAResult) {
  RunRecord record = small_record();
  record.title = "caf\xe9";
  EXPECT_FALSE(json::parse(summary_json(record, small_model(), small_result()), nullptr, false).is_discarded());
}

}  // namespace
}  // namespace sunfleck
