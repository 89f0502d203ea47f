#include "files/formats/mesh/mesh_survey.h"

#include "support/plant_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

const PlantShape maize{.leaves = 8, .height_m = 1.6, .leaf_length_m = 0.7, .leaf_width_m = 0.08, .rise = 1.5};
const PlantShape bean{.leaves = 5, .height_m = 0.2, .leaf_length_m = 0.12, .leaf_width_m = 0.08, .rise = 0.5};
const PlantShape rosette{.leaves = 14, .height_m = 0.02, .leaf_length_m = 0.12, .leaf_width_m = 0.04, .rise = 0.6};
const PlantShape tree{.leaves = 40, .height_m = 2.5, .leaf_length_m = 0.3, .leaf_width_m = 0.12, .rise = 0.3};

// The triangles are counter-clockwise from above for none of these orders in particular: half of them mirror the plant.
struct AxisOrder {
  std::array<int, 3> from;
  FileAxis up;
};
constexpr AxisOrder orders[] = {{{0, 1, 2}, FileAxis::y}, {{0, 2, 1}, FileAxis::z}, {{1, 0, 2}, FileAxis::x},
                                {{1, 2, 0}, FileAxis::x}, {{2, 0, 1}, FileAxis::z}, {{2, 1, 0}, FileAxis::y}};

Mesh reordered(Mesh mesh, const std::array<int, 3>& from, double scale) {
  for (glm::dvec3& v : mesh.vertices) v = scale * glm::dvec3(v[from[0]], v[from[1]], v[from[2]]);
  return mesh;
}

TEST(FrameGuess, FindsUpAndUnitInEveryOrderOfTheAxes) {
  for (const PlantShape& shape : {maize, bean, rosette, tree}) {
    const Mesh plant = plant_mesh(shape);
    for (const AxisOrder& order : orders) {
      for (const double unit_m : {1.0, 0.01, 0.001}) {
        const FrameGuess guess = survey_mesh(reordered(plant, order.from, 1.0 / unit_m), {}).frame;
        EXPECT_EQ(guess.up, order.up) << guess.summary() << ", " << guess.up_reason;
        EXPECT_NE(guess.up_certainty, Certainty::unsure);
        EXPECT_EQ(guess.metres_per_unit, unit_m) << guess.summary() << ", " << guess.unit_reason;
      }
    }
  }
}

TEST(FrameGuess, UpDoesNotDependOnWhichSideFacesUp) {
  Mesh plant = plant_mesh(maize);
  for (glm::uvec3& t : plant.triangles) std::swap(t.y, t.z);
  EXPECT_EQ(survey_mesh(plant, {}).frame.up, FileAxis::y);
}

TEST(FrameGuess, SaysWhereItIsNotSure) {
  Mesh cube;
  cube.optics_names = {"box"};
  cube.organs = {{1, "box", 0}};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) cube.vertices.emplace_back(2.5 * x, 2.5 * y, 2.5 * z);
  for (const std::array<std::uint32_t, 4>& f :
       {std::array<std::uint32_t, 4>{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    add_square(cube, f[0], f[1], f[2], f[3], 0);
  const MeshSurvey survey = survey_mesh(cube, {});
  EXPECT_EQ(survey.frame.up_certainty, Certainty::unsure);
  EXPECT_NE(survey.frame.summary().find("y or z"), std::string::npos) << survey.frame.summary();
  EXPECT_EQ(survey.closed_pieces, 1U);
}

// Adds a square of these lengths at this place, level, with the number of an organ.
void add_level_square(Mesh& mesh, glm::dvec3 corner, double length, std::uint32_t organ) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const glm::dvec3& at : {glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 1), glm::dvec3(1, 0, 0)})
    mesh.vertices.push_back(corner + length * at);
  add_square(mesh, first, first + 1, first + 2, first + 3, organ);
}

TEST(FrameGuess, JudgesTheUnitByLeavesAndNotByTrunksAndGround) {
  Mesh tall;  // in metres: leaves of 25 cm2 on a trunk of 60 m2, 12 m high
  tall.optics_names = {"surface"};
  tall.organs = {{1, "leaf", 1}, {1, "trunk", 0}, {1, "ground", 0}};
  for (int k = 0; k < 200; ++k) add_level_square(tall, {0.02 * k, 6.0 + 0.03 * k, 0.01 * k}, 0.05, 0);
  tall.vertices.insert(tall.vertices.end(), {{0, 0, 0}, {5, 0, 0}, {5, 12, 0}, {0, 12, 0}});
  add_square(tall, 800, 801, 802, 803, 1);
  const FrameGuess guess = survey_mesh(tall, {}).frame;
  EXPECT_EQ(guess.metres_per_unit, 1.0) << guess.unit_reason;
  EXPECT_EQ(guess.unit_certainty, Certainty::sure) << guess.unit_reason;
  Mesh plant;  // 0.6 m, in metres
  plant.optics_names = tall.optics_names;
  plant.organs = tall.organs;
  for (int k = 0; k < 12; ++k) add_level_square(plant, {0.02 * k, 0.05 * k, 0.01 * k}, 0.05, 0);
  const FrameGuess alone = survey_mesh(plant, {}).frame;
  EXPECT_EQ(alone.metres_per_unit, 1.0);
  add_level_square(plant, {-10.0, 0.0, -10.0}, 20.0, 2);
  const FrameGuess on_ground = survey_mesh(plant, {}).frame;
  EXPECT_EQ(on_ground.metres_per_unit, 1.0) << on_ground.unit_reason;
  EXPECT_EQ(on_ground.unit_certainty, alone.unit_certainty);
}

