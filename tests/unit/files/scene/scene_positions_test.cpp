// Tests copies placed by a file of positions.

#include "files/scene/scene_positions.h"

#include "support/scene_text.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

const std::string field_head =
    "[plot]\nsize = [9.0, 9.0]\nperiodic = false\n[sun]\nelevation = 60.0\nazimuth = 90.0\n[[band]]\nname = \"PAR\"\n"
    "direct = 100.0\n[optics.leaf]\nreflectance = 0.1\n";
const std::string plants = "[[geometry]]\nfile = \"leaf.obj\"\noptics = \"leaf\"\n";

class Positions : public testing::Test {
 protected:
  Positions() { folder_.write("leaf.obj", "v 0 1 0\nv 0 1 1\nv 1 1 0\nf 1 2 3\n"); }

  [[nodiscard]] Scene read(const std::string& csv, const std::string& more = "positions = \"plants.csv\"\n") const {
    folder_.write("plants.csv", csv);
    return read_scene(folder_.write("scene.toml", field_head + plants + more));
  }

  [[nodiscard]] std::string refusal(const std::string& csv, const std::string& more = "positions = \"plants.csv\"\n") const {
    const std::string message = refusal_of([&] { static_cast<void>(read(csv, more)); });
    expect_three_parts(message);
    return message.substr(std::min(message.find("scene.toml"), message.find("plants.csv:")));
  }

  TempFolder folder_;
};

TEST_F(Positions, PlaceCopiesAsAtAndHeadingDo) {
  const Canopy by_file = read("x,y,z,heading\n1,0.5,2,90\n3,0,4,-30\n").model.canopy;
  const Canopy by_keys = read("x,z\n0,0\n", "at = [[1, 0.5, 2], [3, 0, 4]]\nheading = [90, -30]\n").model.canopy;
  EXPECT_EQ(by_file.corners, by_keys.corners);
  EXPECT_EQ(by_file.plants, by_keys.plants);
  EXPECT_EQ(by_file.organs, by_keys.organs);
}

TEST_F(Positions, ScaleEachPlant) {
  const Canopy canopy = read("scale,z,x\n1,2,1\n0.5,4,3\n").model.canopy;
  ASSERT_EQ(canopy.size(), 2U);
  EXPECT_NEAR(area_m2(canopy.corners[0]), 0.5, 1e-6);
  EXPECT_NEAR(area_m2(canopy.corners[1]), 0.125, 1e-6);
  EXPECT_EQ(canopy.corners[1][0], glm::vec3(3.0F, 0.5F, 4.0F));
}

TEST_F(Positions, NumberThePlants) {
  const Canopy canopy =
      read("plant,x,z\n207,1,2\n12,3,4\n", "positions = \"plants.csv\"\n" + plants + "at = [[5, 0, 6]]\n").model.canopy;
  EXPECT_EQ(canopy.organs[0].plant, 207U);
  EXPECT_EQ(canopy.organs[1].plant, 12U);
  EXPECT_EQ(canopy.organs[2].plant, 208U) << "the next one continues from the highest number";
  EXPECT_EQ(canopy.plants, (std::vector<PlantSite>{{12, {3, 0, 4}}, {207, {1, 0, 2}}, {208, {5, 0, 6}}}));
}

TEST_F(Positions, MakePartsOfOnePlantWithItsNumber) {
  const std::string stems = "[[geometry]]\nfile = \"stem.obj\"\noptics = \"leaf\"\n";
  folder_.write("stem.obj", "v 0 0 0\nv 0 1 0\nv 0 1 1\nf 1 2 3\n");
  const std::string file = "positions = \"plants.csv\"\n";
  const std::vector<PlantSite> sites = {{5, {1, 0, 2}}, {6, {3, 0, 4}}};
  const auto plants_of = [](const Canopy& canopy) {
    std::vector<std::uint32_t> numbers;
    for (const Organ& organ : canopy.organs) numbers.push_back(organ.plant);
    return numbers;
  };
  const std::string counted = "plant = 5\nat = [[1, 0, 2], [3, 0, 4]]\n";
  for (const std::string& more : {file + stems + file, counted + stems + counted, file + stems + counted}) {
    const Canopy canopy = read("plant,x,z\n5,1,2\n6,3,4\n", more).model.canopy;
    EXPECT_EQ(plants_of(canopy), (std::vector<std::uint32_t>{5, 6, 5, 6})) << more;
    EXPECT_EQ(canopy.plants, sites) << more;
  }
}

