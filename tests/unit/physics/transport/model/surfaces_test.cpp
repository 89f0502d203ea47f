// Tests the roles of surfaces.
#include "physics/transport/model/surfaces.h"

#include "physics/transport/model/surface_roles.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunfleck::test {
namespace {

struct Part {
  Organ organ;
  std::string optics;
};

// Returns a model with one triangle of 0.5 m2 for each part.
RadiationModel model_of(const std::vector<Part>& parts) {
  Mesh mesh;
  mesh.vertices = {{0.0, 1.0, 0.0}, {0.0, 1.0, 1.0}, {1.0, 1.0, 0.0}};
  for (const Part& part : parts) {
    mesh.triangles.emplace_back(0, 1, 2);
    mesh.organ_of.push_back(static_cast<std::uint32_t>(mesh.organs.size()));
    mesh.organs.push_back(part.organ);
    const auto known = std::find(mesh.optics_names.begin(), mesh.optics_names.end(), part.optics);
    mesh.optics_of.push_back(static_cast<std::uint32_t>(known - mesh.optics_names.begin()));
    if (known == mesh.optics_names.end()) mesh.optics_names.push_back(part.optics);
  }
  RadiationModel model;
  model.bands = {{"PAR", 1.0, 0.0}};
  const std::vector<PlacedMesh> placed = {{mesh, {Placement{}}, std::nullopt}};
  model.canopy = assemble_canopy(placed, model.plot);
  for (const std::string& name : model.canopy.optics_names) {
    model.optics.push_back({.name = name, .upper = {FaceOptics{}}, .lower = {FaceOptics{}}});
  }
  return model;
}

std::vector<Role> roles_of(const RadiationModel& model) {
  const Surfaces surfaces(model);
  std::vector<Role> roles;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) roles.push_back(surfaces.at(e).role);
  return roles;
}

using Roles = std::vector<Role>;

TEST(Surfaces, TakeTheirRoleFromTheOrgansNameThenFromTheOptics) {
  const RadiationModel model = model_of(
      {{{1, "leaf"}, "green"}, {{1, "part"}, "stem"}, {{1, "stem"}, "leaf"}, {{0, "leaf"}, "soil"}, {{0, "soil"}, "leaf"}});
  EXPECT_EQ(roles_of(model), (Roles{Role::leaf, Role::stem, Role::stem, Role::soil, Role::soil}));
}

TEST(Surfaces, WithoutAKnownNameAreLeavesWhereTheirPlantHasNoOther) {
  const RadiationModel model = model_of({{{1, "leaf"}, "a"}, {{1, "b"}, "b"}, {{2, "c"}, "c"}, {{2, "stem"}, "d"}});
  EXPECT_EQ(roles_of(model), (Roles{Role::leaf, Role::stem, Role::leaf, Role::stem}));
}

TEST(Surfaces, TakeTheRoleOfTheirOrganOrOpticsIfThatIsGiven) {
  RadiationModel model = model_of({{{1, "leaf", 0, Role::fruit}, "stem"}, {{1, "leaf"}, "panel"}, {{1, "leaf"}, "other"}});
  model.optics[0].role = Role::lamp;
  model.optics[1].role = Role::structure;
  EXPECT_EQ(roles_of(model), (Roles{Role::fruit, Role::structure, Role::leaf}));
}

TEST(Surfaces, AreLampsIfTheyEmitAndNothingElseIsKnown) {
  RadiationModel model = model_of({{{1, "a"}, "a"}, {{1, "leaf"}, "b"}, {{1, "c"}, "c"}});
  for (SurfaceOptics& optics : model.optics) optics.emission_w_m2 = {optics.name == "c" ? 0.0 : 1.0};
  EXPECT_EQ(roles_of(model), (Roles{Role::lamp, Role::leaf, Role::stem}));
}

TEST(Surfaces, OfNothingButStructuresCountAsLeavesUnlessTheirRoleIsGiven) {
  RadiationModel model = model_of({{{1, "wall"}, "white"}, {{0, "soil"}, "earth"}});
  EXPECT_EQ(roles_of(model), (Roles{Role::leaf, Role::soil}));
  model.optics[0].role = Role::structure;
  EXPECT_EQ(roles_of(model), (Roles{Role::structure, Role::soil}));
  EXPECT_EQ(roles_of(model_of({{{1, "wall"}, "white"}, {{2, "maize"}, "green"}})), (Roles{Role::structure, Role::leaf}));
}

TEST(Surfaces, OfStructuresShareNoOpticsWithVegetation) {
  RadiationModel model =
      model_of({{{1, "leaf"}, "white"}, {{1, "wall"}, "white"}, {{1, "pot"}, "white"}, {{1, "wall"}, "grey"}});
  separate_structures(model);
  EXPECT_EQ(model.canopy.optics_of, (std::vector<std::uint16_t>{0, 2, 2, 1}));
  EXPECT_EQ(model.canopy.optics_names, (std::vector<std::string>{"white", "grey", "white"}));
  EXPECT_EQ(model.optics[2].name, "white");
  EXPECT_EQ(roles_of(model), (Roles{Role::leaf, Role::structure, Role::structure, Role::structure}));
}

TEST(Surfaces, MayBeGivenTheRolesOfOtherOptics) {
  const RadiationModel model = model_of({{{1, "a"}, "a"}, {{1, "leaf"}, "b"}});
  std::vector<SurfaceOptics> optics = model.optics;
  optics[0].emission_w_m2 = {1.0};
  std::vector<Surface> surfaces = Surfaces(model).of;
  EXPECT_EQ(surfaces[0].role, Role::stem);
  set_roles(surfaces, model.canopy, optics);
  EXPECT_EQ(surfaces[0].role, Role::lamp);
  EXPECT_EQ(surfaces[1].role, Role::leaf);
}

TEST(Surfaces, GiveTheAreaOfEachRole) {
  RadiationModel model = model_of({{{1, "leaf"}, "a"}, {{1, "leaf2"}, "a"}, {{1, "pot"}, "b"}});
  EXPECT_EQ(area_of_roles_m2(model), (std::array<double, 6>{1.0, 0.0, 0.0, 0.5, 0.0, 0.0}));
  EXPECT_EQ(organ_roles(model), (Roles{Role::leaf, Role::leaf, Role::structure}));
  model.canopy.corners[2][1] = model.canopy.corners[2][0];
  EXPECT_EQ(organ_roles(model)[2], Role::structure) << "without area";
}

}  // namespace
}  // namespace sunfleck::test
