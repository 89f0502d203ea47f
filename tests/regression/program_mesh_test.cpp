// Tests the commands for a mesh about which nothing is known: `info MESH` and `new`.

#include "regression/program.h"
#include "support/mesh_files.h"
#include "support/plant_mesh.h"

#include <string>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

// A plant of 0.5 m as an OBJ in centimetres with z up.
std::string plant_in_centimetres() {
  Mesh plant = plant_mesh({.leaves = 8, .height_m = 0.4, .leaf_length_m = 0.3, .leaf_width_m = 0.05, .rise = 0.8});
  for (glm::dvec3& v : plant.vertices) v = 100.0 * glm::dvec3(v.z, v.x, v.y);
  return obj_of(plant);
}

class ProgramMesh : public ProgramTest {
 protected:
  [[nodiscard]] json survey(const std::string& name) const {
    const Outcome outcome = run({"info", name, "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out)["meshes"][0];
  }
};

TEST_F(ProgramMesh, InfoDescribesMeshes) {
  folder_.write("plant.obj", plant_in_centimetres());
  folder_.write("square.stl", stl_text_square());
  const json plant = survey("plant.obj");
  EXPECT_EQ(plant["frame"]["up"], "z");
  EXPECT_EQ(plant["frame"]["metres_per_unit"], 0.01);
  EXPECT_EQ(plant["triangles"], 8 * 12 + 12);
  EXPECT_EQ(plant["pieces"], 9);
  EXPECT_EQ(plant["closed_pieces"], 1);
  EXPECT_EQ(plant["materials"], json::array());
  EXPECT_EQ(plant["defects"]["coincident"], 0);
  EXPECT_NEAR(plant["area_m2"].get<double>(), 1e-4 * plant["area_units2"].get<double>(), 1e-12);

  const Outcome both = run({"info", "plant.obj", "square.stl"});
  EXPECT_EQ(both.status, 0);
  for (const char* words : {"plant.obj: looks like centimetres (probably), z up\n", "square.stl: looks like ",
                            "9 connected pieces", "materials: none", "defects: none"}) {
    EXPECT_NE(both.out.find(words), std::string::npos) << words << "\n" << both.out;
  }
}

TEST_F(ProgramMesh, InfoCountsObjectsAndGroupsApart) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 9 9 9\n";
  folder_.write("plant.obj",
                vertices + "o plant\ng leaf a\nusemtl green\nf 1 2 3\ng leaf b\nf 1 4 3\nf 1 4 4\no idle\ng empty\n");
  const json found = survey("plant.obj");
  EXPECT_EQ(found["objects"], 1);
  EXPECT_EQ(found["groups"], 2);
  EXPECT_EQ(found["defects"]["zero_area"], 1);
  EXPECT_EQ(found["defects"]["unused_vertices"], 1);
  EXPECT_EQ(found["defects"]["organs"], json({"leaf b"}));
  const std::string text = run({"info", "plant.obj"}).out;
  EXPECT_NE(text.find("named in the file: 1 object, 2 groups, 1 material\n"), std::string::npos) << text;
  EXPECT_NE(text.find("defects: 1 triangle without area (in leaf b), 1 vertex in no triangle\n"), std::string::npos) << text;

  folder_.write("square.glb", glb(gltf_document(), gltf_binary()));
  EXPECT_EQ(survey("square.glb")["groups"], 0);
  EXPECT_GE(survey("square.glb")["objects"], 1);
}

// Two leaves in one object, in two materials; the second is of two pieces.
TEST_F(ProgramMesh, ConvertSplitsOrgans) {
  folder_.write(
      "plant.obj",
      "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 3 0 0\nv 4 0 0\nv 4 0 1\no plant\nusemtl green\nf 1 2 3\nf 1 3 2\nusemtl red\nf 4 5 6\n"
      "o other\nusemtl red\nf 1 2 3\nf 4 5 6\n");
  const auto organs = [&](const Arguments& more) {
    EXPECT_EQ(run(Arguments{"convert", "plant.obj", "made.ply"} + more).status, 0);
    return survey("made.ply")["organs"];
  };
  EXPECT_EQ(organs({}), 2);
  EXPECT_EQ(organs({"--split", "names"}), 2);
  EXPECT_EQ(organs({"--split", "materials"}), 3);
  EXPECT_EQ(organs({"--split", "parts"}), 4);
  expect_one_error(run({"convert", "plant.obj", "made.ply", "--split", "part"}), 2, "--split");
  expect_one_error(run({"convert", "plant.obj", "made.toml", "--split", "parts", "--optics", "a.opt", "--light", "a.light"}), 2,
                   "write split = \"parts\" under [[geometry]]");
}

TEST_F(ProgramMesh, NewWritesAnythingReadableAsASceneThatRuns) {
  folder_.write("plant.obj", plant_in_centimetres());
  folder_.write("square.ply", ply_text_square());
  folder_.write("square.stl", stl_binary_square());
  folder_.write("square.glb", glb(gltf_document(), gltf_binary()));
  folder_.write("square.can", can_square());
  for (const std::string name : {"plant.obj", "square.ply", "square.stl", "square.glb", "square.can"}) {
    SCOPED_TRACE(name);
    const double area_m2 = survey(name)["area_m2"];
    const Outcome made = run({"new", name, "-o", "stand.toml", "--force"});
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_NE(made.out.find("next: sunfleck run stand.toml\n"), std::string::npos) << made.out;
    EXPECT_EQ(made.err, "");
    simulate("stand.toml", {"--images", "none", "--device", "cpu", "--error", "0.05"});
    const json of_run = summary();
    EXPECT_NEAR(of_run["leaf_area_index"].get<double>() * of_run["plot_area_m2"].get<double>(), area_m2, 1e-5 * area_m2);
  }
}

// Two leaves in one colour and a stalk in another; nothing is named.
const std::string coloured_ply =
    "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nelement face 3\n"
    "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
    "0 0 0.3\n0.2 0 0.3\n0 0.1 0.3\n0 0 0.2\n-0.2 0 0.2\n0 -0.1 0.2\n0 0 0\n0.01 0 0\n0 0 0.3\n"
    "3 0 1 2 30 60 10\n3 3 4 5 30 60 10\n3 6 7 8 65 45 15\n";

TEST_F(ProgramMesh, ColoursAreMaterialsAndPiecesAreOrgans) {
  folder_.write("plant.ply", coloured_ply);
  const json found = survey("plant.ply");
  ASSERT_EQ(found["materials"].size(), 2U);
  EXPECT_EQ(found["materials"][0]["name"], "colour_1e3c0a");
  EXPECT_EQ(found["materials"][0]["pieces"], 2);

  folder_.write("plant.obj", plant_in_centimetres());
  EXPECT_EQ(run({"new", "plant.obj", "-o", "stand.toml"}).status, 0);
  simulate("stand.toml", {"--images", "none", "--device", "cpu", "--error", "0.05"});
  EXPECT_EQ(summary()["organs"], 9);  // eight leaves and a stem
}

TEST_F(ProgramMesh, NewWritesToStandardOutputAndNeverReplacesAFile) {
  folder_.write("plant.obj", plant_in_centimetres());
  const Outcome text = run({"new", "plant.obj"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_EQ(run({"new", "plant.obj", "-o", "stand.toml"}).status, 0);
  EXPECT_EQ(content(folder_ / "stand.toml"), text.out);
  folder_.write("stand.toml", "mine");
  expect_one_error(run({"new", "plant.obj", "-o", "stand.toml"}), 2, "stand.toml (it exists already); ");
  EXPECT_EQ(content(folder_ / "stand.toml"), "mine");
  EXPECT_EQ(run({"new", "plant.obj", "-o", "stand.toml", "--force"}).status, 0);
  EXPECT_EQ(content(folder_ / "stand.toml"), text.out);
  expect_one_error(run({"new", "plant.obj", "-o", "plant.obj", "--force"}), 2, "plant.obj (a scene file ends in .toml)");
  expect_one_error(run({"new", "plant.obj", "-o", "missing/stand.toml"}), 1, "missing/stand.toml (its folder does not exist)");
}

TEST_F(ProgramMesh, ASceneElsewhereNamesTheWholePath) {
  folder_.write("plant.obj", plant_in_centimetres());
  std::filesystem::create_directory(folder_ / "scenes");
  const Outcome made = run({"new", "plant.obj", "-o", "scenes/stand.toml"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("next: sunfleck run scenes/stand.toml --allow-outside"), std::string::npos) << made.out;
  simulate("scenes/stand.toml", {"--allow-outside", "--images", "none", "--device", "cpu", "--error", "0.1"});
}

TEST_F(ProgramMesh, MistakesAreOneLine) {
  std::filesystem::create_directory(folder_ / "folder.obj");
  folder_.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
  folder_.write("text.txt", "no mesh");
  for (const std::string command : {"info", "new"}) {
    expect_one_error(run({command, "gone.obj"}), 2, "gone.obj");
    expect_one_error(run({command, "folder.obj"}), 2, "folder.obj");
    expect_one_error(run({command, "broken.obj"}), 2, "broken.obj:2: corner");
    folder_.write("square.txt", ply_text_square());
  }
  expect_one_error(run({"new", "text.txt"}), 2, ".glb, .gltf, .obj");
  expect_one_error(run({"new", "square.txt"}), 2, "its content looks like .ply); rename it so that it ends in .ply");
  for (const char* command : {"info", "run"}) {
    expect_one_error(run({command, "square.txt"}), 2,
                     "is a mesh (.ply), not a scene in TOML); rename it so that it ends in .ply");
  }
  expect_one_error(run({"new", "gone.obj", "-o", "a.toml"}), 2, "gone.obj");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.toml"));
}

}  // namespace
}  // namespace sunfleck::regression