TEST_F(Positions, RefuseNumbersOfPlantsThatAreNumberedWithoutThem) {
  EXPECT_EQ(refusal("x,z\n1,2\n", "at = [[0, 0, 0], [1, 0, 1]]\n" + plants + "plant = 2\n"),
            "scene.toml:19: geometry.plant = 2 (plant 2 is there already, from an earlier [[geometry]]); use numbers above 2, "
            "or give "
            "that one numbers, too, if both are parts of one plant");
  EXPECT_EQ(refusal("x,z\n1,2\n", "positions = \"plants.csv\"\nplant = 2\n").substr(0, 56),
            "scene.toml:16: geometry.plant = 2 (positions is also giv");
  EXPECT_NE(refusal("x,z\n1,2\n", "plant = 0\n").find("geometry.plant = 0 (must be a whole number in 1..1000000000)"),
            std::string::npos);
  EXPECT_NE(refusal("x,z\n1,2\n", "[[geometry]]\ngenerator = \"maize\"\nplant = 1\n").find("geometry.plant"),
            std::string::npos);
  folder_.write("leaf.obj", "v 0 1 0\nv 0 1 1\nv 1 1 0\no plant1_leaf1\nf 1 2 3\no plant2_leaf1\nf 1 2 3\n");
  EXPECT_NE(refusal("x,z\n1,2\n", "plant = 1\n").find("the mesh consists of 2 plants"), std::string::npos);
}

TEST_F(Positions, AreAFileOfTheScene) {
  const Scene scene = read("x,z\n1,2\n");
  EXPECT_TRUE(std::any_of(scene.files.begin(), scene.files.end(),
                          [](const SourceFile& file) { return file.path.filename() == "plants.csv" && !file.digest.empty(); }));
  EXPECT_NE(scene.digest, read("x,z\n1,3\n").digest);
}

TEST_F(Positions, RefuseWhatContradictsThem) {
  EXPECT_EQ(refusal("x,z\n1,2\n", "positions = \"plants.csv\"\nat = [[1, 2, 3]]\n").substr(0, 56),
            "scene.toml:16: geometry.at = [...] (positions is also gi");
  EXPECT_NE(refusal("x,z\n1,2\n", "positions = \"plants.csv\"\nheading = 3\n").find("geometry.heading"), std::string::npos);
  EXPECT_NE(refusal("x,z\n1,2\n", "positions = \"none.csv\"\n").find("there is no such file"), std::string::npos);
  EXPECT_NE(refusal("x,z\n1,2\n", "positions = \"../plants.csv\"\n").find("outside the scene's folder"), std::string::npos);
  EXPECT_EQ(refusal("plant,x,z\n1,1,2\n", "at = [[0, 0, 0]]\n" + plants + "positions = \"plants.csv\"\n"),
            "scene.toml:19: geometry.positions = \"plants.csv\" (plant 1 is there already, from an earlier [[geometry]]); use "
            "numbers above 1, or give that one numbers, too, if both are parts of one plant");
  folder_.write("leaf.obj", "v 0 1 0\nv 0 1 1\nv 1 1 0\no plant1_leaf1\nf 1 2 3\no plant2_leaf1\nf 1 2 3\n");
  EXPECT_NE(refusal("plant,x,z\n1,1,2\n").find("the mesh consists of 2 plants"), std::string::npos);
}

TEST_F(Positions, RefuseAMeshThatGrowsTooLarge) {
  EXPECT_NE(refusal("x,z,scale\n1,2,1e6\n1,2,1e6\n", "scale = 100\npositions = \"plants.csv\"\n").find("it extends to 1e+08 m"),
            std::string::npos);
}

}  // namespace
}  // namespace sunfleck
