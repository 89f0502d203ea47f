#include "physics/canopy/maize.h"

#include "physics/canopy/maize_plant.h"
#include "physics/canopy/maize_surface.h"
#include "support/maize_stands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

using std::numbers::pi;

double leaf_area_index(const MaizeStand& stand) {
  return total_area(leaves_of(make_maize(stand))) / plot_area_m2(stand);
}

// --- Blades and tubes ---------------------------------------------------------------------------------------------------

TEST(Blade, WidthProfileIsPrevots) {
  EXPECT_NEAR(relative_blade_width(0.0), 0.733150, 1e-6);
  EXPECT_NEAR(relative_blade_width(0.340620), 1.0, 1e-6);
  EXPECT_NEAR(relative_blade_width(1.0), 0.0, 1e-12);
  EXPECT_NEAR(blade_form_factor(), 0.749908, 1e-6);
}

TEST(Blade, FlatBladeHasTheAreaOfItsProfile) {
  Blade blade;
  blade.length_m = 0.9;
  blade.width_m = 0.1;
  Mesh mesh;
  add_blade(mesh, blade, MaizeDetail{}, {});
  const double area_m2 = 0.749908 * blade.length_m * blade.width_m;
  EXPECT_NEAR(total_area(mesh), area_m2, 0.005 * area_m2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_GT(area_vector(mesh, t).y, 0.0) << "triangle " << t;
}

TEST(Blade, BendingFoldingAndWrappingKeepTheMidribsLength) {
  Blade blade;
  blade.insertion_rad = 0.5;
  blade.bending_rad = 2.0;
  blade.bend_sharpness = 2.5;
  blade.fold_rad = 0.3;
  blade.wrap_rad = 2.0;
  const MaizeDetail detail;
  Mesh mesh;
  add_blade(mesh, blade, detail, {});
  const std::size_t row = 2 * detail.strips_per_half + 1;
  double length_m = 0.0;
  glm::dvec3 previous = blade.collar_m;
  for (std::size_t v = row + detail.strips_per_half; v < mesh.vertices.size(); v += row) {
    length_m += glm::length(mesh.vertices[v] - previous);
    previous = mesh.vertices[v];
  }
  length_m += glm::length(mesh.vertices.back() - previous);
  // A chord across an arc of angle x is shorter by x^2 / 24; here x < 0.1 in every row.
  EXPECT_NEAR(length_m, blade.length_m, 0.1 * 0.1 / 24.0);
}

TEST(Blade, TwoThirdsOfTheBendingAreReachedAtTheBendPosition) {
  Blade blade;
  blade.insertion_rad = 0.5;
  blade.bending_rad = 1.8;
  blade.bend_position = 0.7;
  blade.bend_sharpness = 2.5;
  const MaizeDetail detail{.blade_step_m = 0.001, .strips_per_half = 1};
  Mesh mesh;
  add_blade(mesh, blade, detail, {});
  const std::size_t midrib = 3 * 700 + 1;  // each row has three vertices
  const glm::dvec3 along = glm::normalize(mesh.vertices[midrib + 3] - mesh.vertices[midrib - 3]);
  EXPECT_NEAR(std::acos(along.y), blade.insertion_rad + 2.0 / 3.0 * blade.bending_rad, 1e-4);
}

TEST(Tube, AreaIsTheCylindersForAnyNumberOfSidesAndUpperFacesLookOut) {
  const double radius_m = 0.01;
  Tube tube;
  tube.rings = {{{0.0, 0.0, 0.0}, radius_m}, {{0.0, 0.2, 0.0}, radius_m}, {{0.0, 0.5, 0.0}, radius_m}};
  for (const int sides : {3, 4, 8, 13}) {
    Mesh mesh;
    add_tube(mesh, tube, {.tube_sides = sides}, {});
    EXPECT_NEAR(total_area(mesh), 2.0 * pi * radius_m * 0.5, 1e-12) << sides << " sides";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::dvec3 corner = mesh.vertices[mesh.triangles[t].x];
      EXPECT_GT(glm::dot(area_vector(mesh, t), glm::dvec3(corner.x, 0.0, corner.z)), 0.0) << sides << " sides";
    }
  }
}

