#include "files/results/tables/plane_writer.h"

#include "physics/transport/model/receivers.h"
#include "support/small_plane.h"
#include "support/table.h"

#include <gtest/gtest.h>

#include <limits>

namespace sunfleck {
namespace {

RunRecord plane_record() {
  RunRecord record;
  record.title = "A\nplane";
  record.seed = 7;
  return record;
}

TEST(PlaneWriter, NamesItsFilesByHeight) {
  EXPECT_EQ(plane_stem(0.5), "plane_0.500");
  EXPECT_EQ(plane_stem(12.3456), "plane_12.346");
  EXPECT_EQ(plane_stem(-0.0001), "plane_0.000");
  EXPECT_EQ(plane_stem(-0.25), "plane_-0.250");
}

TEST(PlaneWriter, ACellARow) {
  const auto [model, result] = test::small_plane();
  const regression::Table table(plane_csv(plane_record(), model, result, 0));
  ASSERT_EQ(table.comments().size(), 6U);
  EXPECT_EQ(table.comments()[0], "# A plane");
  EXPECT_EQ(table.comments()[2], "# seed 7, confidence 0.95");
  EXPECT_EQ(table.comments()[4], "# sunfleck ratio 0.3, error 0.01; 10 beam rays a cell without the canopy");
  EXPECT_EQ(table.comments()[5],
            "# flecks (joined cells with sunfleck >= 0.5): 1, together 0.333333333 of the plane; median 10000 cm2, largest "
            "10000 cm2");
  EXPECT_EQ(table.header(), "x_m,z_m,sunfleck,PAR_direct,PAR_total,NIR_direct,NIR_total");
  ASSERT_EQ(table.size(), 6U);
  EXPECT_EQ(table.cell(0, "x_m"), "0.25");
  EXPECT_EQ(table.cell(0, "z_m"), "0.5");
  EXPECT_EQ(table.cell(1, "x_m"), "0.75");
  EXPECT_EQ(table.cell(2, "z_m"), "1.5");
  EXPECT_EQ(table.cell(0, "sunfleck"), "1");
  EXPECT_EQ(table.cell(2, "sunfleck"), "0.5");
  EXPECT_EQ(table.cell(4, "sunfleck"), "0");
  EXPECT_EQ(table.cell(5, "sunfleck"), "") << "no ray crosses it";
  // 12 rays, each of 1/24 m2 of 100 W m-2, and 10 quanta of 0.5 W cross 0.5 m2.
  EXPECT_NEAR(table.number(0, "PAR_direct"), 100.0, 1e-6);
  EXPECT_NEAR(table.number(0, "PAR_total"), 110.0, 1e-6);
  EXPECT_NEAR(table.number(0, "NIR_total"), 200.0, 1e-6);
  EXPECT_EQ(table.cell(1, "PAR_direct"), "0");
  EXPECT_NEAR(table.number(1, "PAR_total"), 20.0, 1e-6);
  EXPECT_NEAR(table.number(2, "NIR_total"), 102.0, 1e-6);
}

TEST(PlaneWriter, AClassOfFlecksARow) {
  const auto [model, result] = test::small_plane();
  const regression::Table table(plane_flecks_csv(plane_record(), model, result, 0));
  EXPECT_EQ(table.header(), "lower_cm2,upper_cm2,flecks,area_share");
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table.cell(0, "lower_cm2"), "10000");
  EXPECT_EQ(table.cell(0, "upper_cm2"), "20000");
  EXPECT_EQ(table.cell(0, "flecks"), "1");
  EXPECT_NEAR(table.number(0, "area_share"), 1.0 / 3.0, 1e-8);
}

TEST(PlaneWriter, SizesOfFlecksNeedTenRaysACell) {
  auto [model, result] = test::small_plane();
  for (std::uint64_t& rays : result.planes[0].crossing) rays = rays * 3 / 4;
  const std::string why =
      "# no sizes of flecks: too few rays: 7.5 a cell, 10 are needed; use a coarser cells = [1, 2] or a smaller error";
  const regression::Table map(plane_csv(plane_record(), model, result, 0));
  EXPECT_EQ(map.comments().back(), why);
  EXPECT_EQ(map.size(), 6U) << "the map itself is there";
  const regression::Table sizes(plane_flecks_csv(plane_record(), model, result, 0));
  EXPECT_EQ(sizes.comments().back(), why);
  EXPECT_EQ(sizes.size(), 0U);
}

TEST(PlaneWriter, WithoutABeamTheSunfleckCellsAreEmpty) {
  auto [model, result] = test::small_plane();
  model.sun.reset();
  result.planes[0].reached.clear();
  result.planes[0].crossing.clear();
  result.planes[0].sunfleck_ratio.value = std::numeric_limits<double>::quiet_NaN();
  const regression::Table table(plane_csv(plane_record(), model, result, 0));
  EXPECT_EQ(table.comments().back(), "# no direct beam");
  ASSERT_EQ(table.size(), 6U);
  EXPECT_EQ(table.cell(0, "sunfleck"), "");
  EXPECT_EQ(table.cell(0, "PAR_direct"), "0");
  EXPECT_NEAR(table.number(0, "PAR_total"), 10.0, 1e-6);
  EXPECT_EQ(regression::Table(plane_flecks_csv(plane_record(), model, result, 0)).size(), 0U);
}

TEST(PlaneWriter, WithoutOtherLightTotalIsDirect) {
  auto [model, result] = test::small_plane();
  result.planes[0].down.clear();
  const regression::Table table(plane_csv(plane_record(), model, result, 0));
  EXPECT_EQ(table.cell(0, "PAR_total"), table.cell(0, "PAR_direct"));
}

}  // namespace
}  // namespace sunfleck
