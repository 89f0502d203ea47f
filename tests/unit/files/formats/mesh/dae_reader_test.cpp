#include "files/formats/mesh/dae_reader.h"

#include "files/formats/mesh/mesh_reader.h"
#include "support/broken_files.h"
#include "support/error_text.h"
#include "support/mesh_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunfleck {
namespace {

Mesh read_dae_text(const std::string& text, const MeshImport& import = {}) {
  const TempFolder folder;
  return read_mesh(folder.write("a.dae", text), import);
}

const std::string instance = "<instance_geometry url=\"#shape\"/>";

// Returns the square's file with other nodes in its scene.
std::string with_nodes(const std::string& nodes) {
  const std::string text = dae_square();
  const std::string begin = "<visual_scene id=\"s\">", end = "</visual_scene>";
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(0, from) + nodes + text.substr(text.find(end));
}

TEST(DaeReader, NodesNameOrgansAndMaterialsAreBound) {
  const Mesh mesh = read_dae_text(dae_square());
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "blade", 0}}));
  EXPECT_EQ(mesh.optics_names, std::vector<std::string>{"leaf"});
  EXPECT_EQ(read_dae_text(with_nodes("<node>" + instance + "</node>")).optics_names, std::vector<std::string>{"m"})
      << "the symbol, where nothing is bound";
}

TEST(DaeReader, NamesOfOrgansHoldForTheNodesBelow) {
  const std::string part = "<node name=\"Blade\">" + instance + "</node>";
  const std::string other = "<node name=\"plant2_stem\">" + instance + "</node>";
  const Mesh mesh = read_dae_text(with_nodes("<node name=\"plant2_leaf3\">" + part + other + part + "</node>" + part));
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{2, "leaf", 3}, {2, "stem", 0}, {1, "Blade", 0}}));
}

TEST(DaeReader, CommentsCutNoNumbersOff) {
  const std::string list = "<p>";
  const Mesh mesh = read_dae_text(swapped(dae_square(), list, list + "<!-- corners -->"));
  EXPECT_EQ(mesh.triangles.size(), read_dae_text(dae_square()).triangles.size());
  const std::string text = dae_square();
  const std::size_t middle = text.find(' ', text.find(list));
  const Mesh cut = read_dae_text(text.substr(0, middle) + "<!-- more --> " + text.substr(middle));
  EXPECT_EQ(cut.triangles, mesh.triangles);
}

TEST(DaeReader, TextIsInTheEncodingThatTheFileDeclares) {
  const std::string body = with_nodes("<node name=\"Bl\xfctt\">" + instance + "</node>");
  const std::size_t root = body.find("<COLLADA");
  const Mesh mesh = read_dae_text("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n" + body.substr(root));
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "Bl\xc3\xbctt", 0}}));
  std::string wide = "\xff\xfe";
  for (const char c : dae_square().substr(dae_square().find("<COLLADA"))) wide.append({c, '\0'});
  EXPECT_EQ(read_dae_text(wide).organs, (std::vector<Organ>{{1, "blade", 0}}));
}

TEST(DaeReader, UnitAndUpAxis) {
  const auto second = [](std::string_view up, const MeshImport& import = {}) {
    return read_dae_text(swapped(swapped(dae_square(), "meter=\"1\"", "meter=\"0.01\""), "Y_UP", up), import).vertices[1];
  };
  expect_at(second("Y_UP"), {0.01, 0, 0});
  expect_at(second("X_UP"), {0, 0.01, 0});
  expect_at(second("Z_UP"), {0, 0, -0.01});
  expect_at(second("Z_UP", {.up = FileAxis::y, .scale = 2.0}), {0.02, 0, 0});
}