// --- Single plants ------------------------------------------------------------------------------------------------------

std::vector<MaizePlant> some_plants() {
  std::vector<MaizePlant> plants;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (std::uint32_t number = 1; number <= 20; ++number) plants.push_back(grow_maize_plant(seed, number));
  }
  return plants;
}

const MaizeLeaf& largest_leaf(const MaizePlant& plant) {
  return *std::max_element(plant.leaves.begin(), plant.leaves.end(), [](const MaizeLeaf& a, const MaizeLeaf& b) {
    return a.blade.length_m * a.blade.width_m < b.blade.length_m * b.blade.width_m;
  });
}

double stem_radius(const Tube& stem, double height_m) {
  const auto above = std::find_if(stem.rings.begin() + 1, stem.rings.end() - 1,
                                  [&](const Tube::Ring& ring) { return ring.centre_m.y >= height_m; });
  const auto below = above - 1;
  const double t = (height_m - below->centre_m.y) / (above->centre_m.y - below->centre_m.y);
  return std::lerp(below->radius_m, above->radius_m, t);
}

TEST(MaizePlant, HasTwelveToSixteenGreenLeavesOfConsecutiveRanks) {
  std::set<std::size_t> counts;
  for (const MaizePlant& plant : some_plants()) {
    counts.insert(plant.leaves.size());
    for (std::size_t i = 1; i < plant.leaves.size(); ++i) EXPECT_EQ(plant.leaves[i].rank, plant.leaves[i - 1].rank + 1);
    EXPECT_GE(plant.leaves.front().rank, 5);  // four to six leaves are dead
    EXPECT_LE(plant.leaves.front().rank, 7);
  }
  EXPECT_GE(*counts.begin(), 12U);
  EXPECT_LE(*counts.rbegin(), 16U);
  EXPECT_GT(counts.size(), 2U);
}

TEST(MaizePlant, SizesAreThoseOfMaize) {
  for (const MaizePlant& plant : some_plants()) {
    const double height_m = plant.tassel.front().rings.back().centre_m.y;
    EXPECT_GE(height_m, 2.2);
    EXPECT_LE(height_m, 2.8);
    EXPECT_GE(plant.ear.rings.front().centre_m.y, 0.9);
    EXPECT_LE(plant.ear.rings.front().centre_m.y, 1.2);
    EXPECT_GE(2.0 * plant.stem.rings.front().radius_m, 0.022);
    EXPECT_LE(2.0 * plant.stem.rings.front().radius_m, 0.025);
    EXPECT_GE(plant.tassel.size(), 1U + 8U);
    EXPECT_LE(plant.tassel.size(), 1U + 20U);
    const double tassel_m = height_m - plant.tassel.front().rings.front().centre_m.y;
    EXPECT_GE(tassel_m, 0.30);
    EXPECT_LE(tassel_m, 0.40);
  }
}

TEST(MaizePlant, LargestLeafStandsNearTheEarAndIsOfMaizeSize) {
  for (const MaizePlant& plant : some_plants()) {
    const MaizeLeaf& largest = largest_leaf(plant);
    EXPECT_NEAR(largest.blade.collar_m.y, plant.ear.rings.front().centre_m.y, 0.45);  // three internodes
    EXPECT_GE(largest.blade.length_m, 0.75);
    EXPECT_LE(largest.blade.length_m, 1.0);
    EXPECT_GE(largest.blade.width_m, 0.08);
    EXPECT_LE(largest.blade.width_m, 0.115);
  }
}

