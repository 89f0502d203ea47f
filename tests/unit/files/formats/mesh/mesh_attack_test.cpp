// Attacks the mesh readers: broken files end in one Error that names the place, never in a crash or a guess.

#include "base/error.h"
#include "base/file.h"
#include "files/formats/mesh/inflate_gzip.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/formats/mesh/mesh_source.h"
#include "files/formats/mesh/mesh_writer.h"
#include "support/broken_files.h"
#include "support/mesh_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <vector>

namespace sunfleck {
namespace {

// Returns the message of the input error with which reading must fail.
std::string refusal(const std::filesystem::path& file, const MeshImport& import) {
  return refusal_of([&] { static_cast<void>(read_mesh(file, import)); });
}

// Expects a mesh whose triangles have their vertices, or an input error.
void expect_mesh_or_error(const std::filesystem::path& file) {
  const auto message = message_of([&] {
    const Mesh mesh = read_mesh(file, {.optics = "leaf"});
    for (const glm::uvec3& triangle : mesh.triangles)
      for (int i = 0; i < 3; ++i) ASSERT_LT(triangle[i], mesh.vertices.size());
  });
  if (message) expect_three_parts(*message);
}

void expect_refused(const std::vector<Broken>& files) {
  expect_refused(files, [](const std::filesystem::path& file) { static_cast<void>(read_mesh(file, {.optics = "leaf"})); });
}

TEST(MeshAttack, BrokenCan) {
  const std::string good = "p 1 100001001001 3 0 0 0 1 0 0 1 1 0\n";
  const auto second = [&](std::string_view from, std::string_view to) { return good + swapped(good, from, to); };
  expect_refused({
      {"not a number", "a.can", second("0 0 0", "0 nan 0"), ":2: ", "coordinate 'nan'"},
      {"infinite", "a.can", second("0 0 0", "0 -inf 0"), ":2: ", "coordinate '-inf'"},
      {"too large", "a.can", second("0 0 0", "0 1e999 0"), ":2: ", "coordinate '1e999'"},
      {"decimal comma", "a.can", second("0 0 0", "0 0,5 0"), ":2: ", "coordinate '0,5'"},
      {"hexadecimal", "a.can", second("0 0 0", "0 0x1 0"), ":2: ", "coordinate '0x1'"},
      {"coordinate missing", "a.can", second("1 1 0", "1 1"), ":2: ", "a coordinate is missing"},
      {"coordinate too many", "a.can", second("1 1 0", "1 1 0 5"), ":2: ", "'5' after the last corner"},
      {"letters in label", "a.can", second("100001001001", "leaf"), ":2: ", "label 'leaf'"},
      {"negative label", "a.can", second("100001001001", "-1"), ":2: ", "label '-1'"},
      {"long label", "a.can", second("100001001001", "1000010010010"), ":2: ", "at most 12 digits"},
      {"no argument", "a.can", second("p 1", "p 0"), ":2: ", "number of arguments '0'"},
      {"two corners", "a.can", second(" 3 ", " 2 "), ":2: ", "number of corners '2'"},
      {"corners no number", "a.can", second(" 3 ", " three "), ":2: ", "number of corners 'three'"},
      {"too many corners", "a.can", second(" 3 ", " 999999999999 "), ":2: ", "number of corners"},
      {"unknown key", "a.can", second("p ", "q "), ":2: ", "line begins with 'q'"},
      {"control characters", "a.can", "\x01\x02\tp\n", ":1: ", "'\?\?'"},
      {"long word", "a.can", std::string(500, 'q'), ":1: ", "..."},
      {"only comments", "a.can", "# nothing\n\n", ": ", "no triangles found"},
      {"no gzip", "a.can.gz", good, ": ", "broken gzip file"},
      {"gzip cut", "a.can.gz", gzip(good).substr(0, 20), ": ", "is truncated"},
      {"gzip with a tail", "a.can.gz", gzip(good) + "tail", ": ", "broken gzip file"},
      {"gzip checksum", "a.can.gz", gzip(good).replace(gzip(good).size() - 8, 1, "?"), ": ", "broken gzip file"},
      {"inside gzip", "a.can.gz", gzip(second("0 0 0", "0 nan 0")), ":2: ", "coordinate 'nan'"},
  });
}

TEST(MeshAttack, BrokenObj) {
  const auto bad = [](std::string_view from, std::string_view to) { return swapped(obj_square(), from, to); };
  expect_refused({
      {"not a number", "a.obj", bad("v 1 1 0", "v 1 nan 0"), ":5: ", "coordinate 'nan'"},
      {"infinite", "a.obj", bad("v 1 1 0", "v 1 1 Infinity"), ":5: ", "coordinate 'Infinity'"},
      {"word", "a.obj", bad("v 1 1 0", "v one 1 0"), ":5: ", "coordinate 'one'"},
      {"coordinate missing", "a.obj", bad("v 1 1 0", "v 1 1"), ":5: ", "a coordinate is missing"},
      {"corner zero", "a.obj", bad("4//1", "0//1"), ":9: ", "corner '0//1'"},
      {"corner beyond", "a.obj", bad("4//1", "5//1"), ":9: ", "1..4"},
      {"corner before", "a.obj", bad("4//1", "-5//1"), ":9: ", "corner '-5//1'"},
      {"corner huge", "a.obj", bad("4//1", "4294967300//1"), ":9: ", "corner '4294967300//1'"},
      {"corner no number", "a.obj", bad("4//1", "x"), ":9: ", "corner 'x'"},
      {"two corners", "a.obj", bad(" 3//1 4//1", ""), ":9: ", "a face of 2 corners"},
      {"continued", "a.obj", bad("v 1 1 0", "v 1 1 \\\n0"), ":5: ", "backslash"},
      {"zero byte", "a.obj", obj_square() + std::string(1, '\0'), ": ", "zero byte"},
      {"no face", "a.obj", obj_square().substr(0, obj_square().find("f ")), ": ", "no triangles found"},
  });
}

TEST(MeshAttack, BrokenPly) {
  const auto bad = [](std::string_view from, std::string_view to) { return swapped(ply_text_square(), from, to); };
  std::string nan = ply_binary_square(ByteOrder::little);
  nan.replace(nan.find("end_header\n") + 13, 8, "\xff\xff\xff\xff\xff\xff\xff\xff");
  expect_refused({
      {"faces by another name", "a.ply", bad("vertex_indices", "vertex_ids"), ": ", "has the list 'vertex_ids'; faces have"},
      {"no PLY", "a.ply", bad("ply", "plx"), ":1: ", "does not begin with ply"},
      {"no format", "a.ply", bad("format ascii 1.0\n", ""), ":13: ", "the format line is missing"},
      {"unknown format", "a.ply", bad("ascii", "utf8"), ":2: ", "must be ascii"},
      {"unknown version", "a.ply", bad("1.0", "2.0"), ":2: ", "version"},
      {"unknown type", "a.ply", bad("float y", "real y"), ":7: ", "must be property"},
      {"unknown word", "a.ply", bad("comment", "remark"), ":3: ", "not a word of a PLY header"},
      {"negative count", "a.ply", bad("vertex 4", "vertex -4"), ":4: ", "element NAME COUNT"},
      {"property of nothing", "a.ply", bad("comment made by hand", "property int a"),
       ":3: ", "a property must follow an element"},
      {"float list size", "a.ply", bad("list uchar", "list float"), ":10: ", "integer type"},
      {"no header end", "a.ply", bad("end_header\n", ""), ":14: ", "not a word"},
      {"no z", "a.ply", bad("float z", "float w"), ": ", "vertices without z"},
      {"huge count", "a.ply", bad("vertex 4", "vertex 4000000000000000000"), ": ", "bytes follow"},
      {"vertices of nothing", "a.ply", "ply\nformat ascii 1.0\nelement vertex 9\nend_header\n", ": ", "without x"},
      {"too few numbers", "a.ply", bad("2 0 1\n", ""), ":20: ", "ends too early"},
      {"not a number", "a.ply", bad("1 9 1 0", "1 9 nan 0"), ":17: ", "'nan'"},
      {"binary not a number", "a.ply", nan, ": ", "vertex 0: y ="},
      {"corner beyond", "a.ply", bad("3 0 1 2 5", "3 0 1 4 5"), ":19: ", "corner 4"},
      {"negative corner", "a.ply", bad("3 0 1 2 5", "3 0 1 -1 5"), ":19: ", "corner -1"},
      {"two corners", "a.ply", bad("3 0 1 2 5", "2 0 1 5"), ":19: ", "a face of 2 corners"},
      {"endless list", "a.ply", bad("3 0 1 2 5", "99999999 0 1"), ":19: ", "a list of"},
  });
}

TEST(MeshAttack, BrokenStl) {
  const auto bad = [](std::string_view from, std::string_view to) { return swapped(stl_text_square(), from, to); };
  std::string nan = stl_binary_square(), huge = nan;
  nan.replace(84 + 12, 4, "\xff\xff\xff\xff");
  huge.replace(80, 4, "\xff\xff\xff\xff").replace(0, 5, "_____");
  expect_refused({
      {"not a number", "a.stl", bad("1 1 0", "1 1 nan"), ":6: ", "coordinate 'nan'"},
      {"no third corner", "a.stl", bad("vertex 1 1 0\n", ""), ":6: ", "a facet of 2 corners"},
      {"corner outside", "a.stl", bad("outer loop\n", ""), ":3: ", "'vertex'"},
      {"no end", "a.stl", bad("endsolid\n", ""), ":15: ", "endsolid is missing"},
      {"unknown word", "a.stl", bad("endfacet", "endface"), ":8: ", "'endface'"},
      {"short", "a.stl", "nothing", ": ", "only 7 bytes"},
      {"binary cut", "a.stl", "_" + stl_binary_square().substr(1, 150), ": ", "a binary STL file of 2 triangles has 184"},
      {"binary huge", "a.stl", huge, ": ", "4294967295 triangles"},
      {"binary not a number", "a.stl", nan, ": ", "triangle 1"},
      {"binary empty", "a.stl", std::string(84, '\0'), ": ", "no triangles found"},
      {"text empty", "a.stl", "solid\nendsolid\n", ": ", "no triangles found"},
  });
}

TEST(MeshAttack, MissingMaterialsAreAskedFor) {
  const TempFolder folder;
  const std::vector<std::pair<const char*, std::string>> files{{"a.ply", ply_text_square()},
                                                               {"a.stl", stl_text_square()},
                                                               {"b.stl", stl_binary_square()},
                                                               {"a.obj", "v 0 0 0\nf 1 1 1\n"}};
  for (const auto& [name, bytes] : files) {
    const std::string message = refusal(folder.write(name, bytes), {});
    EXPECT_NE(message.find("add optics = "), std::string::npos) << message;
    expect_three_parts(message);
  }
}

TEST(MeshAttack, NoFilesToRead) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "folder.obj");
  ASSERT_EQ(::mkfifo((folder / "pipe.obj").c_str(), 0600), 0);
  static_cast<void>(folder.write("empty.obj", ""));
  static_cast<void>(folder.write("a.fbx", "Kaydara"));
  for (const auto& [name, words] : {std::pair{"gone.obj", "no such file"},
                                    {"folder.obj", "is a directory"},
                                    {"pipe.obj", "not a regular file"},
                                    {"empty.obj", "the file is empty"},
                                    {"a.fbx", "must end in .glb, .gltf, .obj, .ply, .stl, .dae, .opf, .can or .can.gz"},
                                    {"two\nlines.obj", "no such file"}}) {
    const std::string message = refusal(folder / name, {});
    EXPECT_NE(message.find(words), std::string::npos) << message;
    expect_three_parts(message);
  }
}

