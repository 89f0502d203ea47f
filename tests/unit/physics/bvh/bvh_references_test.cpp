#include "physics/bvh/build.h"
#include "physics/bvh/bvh.h"
#include "physics/bvh/references.h"
#include "support/bvh_check.h"
#include "support/error_text.h"

#include <gtest/gtest.h>
#include <string>

namespace sunfleck::testing_bvh {
namespace {

Canopy periodic(std::vector<Triangle> corners) {
  Canopy canopy = isolated(std::move(corners));
  canopy.period_m = {2.0, 4.0};
  return canopy;
}

// Returns a triangle with the box lo_x..hi_x, 0..1, lo_z..hi_z.
Triangle spanning(float lo_x, float hi_x, float lo_z, float hi_z) {
  return {glm::vec3{lo_x, 0, lo_z}, glm::vec3{hi_x, 0, lo_z}, glm::vec3{lo_x, 1, hi_z}};
}

using Image = std::pair<int, int>;
std::vector<Image> images(const Canopy& canopy) {
  std::vector<Image> result;
  for (const Reference& r : make_references(canopy)) result.emplace_back(r.dx, r.dz);
  return result;
}
using Images = std::vector<Image>;

TEST(References, AreOneEachWithoutAPeriod) {
  const Canopy canopy = isolated({spanning(-5, 50, -5, 50), spanning(0, 1, 0, 1)});
  EXPECT_EQ(images(canopy), (Images{{0, 0}, {0, 0}}));
  EXPECT_EQ(make_references(canopy)[1].element, 1U);
  EXPECT_EQ(border_margin_m(canopy), glm::vec2(0.0F));
}

TEST(References, RepeatWhatCrossesTheBorder) {
  EXPECT_EQ(images(periodic({spanning(0.5F, 1.5F, 0.5F, 3.5F)})), (Images{{0, 0}}));
  EXPECT_EQ(images(periodic({spanning(1.5F, 2.1F, 0.5F, 3.5F)})), (Images{{0, 0}, {-1, 0}}));
  EXPECT_EQ(images(periodic({spanning(-0.1F, 0.9F, 0.5F, 3.5F)})), (Images{{0, 0}, {1, 0}}));
  EXPECT_EQ(images(periodic({spanning(0.5F, 1.5F, 3.5F, 4.1F)})), (Images{{0, 0}, {0, -1}}));
  EXPECT_EQ(images(periodic({spanning(-0.1F, 0.9F, 3.5F, 4.1F)})), (Images{{0, 0}, {0, -1}, {1, -1}, {1, 0}}));
}

TEST(References, CoverThePlotWithALeafLargerThanIt) {
  // Along x it is 3 periods long, -2..4, so copies -2..2 touch the closed plot 0..2; along z it spans -3..7, so copies -1..1
  // overlap the plot and none ends on its border.
  const Images all = images(periodic({spanning(-2.0F, 4.0F, -3.0F, 7.0F)}));
  EXPECT_EQ(all.size(), 15U);
  EXPECT_EQ(all.front(), Image(0, 0));
  EXPECT_EQ(*std::min_element(all.begin(), all.end()), Image(-2, -1));
  EXPECT_EQ(*std::max_element(all.begin(), all.end()), Image(2, 1));
}

TEST(References, ReachAMarginBeyondTheBorder) {
  const glm::vec2 margin_m = border_margin_m(periodic({}));
  EXPECT_EQ(margin_m, glm::vec2(std::exp2(-17.0F), std::exp2(-16.0F)));
  EXPECT_EQ(images(periodic({spanning(margin_m.x / 2, 1.0F, 0.5F, 3.5F)})).size(), 2U);
  EXPECT_EQ(images(periodic({spanning(margin_m.x * 2, 1.0F, 0.5F, 3.5F)})).size(), 1U);
  EXPECT_EQ(images(periodic({spanning(0.5F, 1.0F, 0.5F, 4.0F - margin_m.y / 2)})).size(), 2U);
  EXPECT_EQ(images(periodic({spanning(0.5F, 1.0F, 0.5F, 4.0F - margin_m.y * 2)})).size(), 1U);
}

TEST(References, LeaveOutWhatHasNoArea) {
  const glm::vec3 p{1, 1, 1};
  const Canopy canopy = isolated({{p, p, p}, spanning(0, 1, 0, 1), {p, 2.0F * p, 3.0F * p}});
  ASSERT_EQ(make_references(canopy).size(), 1U);
  EXPECT_EQ(make_references(canopy).front().element, 1U);
  EXPECT_TRUE(build_bvh(isolated({{p, p, p}}), 1e-3F).nodes.empty());
}

TEST(References, MoveCornersByWholePeriods) {
  const Canopy canopy = periodic({spanning(1.5F, 2.25F, 3.5F, 4.25F)});
  const Triangle moved = reference_corners(canopy, {0, -1, 3});
  EXPECT_EQ(moved[0], glm::vec3(-0.5F, 0.0F, 15.5F));
  EXPECT_EQ(moved[1], glm::vec3(0.25F, 0.0F, 15.5F));
  EXPECT_EQ(moved[2], glm::vec3(-0.5F, 1.0F, 16.25F));
}

TEST(References, PackTheirImage) {
  EXPECT_EQ(pack_image(0, 0), 0U);
  EXPECT_EQ(pack_image(-1, 2), 0x0002ffffU);
  EXPECT_EQ(pack_image(-32768, -1), 0xffff8000U);
}

TEST(References, StandInAPeriodicTree) {
  const Canopy canopy = periodic({spanning(-2.5F, 4.5F, -3.0F, 7.0F), spanning(1.5F, 2.25F, 3.5F, 4.25F)});
  const Bvh bvh = build_bvh(canopy, 1e-5F);
  const Inspector inspector(canopy, bvh, static_cast<double>(1e-5F));
  for (const BvhTriangle& t : bvh.triangles) {
    const auto dx = static_cast<std::int16_t>(t.image & 0xffffU);
    const auto dz = static_cast<std::int16_t>(t.image >> 16U);
    const Triangle expected = reference_corners(canopy, {t.element, dx, dz});
    EXPECT_EQ(glm::vec3(corner(t.a)), expected[0]);
    EXPECT_EQ(glm::vec3(corner(t.b)), expected[1]);
    EXPECT_EQ(glm::vec3(corner(t.c)), expected[2]);
  }
}

std::string refusal(const Canopy& canopy) {
  return refusal_of([&] { static_cast<void>(make_references(canopy)); });
}

TEST(References, RefuseTooManyPeriods) {
  EXPECT_EQ(images(periodic({spanning(1.0F, 65000.0F, 1.0F, 2.0F)})).size(), 32501U);
  EXPECT_EQ(refusal(periodic({spanning(1.0F, 2.0F, 1.0F, 2.0F), spanning(1.0F, 65540.0F, 1.0F, 2.0F)})),
            "plot.size: element 1 reaches over 32771 periods of 2 m (a copy may lie at most 32767 periods away); enlarge "
            "plot.size, leave this element out, or set plot.periodic = false");
}

TEST(References, RefuseMoreThanATreeHolds) {
  const Triangle huge = spanning(1.0F, 60000.0F, 1.0F, 120000.0F);
  EXPECT_NE(refusal(periodic({huge, huge, huge})).find("a tree holds at most 2147483648"), std::string::npos);
}

}  // namespace
}  // namespace sunfleck::testing_bvh