TEST(DaeReader, TransformsFollowTheNodeTree) {
  const Mesh mesh = read_dae_text(with_nodes(
      "<node name=\"plant\"><translate>0 0 5</translate><rotate>0 0 1 90</rotate><scale>2 3 4</scale><node>" + instance +
      "</node><node name=\"leaf\"><matrix>1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1</matrix>" + instance + "</node></node>"));
  expect_at(mesh.vertices[1], {0, 2, 5});
  expect_at(mesh.vertices[2], {-3, 2, 5});
  expect_at(mesh.vertices[4], {0, 2, 5});
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "plant", 0}, {1, "leaf", 0}}));
}

TEST(DaeReader, MirroredNodesKeepTheirUpperFace) {
  const Mesh mesh = read_dae_text(with_nodes("<node><scale>-1 1 1</scale>" + instance + "</node>"));
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 3, 2));
}

TEST(DaeReader, InstancesOfNodes) {
  const std::string library = "<library_nodes><node id=\"tree\" name=\"leaf\">" + instance + "</node></library_nodes>";
  const std::string nodes = "<node><instance_node url=\"#tree\"/><instance_node url=\"#tree\"/></node>";
  const Mesh mesh = read_dae_text(swapped(with_nodes(nodes), "<library_visual_scenes>", library + "<library_visual_scenes>"));
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "leaf", 0}, {1, "leaf 2", 0}}));
  EXPECT_EQ(mesh.triangles.size(), 4U);
}

// Returns a file whose many <vertices>, each with a triangle, share one source of many positions.
std::string with_shared_source(int vertices, int positions) {
  const char* const corners[] = {"1 0 0 ", "0 1 0 ", "0 0 1 "};
  std::string numbers, primitives;
  for (int i = 0; i < positions; ++i) numbers += corners[i % 3];
  for (int i = 0; i < vertices; ++i) {
    primitives += fmt::format(
        "<vertices id=\"v{0}\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles material=\"m\">"
        "<input semantic=\"VERTEX\" source=\"#v{0}\" offset=\"0\"/><p>0 1 2</p></triangles>",
        i);
  }
  return fmt::format(
      "<COLLADA><library_geometries><geometry id=\"shape\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"{0}\">{1}"
      "</float_array><technique_common><accessor source=\"#a\" count=\"{2}\" stride=\"3\"/></technique_common></source>{3}"
      "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node>{4}</node></visual_scene>"
      "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>",
      3 * positions, numbers, positions, primitives, instance);
}

TEST(DaeReader, VerticesMayShareTheirPositionsButNotMakeASmallFileLarge) {
  EXPECT_EQ(read_dae_text(with_shared_source(100, 100)).triangles.size(), 100U);
  expect_refusal([] { static_cast<void>(read_dae_text(with_shared_source(1000, 7000))); },
                 "too many <vertices> share their positions");
}

