// Tests the words by which surfaces are recognised.
#include "physics/canopy/role.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunfleck::test {
namespace {

void expect_role(const std::vector<std::string>& names, std::optional<Role> role) {
  for (const std::string& name : names) EXPECT_EQ(role_from_name(name), role) << name;
}

TEST(Role, IsRecognisedByAWordAnywhereInTheName) {
  expect_role({"leaf", "Leaf.001", "LEAF", "leaf7", "leaves", "maize_leaf3", "taraxacum_leaf", "flagleaf", "leaflet",
               "Leaflets", "LeafMat", "BasilLeaf", "leafy", "lamina-2", "leaf blade", "unifoliolate_blades"},
              Role::leaf);
  expect_role(
      {"stem", "Stems", "mainstem", "petiole_3", "Petioles", "trunk.007", "branches.004", "culm", "Metamer", "internode2"},
      Role::stem);
  expect_role({"fruit", "grapefruits", "ear", "Ears", "tassel1", "cob", "berries", "flower.002"}, Role::fruit);
  expect_role({"solar_panel", "Panels", "wall_north", "pot", "plant1_pot", "flowerpot", "FlowerPots", "TrellisWire", "benches",
               "floor"},
              Role::structure);
  expect_role({"lamp", "LED 3", "lamps"}, Role::lamp);
  expect_role({"soil", "soil2", "Soil_left", "ground", "Earth.001"}, Role::soil);
}

TEST(Role, FollowsTheLastWordOfACompound) {
  expect_role({"stem_leaf", "ear leaf", "pot_leaf"}, Role::leaf);
  expect_role({"leaf petiole", "LeafStem"}, Role::stem);
}

TEST(Role, IsNotThatOfWhatStandsBeforeAPlant) {
  expect_role({"pole_bean", "pot_plant3", "PotPlants", "WallGrass", "led_plants", "soil plant"}, std::nullopt);
  expect_role({"leaf_of_plant_3", "tree_leaf"}, Role::leaf);
  expect_role({"plant_pot"}, Role::structure);
}

TEST(Role, IsNotRecognisedInsideOtherWords) {
  expect_role({"",
               "Circle.166_Circle.168",
               "maize",
               "bear",
               "year",
               "earth worm",
               "clamp",
               "wallet",
               "system",
               "ecosystems",
               "groundcover",
               "ground cover",
               "potato",
               "hotspot",
               "pledge",
               "podium",
               "bulb",
               "sunflower2",
               "cauliflower",
               "Material.003",
               "mat_all",
               "42"},
              std::nullopt);
}

}  // namespace
}  // namespace sunfleck::test
