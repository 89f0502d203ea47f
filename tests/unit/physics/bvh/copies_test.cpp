// Tests triangles that lie exactly on others: they are found whatever their winding, listed in the tables, and ignored by
// light.
#include "physics/bvh/references.h"
#include "support/models.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

const Triangle leaf{{{0.1F, 0.5F, 0.1F}, {0.1F, 0.5F, 0.4F}, {0.4F, 0.5F, 0.2F}}};

TEST(Copies, AreFoundInAnyOrderOfTheirCorners) {
  const std::vector<Triangle> corners{
      leaf, {leaf[1], leaf[2], leaf[0]}, {leaf[0], leaf[1], {0.4F, 0.5F, 0.3F}}, {leaf[2], leaf[1], leaf[0]}, leaf};
  EXPECT_EQ(find_copies(corners), (std::vector<Copy>{{1, 0}, {3, 0}, {4, 0}}));
}

TEST(Copies, NeedTheSameCornersToTheLastBit) {
  Triangle near = leaf;
  near[2].x = std::nextafter(near[2].x, 1.0F);
  EXPECT_TRUE(find_copies(std::vector<Triangle>{leaf, near}).empty());
  Triangle zero = leaf;
  Triangle negative_zero = leaf;
  zero[0].x = 0.0F;
  negative_zero[0].x = -0.0F;
  EXPECT_EQ(find_copies(std::vector<Triangle>{zero, negative_zero}).size(), 1U);
}

TEST(Copies, OfTrianglesWithoutAreaAreNone) {
  const Triangle point{leaf[0], leaf[0], leaf[0]};
  EXPECT_TRUE(find_copies(std::vector<Triangle>{point, point}).empty());
  EXPECT_TRUE(find_copies({}).empty());
}

// A leaf that is one period away is the same leaf once it is wrapped into the plot.
TEST(Copies, AreFoundAcrossThePeriod) {
  MeshMaker maker;
  maker.level(0.25, 0.5, 0.25, 0.5, 1.0);
  maker.level(1.25, 1.5, 2.25, 2.5, 1.0);
  const PlacedMesh placed{maker.mesh(), {Placement{}}};
  EXPECT_EQ(assemble_canopy(std::span(&placed, 1), {1.0, 1.0, true}).copies, (std::vector<Copy>{{2, 0}, {3, 1}}));
  EXPECT_TRUE(assemble_canopy(std::span(&placed, 1), {1.0, 1.0, false}).copies.empty());
}

TEST(Copies, StayOutOfTheTree) {
  MeshMaker maker;
  for (int times = 0; times < 3; ++times) maker.level(0.25, 0.5, 0.25, 0.5, 1.0);
  const PlacedMesh placed{maker.mesh(), {Placement{}}};
  const Canopy canopy = assemble_canopy(std::span(&placed, 1), {1.0, 1.0, true});
  EXPECT_EQ(canopy.size(), 6U);
  EXPECT_EQ(copied_elements(canopy.copies, canopy.size()), (std::vector<bool>{false, false, true, true, true, true}));
  for (const Reference& reference : make_references(canopy)) EXPECT_LT(reference.element, 2U);
}

}  // namespace
}  // namespace sunfleck::test
