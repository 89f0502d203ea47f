#include "base/archive.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

namespace sunfleck {
namespace {

using nlohmann::json;

struct Leaf {
  std::string name;
  double width_m = 0.0;
};

struct Plant {
  int rank = 0;
  bool ripe = false;
  std::vector<double> heights_m;
  double x_m = 0.0, z_m = 0.0;
  std::uint64_t later = 5;
  std::optional<double> error;
  std::optional<Leaf> flag_leaf;
  std::vector<Leaf> leaves;
  std::vector<float> samples;
};

template <class Archive, class Part>
void visit_leaf(const Archive& archive, Part& leaf) {
  archive[0].value(leaf.name);
  archive[1].value(leaf.width_m, 0.0, 1.0);
}

template <class Archive, class Whole>
void visit(const Archive& archive, Whole& plant) {
  const auto leaf = [](const auto& to, auto& part) { visit_leaf(to, part); };
  archive["rank"].value(plant.rank, 0, 30);
  archive["ripe"].value(plant.ripe);
  archive["heights_m"].value(plant.heights_m, 0.0, 3.0);
  archive["place_m"].row(-10.0, 10.0, plant.x_m, plant.z_m);
  archive.recent_value("later", plant.later);
  archive["error"].value(plant.error);
  archive["flag_leaf"].part(plant.flag_leaf, leaf);
  archive["leaves"].list(plant.leaves, leaf);
  archive["samples"].packed(plant.samples, 3);
}

const Plant grown{7, true, {0.5, 2.5}, -1.0, 2.0, 6, 0.1, Leaf{"flag", 0.05}, {{"first", 0.1}, {"second", 0.2}}, {1, 2, 3}};

json stored(const Plant& plant) {
  json store;
  visit(StoreWriter(store), plant);
  return store;
}

TEST(Archive, GivesBackWhatWasWritten) {
  Plant read;
  visit(StoreReader(stored(grown)), read);
  EXPECT_EQ(stored(read), stored(grown));
  EXPECT_EQ(read.leaves.at(1).name, "second");
  EXPECT_EQ(read.samples, grown.samples);
  Plant bare;
  bare.samples = {0, 0, 0};
  Plant same;
  visit(StoreReader(stored(bare)), same);
  EXPECT_FALSE(same.error || same.flag_leaf);
  EXPECT_EQ(stored(same), stored(bare));
}

TEST(Archive, ReadsFilesWithoutARecentValue) {
  json old = stored(grown);
  old.erase("later");
  Plant read;
  visit(StoreReader(old), read);
  EXPECT_EQ(read.later, 5U);
}

TEST(Archive, RefusesWhatIsNotAsDescribed) {
  const json good = stored(grown);
  const std::vector<std::function<void(json&)>> changes = {
      [](json& s) { s.erase("rank"); },
      [](json& s) { s["rank"] = 31; },
      [](json& s) { s["rank"] = 7.5; },
      [](json& s) { s["rank"] = std::numeric_limits<std::uint64_t>::max(); },
      [](json& s) { s["ripe"] = 1; },
      [](json& s) { s["heights_m"][1] = std::numeric_limits<double>::quiet_NaN(); },
      [](json& s) { s["place_m"].push_back(0.0); },
      [](json& s) { s["place_m"][0] = 11.0; },
      [](json& s) { s["later"] = -1; },
      [](json& s) { s["error"] = "small"; },
      [](json& s) { s["flag_leaf"][1] = 2.0; },
      [](json& s) { s["leaves"][0] = "first"; },
      [](json& s) {
        s["samples"] = pack(std::vector<float>{1, 2});
      },
      [](json& s) {
        s["samples"] = pack(std::vector<float>{1, 2, 3, 4});
      }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    json bad = good;
    changes[k](bad);
    const auto read = [&] {
      Plant plant;
      visit(StoreReader(bad), plant);
    };
    EXPECT_THROW(read(), std::exception) << k;
  }
  Plant plant;
  EXPECT_THROW(
      {
        json bad = good;
        bad["samples"] = json::binary({1});
        StoreReader(bad)["samples"].packed(plant.samples, std::size_t{1} << 60U);
      },
      std::runtime_error)
      << "no memory is allocated";
}

TEST(Archive, NamesTheValueOutOfRange) {
  json bad = stored(grown);
  bad["place_m"] = {0.0, 11.0};
  Plant plant;
  try {
    visit(StoreReader(bad), plant);
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "place_m is out of range");
  }
}

}  // namespace
}  // namespace sunfleck
