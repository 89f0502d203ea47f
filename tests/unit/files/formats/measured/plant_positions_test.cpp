#include "files/formats/measured/plant_positions.h"

#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace sunfleck {
namespace {

class PlantPositions : public testing::Test {
 protected:
  [[nodiscard]] std::vector<PlantPosition> read(const std::string& text, HeightColumn height = HeightColumn::y) const {
    return read_plant_positions(folder_.write("plants.csv", text), height);
  }

  TempFolder folder_;
};

TEST_F(PlantPositions, AreReadByTheNamesOfTheColumns) {
  const auto got = read("# a field\nheading, z, plant, x\n90, 2.5, 7, -1\n\n-45,3,4,1e1\n");
  ASSERT_EQ(got.size(), 2U);
  EXPECT_EQ(got[0].plant, 7U);
  EXPECT_EQ(got[0].x_m, -1.0);
  EXPECT_EQ(got[0].y_m, 0.0);
  EXPECT_EQ(got[0].z_m, 2.5);
  EXPECT_EQ(got[0].heading_deg, 90.0);
  EXPECT_EQ(got[0].scale, 1.0);
  EXPECT_EQ(got[1].x_m, 10.0);
  EXPECT_FALSE(read("x,z\n1,2\n")[0].plant);
  EXPECT_EQ(read("x,y,z,scale\n1,0.5,2,3\n")[0].y_m, 0.5);
}

TEST_F(PlantPositions, MayHaveTheHeightInZ) {
  const auto got = read("plant,x,y\n1,2,3\n", HeightColumn::z);
  EXPECT_EQ(got[0].x_m, 2.0);
  EXPECT_EQ(got[0].y_m, 3.0);
  EXPECT_EQ(got[0].z_m, 0.0);
  EXPECT_EQ(read("x,y,z\n1,2,0.5\n", HeightColumn::z)[0].z_m, 0.5);
  EXPECT_EQ(read("x;y;z\n1,5;2;0,5\n", HeightColumn::z)[0].z_m, 0.5);
  expect_refusal([&] { static_cast<void>(read("plant,x,z\n1,2,3\n", HeightColumn::z)); },
                 "no column y (plants need x (east) and y (north)); begin with a line such as plant,x,y,heading,scale");
}

TEST_F(PlantPositions, RefuseWhatIsWrongByItsLine) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "plants.csv: only blank lines"},
      {"x,z\n", "plants.csv:1: no rows"},
      {"x,y\n1,2\n", "plants.csv:1: no column z"},
      {"x,z,name\n1,2,3\n", "plants.csv:1: column 'name'"},
      {"x,z,x\n1,2,3\n", "plants.csv:1: column 'x' twice"},
      {"x z\n1 2\n", "plants.csv:1: column 'x z'"},
      {"x;z\n1,5;2.5.1\n", "plants.csv:2: z = '2.5.1'"},
      {"0.3,0.4\n0.5,0.5\n", "plants.csv:1: column '0.3' (the first line must name the columns); begin with a line such as"},
      {"X,z\n1,2\n", "plants.csv:1: column 'X' (names of columns are in small letters); write x"},
      {"x,z\n1\n", "plants.csv:2: 1 cells"},
      {"x,z\n1,two\n", "plants.csv:2: z = 'two'"},
      {"x,z\n1,\n", "plants.csv:2: z is empty"},
      {"x,z\n1,nan\n", "plants.csv:2: z = 'nan'"},
      {"x,z\n1,2\n1e8,0\n", "plants.csv:3: x = 1e+08"},
      {"x,z,heading\n1,2,400\n", "plants.csv:2: heading = 400"},
      {"x,z,scale\n1,2,0\n", "plants.csv:2: scale = 0"},
      {"x,z,scale\n1,2,-1\n", "plants.csv:2: scale = -1"},
      {"plant,x,z\n0,1,2\n", "plants.csv:2: plant = 0"},
      {"plant,x,z\n1.5,1,2\n", "plants.csv:2: plant = 1.5"},
      {"plant,x,z\n3,1,2\n4,1,3\n3,2,2\n", "plants.csv:4: plant = 3 (line 2 has the same number)"},
  };
  for (const auto& [text, place] : wrong) {
    const std::string message = refusal_of([&, text = text] { static_cast<void>(read(text)); });
    expect_three_parts(message);
    EXPECT_NE(message.find(place), std::string::npos) << message << " for " << text;
  }
}

}  // namespace
}  // namespace sunfleck