TEST(FrameGuess, IsSureOnlyWhereAnotherUnitIsOutOfTheQuestion) {
  const Mesh plant = plant_mesh(maize);
  EXPECT_EQ(survey_mesh(reordered(plant, {0, 1, 2}, 1.0), {}).frame.unit_certainty, Certainty::sure);
  const FrameGuess cm = survey_mesh(reordered(plant, {0, 1, 2}, 100.0), {}).frame;
  EXPECT_EQ(cm.unit_certainty, Certainty::likely) << "a tiny plant in millimetres is possible: " << cm.unit_reason;
  Mesh stem;
  stem.optics_names = {"stem"};
  stem.organs = {{1, "stem", 0}};
  stem.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 50, 0}, {0, 50, 0}};
  add_square(stem, 0, 1, 2, 3, 0);
  EXPECT_NE(survey_mesh(stem, {}).frame.unit_certainty, Certainty::sure) << "no leaf shows the unit";
}

TEST(FrameGuess, GivesEvidenceForTheAxis) {
  Mesh skins;  // leaves of two skins that face opposite ways
  skins.optics_names = {"leaf"};
  skins.organs = {{1, "leaf", 1}};
  for (int k = 0; k < 4; ++k) {
    add_level_square(skins, {0.2 * k, 0.1 * k, 0.0}, 0.1, 0);
    const std::uint32_t first = 4 * static_cast<std::uint32_t>(k);
    add_square(skins, first + 3, first + 2, first + 1, first, 0);
  }
  const FrameGuess guess = survey_mesh(skins, {}).frame;
  EXPECT_EQ(guess.up, FileAxis::y);
  EXPECT_EQ(guess.up_reason.substr(0, 68), "either way round, 100 % of the area faces along y and at most 0 % al")
      << guess.up_reason;
  for (glm::dvec3& vertex : skins.vertices) vertex.z = vertex.y = 0.0;
  EXPECT_EQ(survey_mesh(skins, {}).frame.up_certainty, Certainty::unsure);
  EXPECT_EQ(survey_mesh(skins, {}).frame.up_reason, "no triangle has an area");
}

TEST(FrameGuess, FormatsThatDefineTheirFrameAreBelieved) {
  const Mesh plant = reordered(plant_mesh(maize), {0, 2, 1}, 100.0);
  const FrameGuess gltf = survey_mesh(plant, frame_of_format("a.GLB")).frame;
  EXPECT_EQ(gltf.up, FileAxis::y);
  EXPECT_EQ(gltf.metres_per_unit, 1.0);
  EXPECT_EQ(gltf.summary(), "is in metres, y up");
  const FrameGuess can = survey_mesh(plant, frame_of_format("a.can.gz")).frame;
  EXPECT_EQ(can.up_certainty, Certainty::known);
  EXPECT_EQ(can.metres_per_unit, 0.01);
  EXPECT_FALSE(frame_of_format("a.obj").up);
}

TEST(MeshSurvey, MeasuresWhatASingleSheetHas) {
  Mesh mesh;
  mesh.optics_names = {"leaf"};
  mesh.organs = {{1, "leaf", 3}};
  mesh.vertices = {{0, 0, -1}, {2, 0, -1}, {2, 3, -1}, {0, 3, -1}, {9, 9, 9}};  // the last one is in no triangle
  add_square(mesh, 0, 1, 2, 3, 0);
  const MeshSurvey survey = survey_mesh(mesh, {FileAxis::z, 0.1, "made so"});
  EXPECT_EQ(survey.triangles, 2U);
  EXPECT_DOUBLE_EQ(survey.area, 6.0);
  EXPECT_DOUBLE_EQ(survey.area_m2(), 0.06);
  EXPECT_DOUBLE_EQ(survey.area_below_ground, 6.0);
  EXPECT_EQ(survey.shape.hi, glm::dvec3(2, 3, -1));
  EXPECT_EQ(survey.shape.pieces, 1U);
  EXPECT_EQ(survey.closed_pieces, 0U);
  EXPECT_DOUBLE_EQ(survey.shape.net_facing.z, 1.0);
  EXPECT_EQ(survey.families.at(0).name, "leaf");
  EXPECT_DOUBLE_EQ(survey.families.at(0).flatness, 1.0);
}

