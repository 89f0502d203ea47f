// Tests that a scene in x east, y north, z up gives the light of the same scene in X south, Y up, Z west, in its own
// coordinates.

#include "regression/program.h"
#include "support/table.h"

namespace sunfleck::regression {
namespace {

// x east, y north, z up: a leaf to the north-east, a smaller one to the west, and a stem.
const std::string turned_plant_obj =
    "v 0 0 0\nv 0.02 0 0\nv 0.02 0 0.5\nv 0 0 0.5\nv 0.5 0.25 0.375\nv 0.25 0.5 0.375\nv -0.25 0.125 0.25\n"
    "usemtl stem\nf 1 2 3 4\nusemtl leaf\nf 4 5 6\nf 4 1 7\n";

const std::string axes_light =
    "[sun]\nelevation = 40.0\nazimuth = 115.0\n[sky]\nmodel = \"cie-clear\"\n"
    "[[band]]\nname = \"PAR\"\ndirect = 300.0\ndiffuse = 60.0\n[soil]\nreflectance = 0.2\n"
    "[optics.leaf]\nreflectance = 0.1\ntransmittance = 0.1\n[optics.stem]\nreflectance = 0.2\n";

const std::string south_up_west = "title = \"field\"\n" + axes_light + R"([plot]
size = [1.5, 2.25]
[camera]
position = [3.0, 1.5, 3.5]
look_at = [0.75, 0.25, 1.0]
[[plane]]
height = 0.25
cells = [6, 9]
[[sensor]]
name = "line"
from = [0.25, 0.125, 0.5]
to = [1.25, 0.125, 2.0]
points = 3
normal = [0.0, 1.0, -0.5]
[[geometry]]
file = "plant.obj"
up = "z"
at = [[0.25, 0.0, 0.5], [1.0, 0.125, 2.0]]
heading = [0, 30]
[[geometry]]
file = "plant.obj"
up = "z"
positions = "south.csv"
)";
const std::string south_csv = "plant,x,z,heading,scale\n11,0.5,1.25,45,0.5\n12,1.25,0.25,-60,1\n";

// Every coordinate is a multiple of 1/8, so that converting it is exact and the scenes are equal to the last bit.
const std::string east_north_up = "title = \"field\"\naxes = \"east-north-up\"\n" + axes_light + R"([plot]
size = [2.25, 1.5]
[camera]
position = [-1.25, -1.5, 1.5]
look_at = [1.25, 0.75, 0.25]
[[plane]]
height = 0.25
cells = [9, 6]
[[sensor]]
name = "line"
from = [1.75, 1.25, 0.125]
to = [0.25, 0.25, 0.125]
points = 3
normal = [0.5, 0.0, 1.0]
[[geometry]]
file = "plant.obj"
at = [[1.75, 1.25, 0.0], [0.25, 0.5, 0.125]]
heading = [0, 30]
[[geometry]]
file = "plant.obj"
positions = "east.csv"
)";
const std::string east_csv = "plant,x,y,heading,scale\n11,1.0,1.0,45,0.5\n12,2.0,0.25,-60,1\n";

constexpr double size_east_m = 2.25, size_north_m = 1.5;

// Returns the table without its comments.
std::string rows_of(const std::string& text) {
  std::size_t begin = 0;
  while (text[begin] == '#') begin = text.find('\n', begin) + 1;
  return text.substr(begin);
}

class AxesOfScenes : public ProgramTest {
 protected:
  AxesOfScenes() {
    folder_.write("plant.obj", turned_plant_obj);
    folder_.write("south.toml", south_up_west);
    folder_.write("south.csv", south_csv);
    folder_.write("east.toml", east_north_up);
    folder_.write("east.csv", east_csv);
  }

  void compute_both(const Arguments& more) {
    const Arguments work{"--grid", "0.02", "--passes", "8", "--images", "none"};
    simulate("south.toml", work + more, 0, "south");
    simulate("east.toml", work + more, 0, "east");
  }

  void expect_same_light() const {
    for (const char* name : {"organs.csv", "profile.csv"}) EXPECT_EQ(file(name, "east"), file(name, "south")) << name;
    EXPECT_EQ(rows_of(file("plane_0.250_flecks.csv", "east")), rows_of(file("plane_0.250_flecks.csv", "south")));
    EXPECT_EQ(summary("east")["bands"], summary("south")["bands"]);
    EXPECT_EQ(summary("east")["axes"], "east-north-up");
    EXPECT_EQ(summary("south")["axes"], "south-up-west");
  }