TEST(MaizePlant, LeavesStandInTwoOppositeRanksAndGrowSteeperUpwards) {
  for (const MaizePlant& plant : some_plants()) {
    for (std::size_t i = 1; i < plant.leaves.size(); ++i) {
      // Each leaf may deviate from the plant's plane by up to 30 degrees.
      EXPECT_LT(glm::dot(plant.leaves[i].blade.outward, plant.leaves[i - 1].blade.outward), std::cos(120.0 * degree));
    }
    const Blade& lowest = plant.leaves.front().blade;
    const Blade& top = plant.leaves.back().blade;
    EXPECT_GE(lowest.insertion_rad, 40.0 * degree);
    EXPECT_LE(lowest.insertion_rad, 60.0 * degree);
    EXPECT_GE(top.insertion_rad, 15.0 * degree);
    EXPECT_LE(top.insertion_rad, 25.0 * degree);
  }
}

TEST(MaizePlant, BladesStartOnTheStemAndStayOutsideIt) {
  for (const MaizePlant& plant : some_plants()) {
    for (const MaizeLeaf& leaf : plant.leaves) {
      const glm::dvec3& collar = leaf.blade.collar_m;
      EXPECT_NEAR(std::hypot(collar.x, collar.z), stem_radius(plant.stem, collar.y), 1e-9);
      Mesh mesh;
      add_blade(mesh, leaf.blade, MaizeDetail{}, {});
      for (const glm::dvec3& vertex : mesh.vertices) {
        EXPECT_GT(vertex.y, 0.0);
        if (vertex.y > plant.stem.rings.back().centre_m.y) continue;
        EXPECT_GE(std::hypot(vertex.x, vertex.z), stem_radius(plant.stem, vertex.y) - 1e-9) << "leaf " << leaf.rank;
      }
    }
  }
}

// --- Stands -------------------------------------------------------------------------------------------------------------

class Maize : public testing::TestWithParam<MaizeStand> {};

TEST_P(Maize, MeshIsSound) {
  const Mesh mesh = make_maize(GetParam());
  ASSERT_EQ(mesh.optics_of.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.organ_of.size(), mesh.triangles.size());
  EXPECT_EQ(mesh.optics_names, (std::vector<std::string>{"leaf", "stem"}));
  for (const glm::dvec3& v : mesh.vertices) {
    ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    ASSERT_GE(v.y, 0.0);
  }
  double least_area_m2 = 1.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) ASSERT_LT(mesh.triangles[t][k], mesh.vertices.size());
    ASSERT_LT(mesh.organ_of[t], mesh.organs.size());
    ASSERT_LT(mesh.optics_of[t], mesh.optics_names.size());
    least_area_m2 = std::min(least_area_m2, glm::length(area_vector(mesh, t)));
  }
  EXPECT_GT(least_area_m2, 1e-6);  // a square millimetre
}

TEST_P(Maize, TriangleCountIsWithinATenthOfTheNominalOne) {
  const double nominal = GetParam().per_row == 3 ? 200000.0 : 300000.0;
  EXPECT_NEAR(static_cast<double>(make_maize(GetParam()).triangles.size()), nominal, 0.1 * nominal);
}

TEST_P(Maize, LeafAreaIndexIsThatOfTheMeasuredStands) {
  const bool sparse = GetParam().per_row == 3;
  const double index = leaf_area_index(GetParam());
  EXPECT_GE(index, sparse ? 2.1 : 4.0);
  EXPECT_LE(index, sparse ? 2.3 : 4.5);
}

