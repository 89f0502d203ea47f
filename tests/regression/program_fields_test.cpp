// Tests fields of plants: placed by a file, and their light plant by plant.

#include "regression/program.h"
#include "support/table.h"

#include <cmath>
#include <map>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

// A plant is two crossed leaves on a square stem; a pot is as well a plant by its number.
const std::string plant_obj = R"(v -0.2 0.3 -0.2
v -0.2 0.3 0.2
v 0.2 0.4 0.2
v 0.2 0.4 -0.2
v -0.02 0 0
v 0.02 0 0
v 0.02 0.3 0
v -0.02 0.3 0
o plant1_leaf1
usemtl Green
f 1 2 3
o plant1_leaf2
f 1 3 4
o plant1_stem
usemtl Bark
f 5 6 7 8
)";
const std::string pot_obj = "v -0.1 0.01 -0.1\nv -0.1 0.01 0.1\nv 0.1 0.01 0.1\nf 1 2 3\n";

const std::string field_scene = R"([plot]
size = [2.0, 3.0]
[sun]
elevation = 50.0
azimuth = 120.0
[sky]
model = "cie-overcast"
[[band]]
name = "PAR"
direct_normal = 300.0
diffuse = 100.0
umol_per_joule = 4.57
[[band]]
name = "NIR"
direct_normal = 300.0
diffuse = 50.0
[soil]
reflectance = 0.2
[optics.leaf]
reflectance = { PAR = 0.1, NIR = 0.45 }
transmittance = { PAR = 0.05, NIR = 0.4 }
[optics.stem]
reflectance = 0.3
[optics.pot]
reflectance = 0.3
role = "structure"
[[geometry]]
file = "plant.obj"
optics = { "green" = "leaf", "*" = "stem" }
positions = "plants.csv"
[[geometry]]
file = "pot.obj"
optics = "pot"
at = [[0.5, 0.0, 0.5]]
)";

