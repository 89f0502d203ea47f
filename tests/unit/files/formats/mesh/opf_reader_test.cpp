#include "files/formats/mesh/opf_reader.h"

#include "files/formats/mesh/mesh_reader.h"
#include "support/broken_files.h"
#include "support/mesh_files.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunfleck {
namespace {

Mesh read_opf_text(const std::string& text, const MeshImport& import = {}) {
  const TempFolder folder;
  return read_mesh(folder.write("a.opf", text), import);
}

TEST(OpfReader, CentimetresWithZUp) {
  const Mesh mesh = read_opf_text(opf_square());
  ASSERT_EQ(mesh.triangles.size(), 2U) << "a geometry without shapeIndex is no organ";
  const glm::dvec3 expected[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (std::size_t i = 0; i < 4; ++i) expect_at(mesh.vertices[i], expected[i]);
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "leaf", 7}}));
  EXPECT_EQ(mesh.optics_names, std::vector<std::string>{"leaf"});
  expect_at(read_opf_text(opf_square(), {.scale = 2.0}).vertices[1], {2, 0, 0});
}

// y and z are multiplied by dDwn at the mesh's least x and by dUp at its largest, here 3 and 5.
TEST(OpfReader, OrgansTaper) {
  const std::string text = swapped(swapped(opf_square(), "<dUp>1", "<dUp>5"), "<dDwn>1", "<dDwn>3");
  const Mesh mesh = read_opf_text(text);
  expect_at(mesh.vertices[1], {3, 0, 0});
  expect_at(mesh.vertices[2], {5, 1, 0});
  const Mesh longer = read_opf_text(swapped(text, "0 0 0 0 1 0 1 1 0 1 0 0", "-2 0 0 -2 1 0 6 1 0 6 0 0"));
  expect_at(longer.vertices[1], {3, -2, 0});
  expect_at(longer.vertices[2], {5, 6, 0});
  const Mesh without_length = read_opf_text(swapped(text, "0 0 0 0 1 0 1 1 0 1 0 0", "4 0 0 4 1 0 4 1 1 4 0 1"));
  expect_at(without_length.vertices[1], {3, 4, 0});
  expect_at(read_opf_text(swapped(text, "enableScale=\"true\"", "enableScale=\"false\"")).vertices[2], {1, 1, 0});
}

TEST(OpfReader, OrgansOfOneClassDifferByTheirId) {
  const std::string text = opf_square();
  const std::size_t from = text.find("<decomp"), end = text.find("</topology>");
  const std::string organ = text.substr(from, end - from);
  const Mesh mesh = read_opf_text(text.substr(0, end) + swapped(organ, "id=\"7\"", "id=\"8\"") +
                                  swapped(organ, "class=\"leaf\"", "class=\"Metamer\"") + text.substr(end));
  EXPECT_EQ(mesh.organs, (std::vector<Organ>{{1, "leaf", 7}, {1, "leaf", 8}, {1, "Metamer", 7}}));
  EXPECT_EQ(mesh.optics_names, (std::vector<std::string>{"leaf", "Metamer"}));
}

TEST(OpfReader, OrgansWithoutLengthAreKept) {
  EXPECT_EQ(read_opf_text(swapped(opf_square(), "<mat>0 0 0 0 0 -100 0 0 100", "<mat>0 0 0 0 0 -100 0 0 0")).triangles.size(),
            2U);
}

TEST(OpfReader, RefusesDamagedFiles) {
  const auto bad = [](std::string_view from, std::string_view to) { return swapped(opf_square(), from, to); };
  const std::vector<Broken> files{
      {"not XML", "a.opf", bad("</opf>", ""), ":", "is not well-formed XML"},
      {"TOML", "a.opf", "[sun]\nazimuth = 1\n", ":", "is not well-formed XML"},
      {"other XML", "a.opf", "<html/>", ":1: ", "must be <opf>"},
      {"half a point", "a.opf", bad("<points>0", "<points>"), ":3: ", "11 coordinates"},
      {"not a number", "a.opf", bad("<points>0", "<points>nan"), ":3: ", "<points>: 'nan'"},
      {"corner beyond", "a.opf", bad("0 2 3", "0 2 4"), ":4: ", "corner 4"},
      {"negative corner", "a.opf", bad("0 2 3", "0 2 -1"), ":4: ", "corner -1"},
      {"two corners", "a.opf", bad("0 2 3", "0 2"), ":4: ", "a face of 2 corners"},
      {"no shape", "a.opf", bad("<shapeIndex>5", "<shapeIndex>6"), ":7: ", "shape 6"},
      {"no mesh", "a.opf", bad("<meshIndex>0", "<meshIndex>3"), ":7: ", "mesh 3 of shape 5"},
      {"shape without number", "a.opf", bad("<shape Id=\"5\"", "<shape"), ":5: ", "it needs an Id"},
      {"matrix", "a.opf", bad("<mat>0 0 0 0 0 -100", "<mat>0 0 0 0 -100"), ":8: ", "it needs 12"},
      {"nan in a shape", "a.opf", bad("<dUp>1", "<dUp>NaN"), ":8: ", "<dUp>: 'NaN'"},
      {"no position", "a.opf",
       bad("<shapeIndex>5</shapeIndex>\n<mat>0 0 0 0 0 -100 0 0 100 0 0 0</mat>", "<shapeIndex>5</shapeIndex>"),
       ":7: ", "without <mat>"},
      {"no class", "a.opf", bad("class=\"leaf\"", ""), ":7: ", "without a class"},
      {"id", "a.opf", bad("id=\"7\"", "id=\"-7\""), ":7: ", "id '-7'"},
      {"infinite", "a.opf", bad("<dUp>1", "<dUp>1e308"), ":7: ", "not finite"}};
  expect_refused(files, [](const std::filesystem::path& file) { static_cast<void>(read_mesh(file, {.optics = "leaf"})); });
}

TEST(OpfReader, DeepNestingIsNoRecursion) {
  const std::string text = opf_square();
  const std::size_t from = text.find("<decomp"), end = text.find("</topology>");
  std::string begin, close;
  for (int i = 0; i < 100'000; ++i) begin += "<follow class=\"Axis\">", close += "</follow>";
  EXPECT_EQ(
      read_opf_text(text.substr(0, from) + begin + text.substr(from, end - from) + close + text.substr(end)).triangles.size(),
      2U);
}

}  // namespace
}  // namespace sunfleck
