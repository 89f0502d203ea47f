// Tests where the plants of a stand are said to be.

#include "physics/canopy/plants.h"

#include "physics/canopy/canopy.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sunfleck {
namespace {

// Returns a mesh with a unit square for each plant; the squares lie side by side along X.
Mesh squares(const std::vector<std::uint32_t>& plants) {
  Mesh mesh;
  mesh.optics_names = {"leaf"};
  for (std::uint32_t k = 0; k < plants.size(); ++k) {
    const double x = k;
    for (const glm::dvec3 corner : {glm::dvec3(x, 1, 0), {x, 1, 1}, {x + 1, 1, 1}, {x + 1, 1, 0}})
      mesh.vertices.push_back(corner);
    mesh.triangles.emplace_back(4 * k, 4 * k + 1, 4 * k + 2);
    mesh.triangles.emplace_back(4 * k, 4 * k + 2, 4 * k + 3);
    mesh.organs.push_back({plants[k], "leaf", 1});
    for (int half = 0; half < 2; ++half) {
      mesh.optics_of.push_back(0);
      mesh.organ_of.push_back(k);
    }
  }
  return mesh;
}

void expect_sites(const std::vector<PlacedMesh>& parts, const std::vector<PlantSite>& expected) {
  const std::vector<PlantSite> sites = plant_sites(parts);
  ASSERT_EQ(sites.size(), expected.size());
  for (std::size_t k = 0; k < sites.size(); ++k) {
    EXPECT_EQ(sites[k].plant, expected[k].plant);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(sites[k].position_m[axis], expected[k].position_m[axis], 1e-12);
  }
}

TEST(Plants, TheOnlyOneOfAMeshStandsWhereTheMeshIsPlaced) {
  expect_sites({{squares({1}), {{{3, 0.5, 4}, 1.0, 2.0}, {{5, 0, 6}}}, {}}}, {{1, {3, 0.5, 4}}, {2, {5, 0, 6}}});
}

TEST(Plants, OneOfSeveralStandsBelowItsCentroid) {
  expect_sites({{squares({2, 1}), {{{10, 0.5, 20}}}, {}}}, {{1, {11.5, 0.5, 20.5}}, {2, {10.5, 0.5, 20.5}}});
  // A quarter turn clockwise takes south (+X) to west (+Z), after the mesh was made twice as large.
  expect_sites({{squares({1, 2}), {{{0, 0, 0}, std::numbers::pi / 2, 2.0}}, {}}}, {{1, {-1, 0, 1}}, {2, {-1, 0, 3}}});
}

TEST(Plants, SoilIsNone) {
  expect_sites({{squares({0, 1}), {{{1, 0, 2}}}, {}}, {squares({0}), {{}}, {}}}, {{1, {1, 0, 2}}});
}

TEST(Plants, KeepTheirNumbers) {
  const std::vector<PlacedMesh> parts{{squares({1}), {{{1, 0, 0}, 0.0, 1.0, 9}, {{2, 0, 0}, 0.0, 1.0, 4}}, {}},
                                      {squares({5}), {{{3, 0, 0}}}, {}}};
  expect_sites(parts, {{4, {2, 0, 0}}, {9, {1, 0, 0}}, {14, {3, 0, 0}}});
}

TEST(Plants, OfMeshesThatKeepTheirNumbersMayBePartsOfOne) {
  Mesh leaves = squares({7}), stems = squares({7, 3});
  leaves.keeps_plants = stems.keeps_plants = true;
  const std::vector<PlacedMesh> parts{
      {leaves, {{{1, 0, 0}}, {{2, 0, 0}}}, {}}, {stems, {{}}, {}}, {squares({1}), {{{4, 0, 0}}}, {}}};
  // The second copy of the leaves follows the first, and the last mesh all others.
  expect_sites(parts, {{3, {1.5, 0, 0.5}}, {7, {1, 0, 0}}, {14, {2, 0, 0}}, {15, {4, 0, 0}}});
  const Canopy canopy = assemble_canopy(parts, {10.0, 10.0, false});
  std::vector<std::uint32_t> numbers;
  for (const Organ& organ : canopy.organs) numbers.push_back(organ.plant);
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{7, 14, 7, 3, 15}));
}

}  // namespace
}  // namespace sunfleck