TEST(DaeReader, KindsOfPolygons) {
  const std::string square = dae_square();
  const std::size_t from = square.find("<polylist"), to = square.find("</mesh>");
  const auto with = [&](const std::string& kind, const std::string& lists) {
    const std::string text = square.substr(0, from) + "<" + kind +
                             " material=\"m\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>" + lists + "</" + kind +
                             ">" + square.substr(to);
    return read_dae_text(text).triangles;
  };
  using Triangles = std::vector<glm::uvec3>;
  EXPECT_EQ(with("triangles", "<p>0 1 2 0 2 3</p>"), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(with("polygons", "<p>0 1 2 3</p><p>3 2 1</p>"), (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
  EXPECT_EQ(with("trifans", "<p>1 2 3 0</p>"), (Triangles{{1, 2, 3}, {1, 3, 0}}));
  EXPECT_EQ(with("tristrips", "<p>0 1 3 2</p>"), (Triangles{{0, 1, 3}, {1, 2, 3}}));
}

TEST(DaeReader, RefusesDamagedFiles) {
  const auto bad = [](std::string_view from, std::string_view to) { return swapped(dae_square(), from, to); };
  const std::string cycle = "<node id=\"n\"><instance_node url=\"#n\"/></node>";
  const std::vector<Broken> files{
      {"not XML", "a.dae", bad("</COLLADA>", ""), ":", "is not well-formed XML"},
      {"other XML", "a.dae", "<svg/>", ":1: ", "must be <COLLADA>"},
      {"not a number", "a.dae", bad("0 0 0 1", "0 nan 0 1"), ":6: ", "<float_array>: 'nan'"},
      {"corner beyond", "a.dae", bad("3 9</p>", "4 9</p>"), ":10: ", "corner 4"},
      {"negative corner", "a.dae", bad("3 9</p>", "-1 9</p>"), ":10: ", "corner -1"},
      {"half a corner", "a.dae", bad("3 9</p>", "3</p>"), ":10: ", "every corner has 2"},
      {"two corners", "a.dae", bad("<vcount>4", "<vcount>2 2"), ":10: ", "a polygon of 2 corners"},
      {"corners left", "a.dae", bad("<vcount>4", "<vcount>3"), ":10: ", "1 corners too many"},
      {"vcount too large", "a.dae", bad("<vcount>4", "<vcount>99999999999"), ":10: ", "only 4 are left"},
      {"more positions than numbers", "a.dae", bad("count=\"4\"", "count=\"5\""), ":7: ", "5 positions"},
      {"huge stride", "a.dae", bad("stride=\"3\"", "stride=\"999999999\""), ":7: ", "4 positions"},
      {"flat positions", "a.dae", bad("stride=\"3\"", "stride=\"2\""), ":7: ", "stride 2"},
      {"another file", "a.dae", bad("url=\"#shape\"", "url=\"/etc/passwd#shape\""), ":12: ", "of the same file"},
      {"no such geometry", "a.dae", bad("url=\"#shape\"", "url=\"#leaf\""), ":12: ", "there is no <geometry>"},
      {"not a geometry", "a.dae", bad("url=\"#shape\"", "url=\"#green\""), ":12: ", "there is no <geometry>"},
      {"unit", "a.dae", bad("meter=\"1\"", "meter=\"0\""), ":3: ", "meter = '0'"},
      {"up", "a.dae", bad("Y_UP", "UP"), ":3: ", "up_axis 'UP'"},
      {"matrix", "a.dae", with_nodes("<node><matrix>1 0</matrix></node>"), ":12: ", "it needs 16"},
      {"skew", "a.dae", with_nodes("<node><skew>1</skew></node>"), ":12: ", "a transform <skew>"},
      {"no axis", "a.dae", with_nodes("<node><rotate>0 0 0 9</rotate></node>"), ":12: ", "about no axis"},
      {"infinite", "a.dae",
       with_nodes("<node><scale>1e300 1 1</scale><node><scale>1e300 1 1</scale>" + instance + "</node></node>"),
       ":12: ", "not finite"},
      {"cycle", "a.dae", with_nodes(cycle), ":12: ", "without end"},
      {"no scene", "a.dae", bad("<instance_visual_scene url=\"#s\"/>", ""), ": ", "no triangles found"}};
  expect_refused(files, [](const std::filesystem::path& file) { static_cast<void>(read_mesh(file, {.optics = "leaf"})); });
}

TEST(DaeReader, NodesThatDoubleEachOtherEnd) {
  std::string nodes = "<node id=\"n0\">" + instance + "</node>";
  for (int i = 1; i < 40; ++i) {
    const std::string url = "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
    nodes = "<node id=\"n" + std::to_string(i) + "\">" + url + url + "</node>" + nodes;
  }
  EXPECT_NE(refusal_of([&] { static_cast<void>(read_dae_text(with_nodes(nodes))); }).find("without end"), std::string::npos);
}

TEST(DaeReader, DeepNestingIsNoRecursion) {
  std::string nodes = instance;
  std::string begin, end;
  for (int i = 0; i < 100'000; ++i) begin += "<node>", end += "</node>";
  EXPECT_EQ(read_dae_text(with_nodes(begin + nodes + end)).triangles.size(), 2U);
}

}  // namespace
}  // namespace sunfleck