  // Expects that row for row the columns x, y, z are those of the other table in the other axes, and all others are equal.
  void expect_same_rows_elsewhere(const std::string& name) const {
    const Table south(file(name, "south"));
    const Table east(file(name, "east"));
    EXPECT_EQ(east.columns(), south.columns());
    ASSERT_EQ(east.size(), south.size());
    ASSERT_GT(east.size(), 2U);
    EXPECT_NE(file(name, "east").find("(x east, y north, z up)"), std::string::npos);
    for (std::size_t row = 0; row < south.size(); ++row) {
      SCOPED_TRACE(row);
      EXPECT_NEAR(east.number(row, "x"), size_east_m - south.number(row, "z"), 1e-8);
      EXPECT_NEAR(east.number(row, "y"), size_north_m - south.number(row, "x"), 1e-8);
      EXPECT_NEAR(east.number(row, "z"), south.number(row, "y"), 1e-8);
      for (const std::string& column : south.columns()) {
        if (column == "x" || column == "y" || column == "z") continue;
        EXPECT_EQ(east.cell(row, column), south.cell(row, column)) << column;
      }
    }
  }
};

TEST_F(AxesOfScenes, GiveTheSameLightOnEveryDevice) {
  compute_both({"--device", "cpu"});
  expect_same_light();
  if (nlohmann::json::parse(run({"info", "--json"}).out).at("devices").empty()) {
    ASSERT_FALSE(is_set("SUNFLECK_REQUIRE_DEVICE")) << "no Vulkan device, and SUNFLECK_REQUIRE_DEVICE=1 asks for one";
    GTEST_SKIP() << "no Vulkan device on this machine";
  }
  const Files on_cpu = csv_files("east");
  compute_both({"--device", "lavapipe"});
  expect_same_light();
  EXPECT_EQ(csv_files("east"), on_cpu);
}

TEST_F(AxesOfScenes, TablesHaveTheirCoordinates) {
  compute_both({"--device", "cpu", "--export", "csv"});
  for (const char* name : {"sensors.csv", "plants.csv", "triangles.csv"}) {
    SCOPED_TRACE(name);
    expect_same_rows_elsewhere(name);
  }
  const Table plants(file("plants.csv", "east"));
  ASSERT_EQ(plants.size(), 4U);
  EXPECT_EQ(plants.cell(2, "plant"), "11");
  EXPECT_EQ(plants.number(2, "x"), 1.0);
  EXPECT_EQ(plants.number(2, "y"), 1.0);
  const Table sensors(file("sensors.csv", "east"));
  EXPECT_EQ(sensors.cell(0, "x") + " " + sensors.cell(0, "y") + " " + sensors.cell(0, "z"), "1.75 1.25 0.125");
}

TEST_F(AxesOfScenes, MapsRunFromTheSouthWestCorner) {
  compute_both({"--device", "cpu"});
  const Table south(file("plane_0.250.csv", "south"));
  const Table east(file("plane_0.250.csv", "east"));
  ASSERT_EQ(east.size(), 54U);
  EXPECT_EQ(east.columns()[0], "x_m");
  EXPECT_EQ(east.columns()[1], "y_m");
  EXPECT_NE(file("plane_0.250.csv", "east").find("9 x 6 cells\n"), std::string::npos);
  std::map<std::string, int> shares;
  for (std::size_t row = 0; row < 54; ++row) {
    const std::size_t eastward = row % 9;
    const std::size_t northward = row / 9;
    EXPECT_NEAR(east.number(row, "x_m"), 0.25 * static_cast<double>(eastward) + 0.125, 1e-8);
    EXPECT_NEAR(east.number(row, "y_m"), 0.25 * static_cast<double>(northward) + 0.125, 1e-8);
    const std::size_t same = (8 - eastward) * 6 + (5 - northward);
    for (const char* column : {"sunfleck", "PAR_direct", "PAR_total"}) {
      EXPECT_EQ(east.cell(row, column), south.cell(same, column)) << row;
    }
    ++shares[east.cell(row, "sunfleck")];
  }
  EXPECT_GT(shares.size(), 5U) << "a map without shade would show no order";
}

TEST_F(AxesOfScenes, CamerasSeeTheSame) {
  compute_both({"--device", "cpu"});
  const auto draw = [&](const std::string& source, const std::string& picture, const Arguments& more) {
    const Outcome drawn = run(Arguments{"render", source, "--device", "cpu", "-o", picture} + more);
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    return content(folder_ / picture);
  };
  const Arguments small{"--size", "96x72"};
  const std::string seen = draw("south", "south.exr", small);
  EXPECT_GT(seen.size(), 1000U);
  EXPECT_EQ(draw("east", "east.exr", small), seen) << "of a finished result";
  const Arguments coarse = small + Arguments{"--error", "0.1"};
  EXPECT_EQ(draw("east.toml", "east.exr", coarse), draw("south.toml", "south.exr", coarse));
  const Arguments large{"--size", "400x300"};
  EXPECT_NE(draw("east", "east.png", large), draw("south", "south.png", large)) << "the axes drawn are those of the scene";
}

