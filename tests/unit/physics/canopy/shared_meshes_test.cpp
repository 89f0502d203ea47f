#include "physics/canopy/shared_meshes.h"

#include "physics/canopy/canopy.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <span>

namespace sunfleck {
namespace {

// Returns a mesh of level triangles side by side, the last two of which lie on each other.
Mesh strip(std::size_t triangles) {
  Mesh mesh;
  mesh.optics_names = {"leaf"};
  mesh.organs = {Organ{}};
  for (std::size_t t = 0; t < triangles; ++t) {
    const double x = 0.01 * static_cast<double>(t + 1 < triangles ? t : t - 1);
    const auto first = static_cast<unsigned>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{x, 0.1, 0.0}, {x, 0.1, 0.01}, {x + 0.01, 0.1, 0.0}});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.optics_of.push_back(0);
    mesh.organ_of.push_back(0);
  }
  return mesh;
}

PlacedMesh stand(std::size_t triangles, int copies, std::optional<bool> shared = {}) {
  PlacedMesh part{strip(triangles), {}, {}, shared};
  for (int k = 0; k < copies; ++k) part.placements.push_back({{0.0, 0.0, 0.1 * k}, 0.3 * k});
  return part;
}

TEST(SharedMeshes, AreTakenWhereTheySaveMemory) {
  constexpr std::size_t large = 1'100'000, small = 1'000'000;
  EXPECT_TRUE(shares_triangles(stand(64, 8), large));
  EXPECT_FALSE(shares_triangles(stand(64, 8), small));
  EXPECT_FALSE(shares_triangles(stand(63, 8), large));
  EXPECT_FALSE(shares_triangles(stand(64, 7), large));
  EXPECT_TRUE(shares_triangles(stand(3, 1, true), 3));
  EXPECT_FALSE(shares_triangles(stand(64, 8, false), large));
}

TEST(SharedMeshes, AreNotForCopiesInTheSamePlace) {
  PlacedMesh part = stand(3, 4, true);
  part.placements[3] = part.placements[1];
  EXPECT_FALSE(shares_triangles(part, 12));
  part.placements[3].heading_rad += 0.1;
  EXPECT_TRUE(shares_triangles(part, 12));
}

TEST(SharedMeshes, MarkCopiesWithinTheMesh) {
  const PlacedMesh part = stand(5, 3, true);
  const Canopy canopy = assemble_canopy(std::span(&part, 1), {10.0, 10.0, false});
  EXPECT_EQ(canopy.copies, (std::vector<Copy>{{4, 3}, {9, 8}, {14, 13}}));
  ASSERT_EQ(canopy.corners.meshes().size(), 1U);
  EXPECT_EQ(canopy.corners.meshes()[0].traced, (std::vector<bool>{true, true, true, true, false}));
}

// A mesh that was digitised far from zero keeps its digits.
TEST(SharedMeshes, KeepTheDigitsOfAMeshFarFromZero) {
  PlacedMesh part = stand(2, 1, true);
  for (glm::dvec3& vertex : part.mesh.vertices) vertex += glm::dvec3(4e6, 300.0, 5e6);
  part.placements[0] = {{-4e6, -300.0, -5e6}};
  const Canopy canopy = assemble_canopy(std::span(&part, 1), {1.0, 1.0, false});
  const Canopy expected = [&] {
    part.shared = false;
    return assemble_canopy(std::span(&part, 1), {1.0, 1.0, false});
  }();
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LE(glm::length(glm::dvec3(canopy.corners[0][k]) + canopy.origin_m - glm::dvec3(expected.corners[0][k]) -
                          expected.origin_m),
              1e-7);
  }
}

}  // namespace
}  // namespace sunfleck
