// Tests the readers of CARIBU's optical properties and domains.

#include "files/formats/caribu/caribu_reader.h"

#include "support/caribu_files.h"
#include "support/scene_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

std::string refusal(const std::filesystem::path& file) {
  const auto message = message_of([&] {
    if (file.extension() == ".opt")
      static_cast<void>(read_opt(file));
    else
      static_cast<void>(read_domain(file));
  });
  if (!message) return "accepted";
  expect_three_parts(*message);
  return message->substr(file.parent_path().string().size() + 1);
}

TEST(CaribuReader, Optics) {
  const TempFolder folder;
  const CaribuOptics optics = read_opt(folder.write("a.opt", grey_opt));
  EXPECT_EQ(optics.soil_reflectance, 0.15);
  ASSERT_EQ(optics.species.size(), 2U);
  const SpeciesOptics& first = optics.species[0];
  EXPECT_EQ(first.stem_reflectance, 0.1);
  EXPECT_EQ(first.upper.reflectance, 0.12);
  EXPECT_EQ(first.upper.transmittance, 0.06);
  EXPECT_EQ(first.lower.reflectance, 0.2);
  EXPECT_EQ(first.lower.transmittance, 0.05);
  EXPECT_EQ(optics.species[1].lower.transmittance, 0.45);
  // Contains tabs, other line ends, comments behind numbers and in another encoding; the lines are in any order except for that
  // of the species.
  const CaribuOptics other = read_opt(folder.write("b.opt",
                                                   "# esp\xe8"
                                                   "ce\r\n\te d .5 d 1 0 d 0 1# all\r\n\r\n s  d 1e-1\r\nn 1"));
  EXPECT_EQ(other.soil_reflectance, 0.1);
  ASSERT_EQ(other.species.size(), 1U);
  EXPECT_EQ(other.species[0].upper.reflectance, 1.0);
  EXPECT_EQ(other.species[0].lower.transmittance, 1.0);
}

TEST(CaribuReader, OpticsAreRefusedWithFileAndLine) {
  const TempFolder folder;
  const auto refused = [&](std::string_view text) { return refusal(folder.write("a.opt", text)); };
  const std::string head = "n 1\ns d 0.1\n";
  const std::string species = "e d 0.1 d 0.1 0.1 d 0.1 0.1\n";
  EXPECT_EQ(refused(head + species), "accepted");
  EXPECT_TRUE(refused("").starts_with("a.opt: the number of species is missing ("));
  EXPECT_TRUE(refused("n 1\n" + species).starts_with("a.opt: the soil is missing ("));
  EXPECT_EQ(refused(head), "a.opt: 0 species (the line n says 1); correct that line, or add the missing species");
  EXPECT_TRUE(refused(head + species + species).starts_with("a.opt: 2 species ("));
  EXPECT_TRUE(refused("n 0\n").starts_with("a.opt:1: number of species '0' ("));
  EXPECT_TRUE(refused("n 10\n").starts_with("a.opt:1: number of species '10' ("));
  EXPECT_TRUE(refused("n 1.5\n").starts_with("a.opt:1: number of species '1.5' ("));
  EXPECT_TRUE(refused("n 1 2\n").starts_with("a.opt:1: '2' at the end of the line ("));
  EXPECT_TRUE(refused("n 1\nn 1\n").starts_with("a.opt:2: n is given twice ("));
  EXPECT_TRUE(refused(head + "s d 0.1\n").starts_with("a.opt:3: s is given twice ("));
  EXPECT_TRUE(refused("x 1\n").starts_with("a.opt:1: line begins with 'x' ("));
  EXPECT_EQ(refused("s r 0.1\n"),
            "a.opt:1: 'r' before soil reflectance (must be d: surfaces are Lambertian); write: s d REFLECTANCE");
  EXPECT_TRUE(refused("s d\n").starts_with("a.opt:1: soil reflectance is missing ("));
  EXPECT_TRUE(refused("s d 1.1\n").starts_with("a.opt:1: soil reflectance = 1.1 (must lie in 0..1)"));
  EXPECT_TRUE(refused("s d -0.1\n").starts_with("a.opt:1: soil reflectance = -0.1 ("));
  EXPECT_TRUE(refused("s d nan\n").starts_with("a.opt:1: soil reflectance = 'nan' ("));
  EXPECT_TRUE(refused(head + "e d 0.1 d 0.6 0.5 d 0 0\n").starts_with("a.opt:3: Rup + Tup = 1.1 (must be at most 1)"));
  EXPECT_TRUE(refused(head + "e d 0.1 d 0 0 d 0.6 0.5\n").starts_with("a.opt:3: Rdown + Tdown = 1.1 ("));
  EXPECT_TRUE(refused(head + "e d 0.1 d 0.1 0.1\n").starts_with("a.opt:3: '' before Rdown ("));
  EXPECT_TRUE(refused(head + "e d 0.1 d 0.1 d 0.1 0.1\n").starts_with("a.opt:3: Tup = 'd' ("));
  EXPECT_TRUE(refused(head + species.substr(0, species.size() - 1) + " 5\n").starts_with("a.opt:3: '5' at the end"));
  std::string many = "n 9\ns d 0\n";
  for (int i = 0; i < 10; ++i) many += species;
  EXPECT_TRUE(refused(many).starts_with("a.opt:12: too many species ("));
  EXPECT_TRUE(refusal(folder / "none.opt").starts_with("none.opt: cannot be read ("));
}

TEST(CaribuReader, Domain) {
  const TempFolder folder;
  for (const char* text : {" 0 -1\n 20 30.5\n", "0 -1 20 30.5", "# field\n0\n-1\n\n20 30.5 # m"}) {
    const CaribuDomain domain = read_domain(folder.write("a.8", text));
    EXPECT_EQ(domain.x_min, 0.0);
    EXPECT_EQ(domain.y_min, -1.0);
    EXPECT_EQ(domain.x_max, 20.0);
    EXPECT_EQ(domain.y_max, 30.5);
  }
}

TEST(CaribuReader, DomainsAreRefusedWithFileAndLine) {
  const TempFolder folder;
  const auto refused = [&](std::string_view text) { return refusal(folder.write("a.8", text)); };
  EXPECT_EQ(refused(""),
            "a.8: xmin is missing (a domain has four numbers); write: xmin ymin on one line, xmax ymax on the next");
  EXPECT_TRUE(refused("0 0\n1\n").starts_with("a.8: ymax is missing ("));
  EXPECT_TRUE(refused("0 0\n1 1\n2\n").starts_with("a.8:3: more than four numbers ("));
  EXPECT_TRUE(refused("0 0\n1 x\n").starts_with("a.8:2: ymax = 'x' ("));
  EXPECT_TRUE(refused("0 inf\n").starts_with("a.8:1: ymin = 'inf' ("));
  EXPECT_TRUE(refused("3 0\n3 1\n").starts_with("a.8: xmin = 3, xmax = 3 ("));
  EXPECT_TRUE(refused("0 2\n1 1\n").starts_with("a.8: ymin = 2, ymax = 1 ("));
  EXPECT_TRUE(refusal(folder / "none.8").starts_with("none.8: cannot be read ("));
}

}  // namespace
}  // namespace sunfleck