// Every mesh that the program writes of a scene lies in its place again when a scene with the same axes reads it.
TEST_F(AxesOfScenes, MeshesReturnToTheirPlaces) {
  compute_both({"--device", "cpu", "--export", "csv,glb"});
  const Table known(file("triangles.csv", "east"));
  std::filesystem::copy(folder_ / "east" / "canopy.glb", folder_ / "exported.glb");
  for (const std::string name : {"a.obj", "a.ply", "a.glb", "a.gltf", "a.can"}) {
    EXPECT_EQ(run({"convert", "east.toml", name}).status, 0) << name;
  }
  EXPECT_EQ(content(folder_ / "a.obj").substr(0, 38), "# sunfleck: x east, y north, z up; m\nv");
  const std::string begin = "axes = \"east-north-up\"\n" + axes_light + "[plot]\nsize = [2.25, 1.5]\n[[geometry]]\nfile = \"";
  for (const std::string name : {"a.obj", "a.ply", "a.glb", "a.gltf", "a.can", "exported.glb"}) {
    SCOPED_TRACE(name);
    folder_.write("back.toml", begin + name + "\"\n");
    simulate("back.toml", {"--device", "cpu", "--grid", "0.05", "--passes", "8", "--images", "none", "--export", "csv"});
    const Table back(file("triangles.csv"));
    ASSERT_EQ(back.size(), known.size());
    // glTF groups triangles by organ and material, so that their order may differ.
    for (std::size_t row = 0; row < known.size(); ++row) {
      double nearest_m = 1.0;
      for (std::size_t other = 0; other < known.size(); ++other) {
        double distance_m = 0.0;
        for (const char* axis : {"x", "y", "z"}) {
          distance_m = std::max(distance_m, std::abs(back.number(row, axis) - known.number(other, axis)));
        }
        nearest_m = std::min(nearest_m, distance_m);
      }
      EXPECT_LT(nearest_m, 1e-6) << row;
    }
  }
}

// glTF has y up; x east, y north is then x, -z.
TEST_F(AxesOfScenes, UprightMeshesFaceNorthAsInGltf) {
  folder_.write("upright.obj", "v 0.5 0.25 -0.25\nv 0.75 0.25 -0.25\nv 0.5 0.25 -0.5\nusemtl leaf\nf 1 2 3\n");
  folder_.write("up.toml", "axes = \"east-north-up\"\n" + axes_light +
                               "[plot]\nsize = [2.25, 1.5]\n[[geometry]]\nfile = \"upright.obj\"\nup = \"y\"\n"
                               "[[geometry]]\nfile = \"upright.obj\"\nup = \"y\"\nheading = 90\nat = [[1.0, 1.0, 0.0]]\n");
  simulate("up.toml", {"--device", "cpu", "--grid", "0.05", "--passes", "8", "--images", "none", "--export", "csv"});
  const Table triangles(file("triangles.csv"));
  EXPECT_NEAR(triangles.number(0, "x"), 0.5 + 0.25 / 3, 1e-6);
  EXPECT_NEAR(triangles.number(0, "y"), 0.25 + 0.25 / 3, 1e-6);
  EXPECT_NEAR(triangles.number(0, "z"), 0.25, 1e-6);
  // Clockwise as seen from above, north turns east and east turns south.
  EXPECT_NEAR(triangles.number(1, "x"), 1.0 + 0.25 + 0.25 / 3, 1e-6);
  EXPECT_NEAR(triangles.number(1, "y"), 1.0 - 0.5 - 0.25 / 3, 1e-6);
}

TEST_F(AxesOfScenes, RefusesUnknownNames) {
  folder_.write("wrong.toml", "axes = \"east-north-top\"\n" + axes_light + "[plot]\nsize = [1, 1]\n");
  const Outcome outcome = run({"run", "wrong.toml", "-o", "out"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("wrong.toml:1: axes"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("east-north-up"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

// Warnings name the coordinates of the scene, and numbers that can be copied into it.
TEST_F(AxesOfScenes, WarningsGiveTheirCoordinates) {
  std::string text = "axes = \"east-north-up\"\n" + axes_light + "[plot]\nsize = [3.0, 1.5]\nperiodic = false\n";
  text += "[[sensor]]\nname = \"far\"\nfrom = [3.5, 1.0, 0.1]\n[[geometry]]\nfile = \"plant.obj\"\nat = [[";
  const Arguments quick{"--device", "cpu", "--grid", "0.1", "--passes", "8", "--images", "none"};
  folder_.write("far.toml", text + "5.0, 0.0, 0.0]]\n");
  const Outcome far = run(Arguments{"run", "far.toml", "-o", "far"} + quick);
  EXPECT_NE(far.err.find("x = 3.5 m, y = 1 m lies outside the plot; give x in 0..3 and y in 0..1.5"), std::string::npos)
      << far.err;
  EXPECT_NE(far.err.find("extends over x 4.75..5.5, y 0..0.5 m, outside the plot x 0..3, y 0..1.5 m; at = [[1.375, 0.5, 0]] "
                         "would centre it"),
            std::string::npos)
      << far.err;
  folder_.write("near.toml", text + "1.375, 0.5, 0]]\n");
  EXPECT_EQ(run(Arguments{"run", "near.toml", "-o", "near"} + quick).err.find("would centre it"), std::string::npos);
}

}  // namespace
}  // namespace sunfleck::regression
