// Tests [[plane]] and [[sensor]].

#include "files/scene/scene_reader.h"
#include "support/scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunfleck {
namespace {

class SceneReceivers : public SceneFolder {
 protected:
  void expect_refused(const std::string& lines, const std::string& mark, const std::string& key,
                      const std::string& hint) const {
    SceneFolder::expect_refused(bare_scene + lines, mark, key, hint);
  }
};

TEST_F(SceneReceivers, ReadsEveryKey) {
  const Scene scene = read(lit_scene);
  ASSERT_EQ(scene.model.planes.size(), 2U);
  EXPECT_EQ(scene.model.planes[0].height_m, 0.25);  // in ascending order
  EXPECT_EQ(scene.model.planes[0].cells_x, 200);    // 1 cm
  EXPECT_EQ(scene.model.planes[0].cells_z, 300);
  EXPECT_EQ(scene.model.planes[1].height_m, 0.5);
  EXPECT_EQ(scene.model.planes[1].cells_x, 20);
  EXPECT_EQ(scene.model.planes[1].cells_z, 30);
  ASSERT_EQ(scene.model.sensors.size(), 2U);
  const Sensor& line = scene.model.sensors[0];
  EXPECT_EQ(line.name, "ceptometer");
  EXPECT_EQ(line.response, SensorResponse::cosine);
  EXPECT_EQ(line.normal, glm::dvec3(0.0, -1.0, 0.0));
  ASSERT_EQ(line.points_m.size(), 5U);
  EXPECT_EQ(line.points_m[0], glm::dvec3(0.2, 1.2, 0.1));
  EXPECT_EQ(line.points_m[4], glm::dvec3(0.2, 1.2, 2.1));
  EXPECT_NEAR(line.points_m[1].z, 0.6, 1e-15);
  const Sensor& ball = scene.model.sensors[1];
  EXPECT_EQ(ball.response, SensorResponse::spherical);
  EXPECT_EQ(ball.points_m, (std::vector<glm::dvec3>{{1.0, 1.0, 1.0}}));
  EXPECT_EQ(read(bare_scene + "[[sensor]]\nname = \"a\"\nfrom = [0, 0, 0]\n").model.sensors[0].normal,
            glm::dvec3(0.0, 1.0, 0.0));
}

// In large and long plots the default cells grow so that there are at most a million.
TEST_F(SceneReceivers, CellsOfTheirOwnAreCapped) {
  for (const auto& [size, x, z] :
       {std::tuple{"[0.001, 0.001]", 1, 1}, std::tuple{"[1, 2]", 100, 200}, std::tuple{"[1000, 1000]", 1000, 1000},
        std::tuple{"[1e6, 1e-6]", 1000000, 1}, std::tuple{"[1e-6, 1e6]", 1, 1000000}, std::tuple{"[100, 0.25]", 10000, 25}}) {
    const Scene scene = read(replaced(bare_scene, "[1.0, 1.0]", size) + "[[plane]]\nheight = 0\n");
    EXPECT_EQ(scene.model.planes[0].cells_x, x) << size;
    EXPECT_EQ(scene.model.planes[0].cells_z, z) << size;
  }
}

TEST_F(SceneReceivers, RefusesWhatIsNoPlane) {
  const std::string head = "[[plane]]\nheight = 0.5\n";
  expect_refused("[plane]\nheight = 1\n", "[plane]", "plane", "write [[plane]]");
  expect_refused("[[plane]]\n", "[[plane]]", "plane.height", "add height");
  expect_refused("[[plane]]\nheight = -0.1\n", "height", "plane.height = -0.1", "above the ground");
  expect_refused("[[plane]]\nheight = inf\n", "height", "plane.height", "0..10000000");
  expect_refused("[[plane]]\nheight = \"top\"\n", "height", "plane.height", "number");
  expect_refused(head + "cells = [10, 0]\n", "cells", "plane.cells, item 2 = 0", "whole numbers");
  expect_refused(head + "cells = [10, 10.5]\n", "cells", "plane.cells", "10.5 is not a whole number");
  expect_refused(head + "cells = 10\n", "cells", "plane.cells = 10", "list of 2");
  expect_refused(head + "cells = 4\n", "cells", "plane.cells = 4", "write it as [180, 240]");
  expect_refused(head + "cells = [10000, 10000]\n", "cells", "plane.cells", "1e+08 cells so far, but at most 6.4e+07");
  expect_refused(head + "cells = [8000, 8000]\n[[plane]]\nheight = 2\n", "height = 2", "plane.height", "use fewer");
  expect_refused(head + "cell = [10, 10]\n", "cell =", "plane.cell", "did you mean cells?");
  expect_refused(head + "[[plane]]\nheight = 0.50\n", "height = 0.50", "plane.height", "a different height");
  expect_refused(head + "[[plane]]\nheight = 0.5004\n", "height = 0.5004", "plane.height", "the same file, plane_0.500.csv");
  std::string many;
  for (int i = 0; i < 65; ++i) many += fmt::format("[[plane]]\nheight = {}\ncells = [1, 1]\n", i);
  expect_refusal([&] { static_cast<void>(read(bare_scene + many)); }, "there are 65, but at most 64");
  EXPECT_EQ(read(bare_scene + many.substr(0, many.rfind("[[plane]]"))).model.planes.size(), 64U);
}

TEST_F(SceneReceivers, RefusesWhatIsNoSensor) {
  const std::string head = "[[sensor]]\nname = \"a\"\nfrom = [0, 1, 0]\n";
  const std::string line = head + "to = [1, 1, 1]\n";
  expect_refused("[[sensor]]\nfrom = [0, 0, 0]\n", "[[sensor]]", "sensor.name", "add name");
  expect_refused("[[sensor]]\nname = \"a,b\"\nfrom = [0, 0, 0]\n", "name = \"a,b\"", "sensor.name", "letters, digits");
  expect_refused("[[sensor]]\nname = \"a\"\n", "[[sensor]]", "sensor.from", "add from");
  expect_refused("[[sensor]]\nname = \"a\"\nfrom = [0, 0]\n", "from", "sensor.from", "3 numbers");
  expect_refused("[[sensor]]\nname = \"a\"\nfrom = [0, nan, 0]\n", "from", "sensor.from, item 2", "metres");
  expect_refused(head + "points = 3\n", "points", "sensor.points", "add `to`");
  expect_refused(line, "[[sensor]]", "sensor.points", "add points");
  expect_refused(line + "points = 1\n", "points", "sensor.points = 1", "2..100000");
  expect_refused(line + "points = 2.0\n", "points", "sensor.points", "whole number");
  expect_refused(line + "points = 100001\n", "points", "sensor.points", "2..100000");
  expect_refused(head + "response = \"flat\"\n", "response", "sensor.response", "one of cosine, spherical");
  expect_refused(head + "normal = [0, 0, 0]\n", "normal", "sensor.normal", "zero length");
  expect_refused(head + "response = \"spherical\"\nnormal = [0, 1, 0]\n", "normal", "sensor.normal", "remove it");
  expect_refused(head + "[[sensor]]\nname = \"a\"\nfrom = [0, 2, 0]\n", "name = \"a\"\nfrom = [0, 2", "sensor.name",
                 "a different name");
  expect_refused(head + "height = 1\n", "height", "sensor.height", "remove it");
  expect_refused(line + "points = 60000\n[[sensor]]\nname = \"b\"\nfrom = [0, 1, 0]\nto = [0, 2, 0]\npoints = 60001\n",
                 "points = 60001", "sensor.points", "120001 points");
}

}  // namespace
}  // namespace sunfleck
