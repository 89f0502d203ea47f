#include "programs/tradeoff/coarse_mesh.h"
#include "physics/canopy/maize.h"

#include <gtest/gtest.h>

#include <set>
#include <span>
#include <tuple>

namespace sunfleck {
namespace {

Canopy assembled(const Mesh& mesh, const Plot& plot) {
  const PlacedMesh placed{mesh, {Placement{}}};
  return assemble_canopy(std::span(&placed, 1), plot);
}

Canopy one_maize_plant() {
  return assembled(make_maize({1, 1, 2.0, 2.0, 1}), {2.0, 2.0, false});
}

using Corner = std::tuple<float, float, float>;

std::set<Corner> corners_of(const Canopy& canopy) {
  std::set<Corner> corners;
  for (const Triangle& triangle : canopy.corners) {
    for (const glm::vec3& corner : triangle) corners.emplace(corner.x, corner.y, corner.z);
  }
  return corners;
}

std::vector<double> organ_areas_m2(const Canopy& canopy) {
  std::vector<double> areas(canopy.organs.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) areas[canopy.organ_of[e]] += area_m2(canopy.corners[e]);
  return areas;
}

TEST(CoarseMesh, KeepsTheShareTheOrgansAndTheirAreas) {
  const Canopy fine = one_maize_plant();
  const Canopy coarse = coarsened(fine, 0.25);
  EXPECT_EQ(coarse.organs, fine.organs);
  EXPECT_EQ(coarse.optics_names, fine.optics_names);
  EXPECT_EQ(coarse.origin_m, fine.origin_m);
  EXPECT_EQ(coarse.period_m, fine.period_m);
  EXPECT_EQ(coarse.organ_of.size(), coarse.size());
  EXPECT_EQ(coarse.optics_of.size(), coarse.size());
  const auto kept = static_cast<double>(coarse.size()) / static_cast<double>(fine.size());
  EXPECT_NEAR(kept, 0.25, 0.05);
  // A quarter as many triangles are twice as long: on a surface of curvature k a chord of length l deviates by k l^2 / 8, and
  // the area by a few percent of the blade's undulation.
  const std::vector<double> before = organ_areas_m2(fine), after = organ_areas_m2(coarse);
  for (std::size_t o = 0; o < before.size(); ++o) EXPECT_NEAR(after[o], before[o], 0.1 * before[o]) << fine.organs[o].name;
}

TEST(CoarseMesh, MovesNoCorner) {
  const Canopy fine = one_maize_plant();
  const std::set<Corner> all = corners_of(fine);
  for (const Corner& corner : corners_of(coarsened(fine, 0.1))) EXPECT_TRUE(all.count(corner) == 1);
}

TEST(CoarseMesh, UpperFacesStayUp) {
  // Builds a level sheet of 2 x 8 x 8 triangles that face up.
  Mesh sheet;
  sheet.organs.push_back({1, "leaf", 1});
  sheet.optics_names.emplace_back("leaf");
  constexpr unsigned cells = 8, row = cells + 1;
  for (unsigned i = 0; i <= cells; ++i) {
    for (unsigned k = 0; k <= cells; ++k) sheet.vertices.emplace_back(0.1 * i, 0.5, 0.1 * k);
  }
  for (unsigned i = 0; i < cells; ++i) {
    for (unsigned k = 0; k < cells; ++k) {
      const unsigned at = i * row + k;
      sheet.triangles.emplace_back(at, at + 1, at + row);
      sheet.triangles.emplace_back(at + 1, at + row + 1, at + row);
    }
  }
  sheet.organ_of.assign(sheet.triangles.size(), 0);
  sheet.optics_of.assign(sheet.triangles.size(), 0);
  const Canopy coarse = coarsened(assembled(sheet, {1.0, 1.0, false}), 0.5);
  ASSERT_GT(coarse.size(), 0U);
  EXPECT_LE(coarse.size(), 64U);
  for (const Triangle& triangle : coarse.corners) EXPECT_NEAR(unit_normal(triangle).y, 1.0, 1e-6);
  EXPECT_NEAR(organ_areas_m2(coarse)[0], 0.64, 1e-6) << "its border is kept";
}

TEST(CoarseMesh, WhatCannotBeMadeCoarserStays) {
  Mesh two;
  two.organs = {{1, "leaf", 1}, {1, "leaf", 2}};
  two.optics_names.emplace_back("leaf");
  two.vertices = {{0.1, 0.5, 0.1}, {0.1, 0.5, 0.2}, {0.2, 0.5, 0.1}};
  two.triangles = {{0, 1, 2}, {0, 1, 2}};
  two.organ_of = {0, 1};
  two.optics_of = {0, 0};
  EXPECT_EQ(coarsened(assembled(two, {1.0, 1.0, false}), 0.01).size(), 2U);
  EXPECT_EQ(coarsened(Canopy{}, 0.5).size(), 0U);
}

}  // namespace
}  // namespace sunfleck
