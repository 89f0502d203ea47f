// Tests optics given by patterns of names.

#include "files/scene/scene_patterns.h"

#include "support/scene_text.h"

#include <gtest/gtest.h>

#include <tuple>

namespace sunfleck {
namespace {

const std::string pattern_head =
    "[plot]\nsize = [4.0, 4.0]\n[sun]\nelevation = 60.0\nazimuth = 90.0\n[[band]]\nname = \"PAR\"\ndirect = 100.0\n"
    "[optics.leaf]\nreflectance = 0.1\n[optics.stem]\nreflectance = 0.2\n[optics.other]\nreflectance = 0.3\n"
    "[[geometry]]\nfile = \"plant.obj\"\n";

class Patterns : public testing::Test {
 protected:
  Patterns() {
    folder_.write("plant.obj",
                  "v 1 1 1\nv 1 1 2\nv 2 1 1\nv 2 1 2\n"
                  "o plant1_blade\nusemtl Leaf.001\nf 1 2 3\nusemtl LEAF.002\nf 2 3 4\n"
                  "o plant1_Trunk7\nusemtl bark\nf 1 2 4\nusemtl green\nf 1 3 4\n");
  }

  [[nodiscard]] Scene read(const std::string& optics) const {
    return read_scene(folder_.write("scene.toml", pattern_head + (optics.empty() ? "" : "optics = " + optics + "\n")));
  }

  // Returns the optics of the four triangles.
  [[nodiscard]] std::vector<std::string> names(const std::string& optics) const {
    const Canopy canopy = read(optics).model.canopy;
    std::vector<std::string> names;
    for (const std::uint16_t number : canopy.optics_of) names.push_back(canopy.optics_names[number]);
    return names;
  }

  [[nodiscard]] std::string refusal(const std::string& optics) const {
    const std::string message = refusal_of([&] { static_cast<void>(read(optics)); });
    expect_three_parts(message);
    return message.substr(std::min(message.size(), message.find("scene.toml")));
  }

  [[nodiscard]] std::string idle(const std::string& optics) const {
    for (const std::string& warning : read(optics).warnings) {
      if (warning.find("matches nothing") != std::string::npos) return warning.substr(warning.find("scene.toml"));
    }
    return "";
  }

  TempFolder folder_;
};

using Strings = std::vector<std::string>;

TEST(Pattern, MatchesWholeNamesWithoutCase) {
  const std::tuple<const char*, const char*, bool> cases[] = {{"leaf", "Leaf", true},
                                                              {"LEAF*", "leaf", true},
                                                              {"leaf*", "leaf.001", true},
                                                              {"leaf", "leaf1", false},
                                                              {"*leaf", "plant1_leaf", true},
                                                              {"*leaf", "leaf1", false},
                                                              {"l?af", "leaf", true},
                                                              {"l?af", "laf", false},
                                                              {"*", "", true},
                                                              {"", "", true},
                                                              {"", "a", false},
                                                              {"?", "", false},
                                                              {"a*b*c", "aXbXbc", true},
                                                              {"a*b*c", "aXbXb", false},
                                                              {"**a", "bca", true},
                                                              {"tree.*", "tree", false},
                                                              {"f?lle", "fölle", true},
                                                              {"*?", "a", true},
                                                              {"*aab", "aaab", true},
                                                              {"a*", "b", false}};
  for (const auto& [pattern, name, matches] : cases)
    EXPECT_EQ(matches_pattern(pattern, name), matches) << pattern << ' ' << name;
}

TEST_F(Patterns, TheFirstThatMatchesDecides) {
  EXPECT_EQ(names(R"({ "leaf*" = "leaf", "*" = "stem" })"), (Strings{"leaf", "leaf", "stem", "stem"}));
  // The order is that of the text, not of the alphabet.
  EXPECT_EQ(names(R"({ "leaf.*" = "other", "*" = "leaf", "bark" = "stem" })"), (Strings{"other", "other", "leaf", "leaf"}));
  EXPECT_EQ(names(R"({ "leaf.002" = "stem", "*" = "leaf" })"), (Strings{"leaf", "stem", "leaf", "leaf"}));
}

TEST_F(Patterns, MatchMaterialsAndOrgans) {
  EXPECT_EQ(names(R"({ "trunk*" = "stem", "*" = "leaf" })"), (Strings{"leaf", "leaf", "stem", "stem"}));
  EXPECT_EQ(names(R"({ "green" = "other", "trunk*" = "stem", "blade" = "leaf" })"), (Strings{"leaf", "leaf", "stem", "other"}));
}

TEST_F(Patterns, MatchAnOrganWithItsRank) {
  EXPECT_EQ(names(R"({ "trunk 7" = "stem", "*" = "leaf" })"), (Strings{"leaf", "leaf", "stem", "stem"}));
  EXPECT_EQ(names(R"({ "trunk 8" = "stem", "* 0" = "stem", "*" = "leaf" })"), (Strings{"leaf", "leaf", "leaf", "leaf"}));
  EXPECT_EQ(idle(R"({ "trunk 7" = "stem", "*" = "leaf" })"), "");
}

TEST_F(Patterns, ATextIsForTheWholeMesh) {
  EXPECT_EQ(names("\"stem\""), (Strings{"stem", "stem", "stem", "stem"}));
}

TEST_F(Patterns, ATableBelowTheGeometry) {
  const std::string table = pattern_head + "[geometry.optics]\n\"t*\" = \"stem\"\n\"*\" = \"leaf\"\n";
  EXPECT_EQ(read_scene(folder_.write("scene.toml", table)).model.canopy.optics_names, (Strings{"leaf", "stem"}));
}

TEST_F(Patterns, TrianglesWithoutAMaterial) {
  folder_.write("plant.obj", "v 1 1 1\nv 1 1 2\nv 2 1 1\nf 1 2 3\n");
  EXPECT_EQ(names(R"({ "unnamed" = "leaf" })"), Strings{"leaf"});
}

TEST_F(Patterns, WarnWhereTheyMatchNothing) {
  EXPECT_EQ(
      idle(R"({ "twig*" = "stem", "*" = "leaf" })"),
      "scene.toml:17: geometry.optics.twig* matches nothing; the names there are: LEAF.002, Leaf.001, Trunk, bark, blade, "
      "green");
  EXPECT_EQ(idle(R"({ "blade" = "stem", "*" = "leaf" })"), "");
  EXPECT_EQ(idle("\"leaf\""), "");
}

TEST_F(Patterns, RefuseWhatTheyDoNotCover) {
  EXPECT_EQ(refusal(R"({ "leaf*" = "leaf" })"),
            "scene.toml:17: geometry.optics (no pattern matches the materials bark, green); add patterns for them, or "
            "\"*\" = \"NAME\" at the end for all the rest");
  EXPECT_EQ(refusal(R"({ "*" = "laef" })"),
            "scene.toml:17: geometry.optics.* = \"laef\" (these optics are not defined); did you mean leaf? Otherwise add "
            "[optics.laef] with reflectance");
  EXPECT_EQ(refusal("{ }").substr(0, 53), "scene.toml:17: geometry.optics (it has no pattern); w");
  EXPECT_NE(refusal(R"({ "*" = 3 })").find("a pattern needs the name of an [optics.NAME]"), std::string::npos);
  EXPECT_NE(refusal("3").find("must be the name of an [optics.NAME], or a table of patterns"), std::string::npos);
}

}  // namespace
}  // namespace sunfleck