TEST(MeshSurvey, CountsDefects) {
  Mesh mesh;
  mesh.optics_names = {"leaf"};
  mesh.organs = {{1, "leaf", 0}};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, -1, 0}, {1, 1e-3, 0}};
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.organ_of.push_back(0);
    mesh.optics_of.push_back(0);
  };
  add(0, 1, 2);
  add(2, 3, 1);  // the same place: vertex 3 lies on vertex 0
  add(0, 3, 1);  // a line
  add(0, 1, 4);
  add(0, 1, 5);  // with these, four triangles share the edge 0 1
  add(0, 1, 6);  // a sliver
  const MeshDefects defects = survey_mesh(mesh, {}).defects;
  EXPECT_EQ(defects.flat_triangles, 1U);
  EXPECT_EQ(defects.coincident, 1U);
  EXPECT_EQ(defects.slivers, 1U);
  EXPECT_EQ(defects.crowded_edges, 1U);
  EXPECT_EQ(defects.unused_vertices, 0U);
  EXPECT_EQ(defects.organs, std::vector<std::string>{"leaf"});
}

TEST(MeshSurvey, CountsEdgesWhereASheetTurnsItsFace) {
  Mesh mesh;
  mesh.optics_names = {"leaf"};
  mesh.organs = {{1, "leaf", 0}};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {5, 5, 5}, {6, 6, 6}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.organ_of = mesh.optics_of = {0, 0};
  EXPECT_EQ(survey_mesh(mesh, {}).defects.flipped_edges, 0U);
  EXPECT_EQ(survey_mesh(mesh, {}).defects.unused_vertices, 2U);
  EXPECT_TRUE(survey_mesh(mesh, {}).defects.organs.empty());
  std::swap(mesh.triangles[1].x, mesh.triangles[1].y);
  EXPECT_EQ(survey_mesh(mesh, {}).defects.flipped_edges, 1U);
  // Another piece may face any way.
  mesh.organs.push_back({1, "stem", 0});
  mesh.organ_of[1] = 1;
  EXPECT_EQ(survey_mesh(mesh, {}).defects.flipped_edges, 0U);
}

TEST(MeshSurvey, PiecesJoinWherePositionsAreEqualWithinOneOrganAndMaterial) {
  Mesh mesh;
  mesh.optics_names = {"a", "b"};
  mesh.organs = {{1, "leaf", 0}, {1, "leaf", 1}};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const auto pieces = [&](std::vector<std::uint32_t> organs, std::vector<std::uint32_t> optics) {
    mesh.organ_of = std::move(organs);
    mesh.optics_of = std::move(optics);
    return survey_mesh(mesh, {}).shape.pieces;
  };
  EXPECT_EQ(pieces({0, 0}, {0, 0}), 1U);  // vertices 1 and 3 are at the same place
  EXPECT_EQ(pieces({0, 1}, {0, 0}), 2U);
  EXPECT_EQ(pieces({0, 0}, {0, 1}), 2U);
}

TEST(MeshSurvey, RolesComeFromNamesThenOrgansThenShapes) {
  // Sheets and a closed stem, once as two materials without telling names.
  Mesh mesh = plant_mesh(maize);
  mesh.optics_names = {"Material.001", "Material.002", "bark"};
  const std::size_t stem = mesh.triangles.size() - 12;
  std::fill(mesh.optics_of.begin() + static_cast<std::ptrdiff_t>(stem), mesh.optics_of.end(), 1);
  const auto roles = [&] {
    std::vector<std::pair<Role, RoleSource>> found;
    for (const MeshShare& share : survey_mesh(mesh, {}).materials) found.emplace_back(share.role, share.role_from);
    return found;
  };
  using Roles = std::vector<std::pair<Role, RoleSource>>;
  EXPECT_EQ(roles(), (Roles{{Role::leaf, RoleSource::shape}, {Role::stem, RoleSource::shape}}));
  mesh.organs[0].name = "grape berry";
  EXPECT_EQ(roles(), (Roles{{Role::fruit, RoleSource::organs}, {Role::fruit, RoleSource::organs}}));
  mesh.optics_names = {"LeafMat", "bark", ""};
  EXPECT_EQ(roles(), (Roles{{Role::leaf, RoleSource::name}, {Role::stem, RoleSource::name}}));
}

TEST(MeshSurvey, SplitsWhatNamesDoNotTellApart) {
  Mesh mesh = plant_mesh(maize);
  EXPECT_TRUE(survey_mesh(mesh, {}).needs_split());
  mesh.organs = {{1, "leaf.001", 0}, {1, "leaf.002", 0}};
  mesh.organ_of[0] = 1;
  EXPECT_FALSE(survey_mesh(mesh, {}).needs_split());  // the file numbers its organs itself
}

TEST(MeshSurvey, FamiliesAreNamesWithoutNumbers) {
  for (const auto& [name, family] :
       std::vector<std::pair<std::string, std::string>>{{"leaf.012", "leaf"},
                                                        {"leaf_12", "leaf"},
                                                        {"leaf 3", "leaf"},
                                                        {"Circle.166_Circle.168", "Circle.166_Circle"},
                                                        {"leaf", "leaf"},
                                                        {"12", "12"},
                                                        {"colour_102030", "colour_102030"},
                                                        {"", ""},
                                                        {"_7", "_7"},
                                                        {"a-", "a-"}})
    EXPECT_EQ(family_of(name), family) << name;
}

}  // namespace
}  // namespace sunfleck