class Fields : public ProgramTest {
 protected:
  Fields() {
    folder_.write("plant.obj", plant_obj);
    folder_.write("pot.obj", pot_obj);
    folder_.write("scene.toml", field_scene);
    folder_.write("plants.csv",
                  "plant,x,z,heading,scale\n11,0.5,0.5,0,1\n7,1.5,0.5,45,0.5\n8,0.5,2.5,-90,1\n9,1.5,1.9,10,1.5\n");
    const Outcome outcome = run({"run", "scene.toml", "-o", "out", "--device", "cpu", "--error", "0.02", "--images", "none"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
};

TEST_F(Fields, EachPlantIsTheSumOfItsOrgans) {
  const Table plants(file("plants.csv"));
  const Table organs(file("organs.csv"));
  ASSERT_EQ(plants.size(), 4U) << "the pot is no plant";
  const std::vector<double> numbers{7, 8, 9, 11};
  for (std::size_t p = 0; p < plants.size(); ++p) {
    SCOPED_TRACE(numbers[p]);
    EXPECT_EQ(plants.number(p, "plant"), numbers[p]);
    std::map<std::string, double> sums;
    for (std::size_t o = 0; o < organs.size(); ++o) {
      if (organs.number(o, "plant") != numbers[p]) continue;
      const double area_m2 = organs.number(o, "area_m2");
      if (organs.cell(o, "role") == "leaf") sums["leaf_area_m2"] += area_m2;
      for (const std::string band : {"PAR", "NIR"}) {
        sums[band + "_incident"] += area_m2 * (organs.number(o, band + "_direct") + organs.number(o, band + "_indirect"));
        sums[band + "_absorbed"] += area_m2 * organs.number(o, band + "_absorbed");
      }
    }
    ASSERT_EQ(sums.size(), 5U);
    for (const auto& [column, sum] : sums) EXPECT_NEAR(plants.number(p, column), sum, 2e-6 * sum) << column;
    for (const std::string band : {"PAR", "NIR"}) {
      const double error = plants.number(p, band + "_absorbed_error");
      EXPECT_GT(error, 0.0);
      EXPECT_LT(error, 0.2 * plants.number(p, band + "_absorbed"));
    }
    const double umol_s = 4.57 * plants.number(p, "PAR_absorbed");
    EXPECT_NEAR(plants.number(p, "PAR_absorbed_umol_s"), umol_s, 1e-8 * umol_s) << "nine digits are written";
  }
  EXPECT_NEAR(plants.number(0, "leaf_area_m2"), 0.25 * plants.number(1, "leaf_area_m2"), 1e-6) << "half as large";
  EXPECT_NEAR(plants.number(2, "height_m"), 0.6, 1e-6) << "0.4 m times 1.5";
  EXPECT_EQ(plants.number(1, "x"), 0.5);
  EXPECT_EQ(plants.number(1, "y"), 0.0);
  EXPECT_EQ(plants.number(1, "z"), 2.5);
}

TEST_F(Fields, AllPlantsTogetherAbsorbWhatTheVegetationAbsorbs) {
  const Table plants(file("plants.csv"));
  const json summary = json::parse(file("summary.json"));
  for (const json& band : summary["bands"]) {
    double absorbed_w = 0.0;
    for (std::size_t p = 0; p < plants.size(); ++p)
      absorbed_w += plants.number(p, band["name"].get<std::string>() + "_absorbed");
    EXPECT_NEAR(absorbed_w / 6.0, band["absorbed_vegetation"].get<double>(), 1e-5 * absorbed_w);
    EXPECT_EQ(band["residual"], 0);
  }
}

// Plants that share their mesh's triangles get what those with triangles of their own get, on every device.
TEST_F(Fields, PlantsMayShareTheTrianglesOfTheirMesh) {
  const Table own(file("plants.csv"));
  EXPECT_EQ(json::parse(file("summary.json"))["instances"], (json{{"meshes", 0}, {"copies", 0}}));
  std::string scene = field_scene;
  scene.insert(scene.find("positions ="), "instances = true\n");
  folder_.write("shared.toml", scene);
  const Outcome info = run({"info", "shared.toml", "--error", "0.02"});
  EXPECT_NE(info.out.find("tree: 5 triangles; 4 copies share those of 1 mesh\n"), info.out.npos) << info.out;
  std::map<std::string, std::string> of_device;
  for (const char* device : {"cpu", "lavapipe"}) {
    const Outcome outcome =
        run({"run", "shared.toml", "-o", "out", "--device", device, "--error", "0.02", "--images", "none", "--seed", "5"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const char* table : {"plants.csv", "organs.csv", "profile.csv"}) {
      const auto [known, fresh] = of_device.try_emplace(table, file(table));
      EXPECT_EQ(known->second, file(table)) << table << " on " << device;
    }
  }
  const json summary = json::parse(file("summary.json"));
  EXPECT_EQ(summary["instances"], (json{{"meshes", 1}, {"copies", 4}}));
  for (const json& band : summary["bands"]) EXPECT_EQ(band["residual"], 0);
  const Table shared(file("plants.csv"));
  ASSERT_EQ(shared.size(), own.size());
  for (std::size_t p = 0; p < own.size(); ++p) {
    for (const std::string column : {"plant", "x", "z", "height_m", "leaf_area_m2"}) {
      EXPECT_NEAR(shared.number(p, column), own.number(p, column), 1e-6) << column;
    }
    for (const std::string column : {"PAR_absorbed", "NIR_absorbed", "sunlit_leaf_fraction"}) {
      const double bound = std::hypot(own.number(p, column + "_error"), shared.number(p, column + "_error"));
      EXPECT_NEAR(shared.number(p, column), own.number(p, column), 3.0 * bound) << column;
    }
  }
}

TEST_F(Fields, TheInputIsNotReplaced) {
  const std::string positions = content(folder_ / "plants.csv");
  const Outcome outcome = run({"run", "scene.toml", "-o", ".", "--device", "cpu", "--images", "none"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("plants.csv (the result would replace this file of the scene); give another folder"),
            outcome.err.npos)
      << outcome.err;
  EXPECT_EQ(content(folder_ / "plants.csv"), positions);
}

TEST_F(Fields, ErrorsCoverTheSpreadBetweenRuns) {
  // Of 3 seeds x 4 plants x 2 bands, differences of more than three half-widths would be seven standard errors.
  const Table first(file("plants.csv"));
  for (const char* seed : {"2", "3", "4"}) {
    const Outcome outcome =
        run({"run", "scene.toml", "-o", "out", "--device", "cpu", "--error", "0.02", "--images", "none", "--seed", seed});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Table other(file("plants.csv"));
    for (std::size_t p = 0; p < first.size(); ++p) {
      for (const std::string column : {"PAR_absorbed", "NIR_absorbed", "PAR_incident", "sunlit_leaf_fraction"}) {
        const double bound = std::hypot(first.number(p, column + "_error"), other.number(p, column + "_error"));
        EXPECT_NEAR(first.number(p, column), other.number(p, column), 3.0 * bound) << column;
      }
    }
  }
}

}  // namespace
}  // namespace sunfleck::regression