TEST_P(Maize, OrgansAreNumberedByPlantAndLeafRank) {
  const Mesh mesh = make_maize(GetParam());
  std::map<std::uint32_t, std::map<std::string, int>> organs_of_plant;
  std::set<std::pair<std::uint32_t, int>> leaf_ranks;
  for (const Organ& organ : mesh.organs) {
    ++organs_of_plant[organ.plant][organ.name];
    if (organ.name == "leaf") {
      EXPECT_TRUE(leaf_ranks.emplace(organ.plant, organ.rank).second) << "two leaves of one rank";
    } else {
      EXPECT_EQ(organ.rank, 0);
    }
  }
  ASSERT_EQ(organs_of_plant.size(), static_cast<std::size_t>(GetParam().rows * GetParam().per_row));
  EXPECT_EQ(organs_of_plant.begin()->first, 1U);
  EXPECT_EQ(organs_of_plant.rbegin()->first, organs_of_plant.size());
  for (auto& [plant, organs] : organs_of_plant) {
    EXPECT_EQ(organs.size(), 4U);
    EXPECT_GE(organs["leaf"], 12);
    EXPECT_LE(organs["leaf"], 16);
    for (const char* single : {"stem", "ear", "tassel"}) EXPECT_EQ(organs[single], 1) << "plant " << plant;
  }
  std::vector<bool> used(mesh.organs.size(), false);
  for (const std::uint32_t organ : mesh.organ_of) used[organ] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST_P(Maize, LeavesShowTheirUpperFaceToTheSky) {
  const Mesh leaves = leaves_of(make_maize(GetParam()));
  double up_m2 = 0.0;
  for (std::size_t t = 0; t < leaves.triangles.size(); ++t) up_m2 += area_vector(leaves, t).y;
  EXPECT_GT(up_m2, 0.5 * total_area(leaves));  // the mean over a sphere's upper half is 0.5
}

TEST_P(Maize, EachStemStandsInTheMiddleOfItsCell) {
  const MaizeStand& stand = GetParam();
  const Mesh mesh = make_maize(stand);
  std::map<std::uint32_t, std::vector<glm::dvec3>> foot;  // [plant], the stem's vertices on the ground
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Organ& organ = mesh.organs[mesh.organ_of[t]];
    const glm::dvec3& v = mesh.vertices[mesh.triangles[t].x];
    if (organ.name == "stem" && v.y == 0.0) foot[organ.plant].push_back(v);
  }
  for (int i = 0; i < stand.rows * stand.per_row; ++i) {
    const int row = i / stand.per_row;
    const int place = i % stand.per_row;
    for (const glm::dvec3& v : foot[i + 1]) {
      EXPECT_NEAR(v.x, (place + 0.5) * stand.spacing_in_row_m, 0.015);
      EXPECT_NEAR(v.z, (row + 0.5) * stand.spacing_between_rows_m, 0.015);
    }
    EXPECT_FALSE(foot[i + 1].empty());
  }
}

std::vector<MaizeStand> both_stands_with_seeds_1_to_5() {
  std::vector<MaizeStand> stands;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    stands.push_back(sparse_stand(seed));
    stands.push_back(dense_stand(seed));
  }
  return stands;
}

std::string stand_name(const testing::TestParamInfo<MaizeStand>& info) {
  return (info.param.per_row == 3 ? "Sparse" : "Dense") + std::to_string(info.param.seed);
}

INSTANTIATE_TEST_SUITE_P(Stands, Maize, testing::ValuesIn(both_stands_with_seeds_1_to_5()), stand_name);

TEST(MaizeSeed, SameSeedSameMeshOtherSeedOtherMesh) {
  const Mesh first = make_maize(sparse_stand(1));
  const Mesh again = make_maize(sparse_stand(1));
  const Mesh other = make_maize(sparse_stand(2));
  EXPECT_EQ(first.vertices, again.vertices);
  EXPECT_EQ(first.triangles, again.triangles);
  EXPECT_EQ(first.organ_of, again.organ_of);
  EXPECT_EQ(first.organs, again.organs);
  EXPECT_NE(first.vertices, other.vertices);
}

TEST(MaizeSeed, NoTwoPlantsAreAlike) {
  std::set<double> ear_heights_m;
  const auto plants = some_plants();
  for (const MaizePlant& plant : plants) ear_heights_m.insert(plant.ear.rings.front().centre_m.y);
  EXPECT_EQ(ear_heights_m.size(), plants.size());
}

}  // namespace
}  // namespace sunfleck
