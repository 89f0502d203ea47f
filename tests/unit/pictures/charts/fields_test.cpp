// Tests the values that pictures show, and the limits of their scales.
#include "pictures/charts/fields.h"

#include "pictures/charts/colouring.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

TEST(LeafValues, CountTheLeavesOnceAndTheSoilNot) {
  const RadiationModel model = leaves_in_the_open();
  const Prepared prepared(model);
  const RadiationResult result =
      simulate(model, prepared, fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8}));
  const FieldValues sides = field_values(model, prepared.layout, result, 0, LightField::total);
  const FieldValues leaves = leaf_values(model, sides, LightField::total);
  EXPECT_EQ(sides.first_cell, 2 * model.canopy.size());
  double area = 0.0;
  for (const double own : leaves.area_m2) area += own;
  EXPECT_NEAR(area, 30 * 0.01, 1e-6);
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    EXPECT_EQ(leaves.w_m2[2 * e], sides.w_m2[2 * e] + sides.w_m2[2 * e + 1]);
    EXPECT_EQ(leaves.w_m2[2 * e + 1], leaves.w_m2[2 * e]);
  }
  for (std::size_t k = sides.first_cell; k < sides.w_m2.size(); ++k) {
    EXPECT_EQ(leaves.w_m2[k], sides.w_m2[k]);
    EXPECT_EQ(leaves.area_m2[k], 0.0);
  }
  const FieldValues absorbed = field_values(model, prepared.layout, result, 0, LightField::absorbed);
  EXPECT_EQ(leaf_values(model, absorbed, LightField::absorbed).w_m2, absorbed.w_m2) << "already of both faces";
}

TEST(LeafValues, OfBareSoilAreThoseOfTheSoil) {
  const RadiationModel model = leaf_model({}, unit_plot, sun_at(30.0, 120.0), std::array{par_band});
  const Prepared prepared(model);
  const RadiationResult result = simulate(model, prepared, fixed_work(model, 1e4, 8));
  const FieldValues sides = field_values(model, prepared.layout, result, 0, LightField::direct);
  EXPECT_EQ(leaf_values(model, sides, LightField::direct).area_m2, sides.area_m2);
}

TEST(LargestPossible, IsWhatClosedFormsGive) {
  const RadiationModel model = leaves_in_the_open();
  EXPECT_NEAR(largest_possible_w_m2(model, 0, LightField::direct, 1), 2.0, 1e-9) << "the sun stands at 30 degrees";
  EXPECT_NEAR(largest_possible_w_m2(model, 0, LightField::sky, 1), 1.0, 1e-9) << "a sphere under a uniform sky";
  EXPECT_NEAR(largest_possible_w_m2(model, 0, LightField::total, 1), 3.0 / (1.0 - 0.18), 1e-9);
  EXPECT_NEAR(largest_on_soil_w_m2(model, 0, LightField::direct), 1.0, 1e-9);
  EXPECT_NEAR(largest_on_soil_w_m2(model, 0, LightField::sky), 0.5, 1e-9);
  EXPECT_NEAR(largest_on_soil_w_m2(model, 0, LightField::total), 1.5 + 3.0 * 0.18 / (1.0 - 0.18), 1e-9);
  RadiationModel mirrors = model;
  mirrors.soil->reflectance[0] = 1.0;
  EXPECT_TRUE(std::isinf(largest_possible_w_m2(mirrors, 0, LightField::total, 1)));
}

// One sliver has a hundred times the light that the sun can give.
TEST(ColourField, EndsNoScaleAboveWhatIsPossible) {
  FieldValues values{{5.0, 20.0, 30.0, 40.0, 50.0, 9000.0}, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}};
  const SurfaceColours surfaces{std::vector<Colour>(6, Colour{0.5, 0.5, 0.5}), "leaf", {0.5, 0.5, 0.5}};
  ScaleLimits limits;
  limits.largest_w_m2 = 90.0;
  EXPECT_EQ(colour_field(ChartKind::map, values, surfaces, "", limits).legend.bar->hi, 90.0);
  EXPECT_GT(colour_field(ChartKind::map, values, surfaces, "").legend.bar->hi, 90.0);
  EXPECT_EQ(colour_field(ChartKind::rank_interval, values, surfaces, "", limits).legend.entries.front().label.substr(0, 8),
            "≥ 72.0");
  limits.top_w_m2 = 200.0;
  EXPECT_EQ(colour_field(ChartKind::map, values, surfaces, "", limits).legend.bar->hi, 200.0) << "a given end stands";
}

TEST(LitFrom, IsAThousandthOfTheLightThatIsShown) {
  const RadiationModel model = leaves_in_the_open();
  const double beam = model.bands[0].direct_w_m2;
  EXPECT_DOUBLE_EQ(lit_from_w_m2(model, 0, LightField::direct), 1e-3 * beam);
  EXPECT_DOUBLE_EQ(lit_from_w_m2(model, 0, LightField::sky), 1e-3 * 0.5);
  EXPECT_DOUBLE_EQ(lit_from_w_m2(model, 0, LightField::scattered), 1e-3 * (beam + 0.5));
}

// Leaves of two faces' light, and soil with less than any of them.
TEST(ColourField, DrawsTheSoilOnAScaleOfItsOwn) {
  FieldValues values{{0.5, 2.0, 3.0, 4.0, 0.0, 0.25, 0.5}, {1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0}};
  values.first_cell = 4;
  ScaleLimits limits;
  limits.lit_from_w_m2 = 1.0;
  const Colouring colouring = colour_field(ChartKind::rank, values, {}, "", limits);
  EXPECT_EQ(colouring.colours[0], rank_colour(unlit_rank));
  const auto brightness = [&](std::size_t i) { return colouring.colours[i][1]; };
  EXPECT_LT(brightness(4), brightness(5));
  EXPECT_LT(brightness(5), brightness(6));
  ASSERT_GE(colouring.legend.entries.size(), 3U);
  const LegendEntry* const last = &colouring.legend.entries.back();
  EXPECT_EQ(last[-2].label, "unlit   25 %");
  EXPECT_EQ(last[-1].label, "soil at 0.5");
  EXPECT_EQ(last[-1].colour, colouring.colours[6]);
  EXPECT_EQ(last[0].label, "soil at 0");
  EXPECT_EQ(last[0].colour, colouring.colours[4]);
}

TEST(ColourField, GivesBareSoilTheFiveClasses) {
  FieldValues values{{1.0, 2.0, 3.0, 4.0, 5.0}, {1.0, 1.0, 1.0, 1.0, 1.0}};
  values.first_cell = 0;
  const Colouring colouring = colour_field(ChartKind::rank, values, {}, "");
  for (int rank = 0; rank < 5; ++rank) EXPECT_EQ(colouring.colours[static_cast<std::size_t>(rank)], rank_colour(rank));
  EXPECT_EQ(colouring.legend.entries.size(), 5U);
}

}  // namespace
}  // namespace sunfleck::test