TEST(MeshAttack, ScaledBeyondSinglePrecision) {
  const TempFolder folder;
  EXPECT_THROW(static_cast<void>(read_mesh(folder.write("a.can", can_square()), {.scale = 1e39})), Error);
}

TEST(MeshAttack, InflatingStopsAtTheLimit) {
  const std::string bomb = gzip(std::string(10'000'000, ' '));
  const MeshSource source{"bomb.can.gz", bomb, {}};
  EXPECT_EQ(inflate_gzip(source, 10'000'001).size(), 10'000'000U);
  EXPECT_THROW(static_cast<void>(inflate_gzip(source, 9'999'999)), Error);
}

// Cuts every format's good file at every length: it is either read or rejected. What is read has its indices in range.
TEST(MeshAttack, CutAtEveryLength) {
  const TempFolder folder;
  std::vector<std::pair<std::string, std::string>> files{{"a.obj", obj_square()},
                                                         {"a.can", can_square()},
                                                         {"a.can.gz", gzip(can_square())},
                                                         {"text.stl", stl_text_square()},
                                                         {"binary.stl", stl_binary_square()},
                                                         {"text.ply", ply_text_square()},
                                                         {"little.ply", ply_binary_square(ByteOrder::little)},
                                                         {"big.ply", ply_binary_square(ByteOrder::big)},
                                                         {"a.dae", dae_square()},
                                                         {"a.opf", opf_square()},
                                                         {"a.glb", glb(gltf_document(), gltf_binary())}};
  const Mesh square = read_mesh(folder.write("a.glb", files.back().second), {});
  write_gltf(square, folder / "embedded.gltf");
  files.emplace_back("embedded.gltf", read_file(folder / "embedded.gltf"));
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      expect_mesh_or_error(folder.write(name, std::string_view(bytes).substr(0, length)));
    }
  }
}

// Does the same with one byte changed at every place, to three values.
TEST(MeshAttack, OneByteChangedEverywhere) {
  const TempFolder folder;
  for (const auto& [name, good] : {std::pair<std::string, std::string>{"a.glb", glb(gltf_document(), gltf_binary())},
                                   {"a.can.gz", gzip(can_square())},
                                   {"a.stl", stl_binary_square()},
                                   {"a.ply", ply_binary_square(ByteOrder::little)},
                                   {"b.ply", ply_text_square()},
                                   {"a.obj", obj_square()}}) {
    SCOPED_TRACE(name);
    for (std::size_t place = 0; place < good.size(); ++place)
      for (const char value : {'\xff', '9', '\0'}) {
        std::string bytes = good;
        bytes[place] = value;
        expect_mesh_or_error(folder.write(name, bytes));
      }
  }
}

}  // namespace
}  // namespace sunfleck
