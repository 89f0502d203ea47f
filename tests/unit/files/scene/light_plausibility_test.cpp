// Tests the warnings about light, receivers and plots that are unlikely.

#include "files/scene/light_plausibility.h"

#include "files/scene/scene_reader.h"
#include "support/scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace sunfleck {
namespace {

const std::string lit_stand =
    "[plot]\nsize = [2, 3]\nperiodic = false\n[optics.leaf]\nreflectance = 0.1\n[[geometry]]\nfile = \"plates.obj\"\n"
    "optics = \"leaf\"\n";

class LightPlausibility : public SceneFolder {
 protected:
  // Expects one warning, with the place of a key and the words.
  void expect_warned(const std::string& text, const std::string& key, const std::string& words) const {
    SCOPED_TRACE(text);
    const Scene scene = read(text);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("scene.toml:"), std::string::npos);
    EXPECT_NE(scene.warnings[0].find(": " + key + ": "), std::string::npos) << scene.warnings[0];
    EXPECT_NE(scene.warnings[0].find(words), std::string::npos) << scene.warnings[0];
  }

  void expect_silent(const std::string& text) const {
    SCOPED_TRACE(text);
    const Scene scene = read(text);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  }
};

std::string sun(const std::string& elevation, const std::string& azimuth = "180") {
  return fmt::format("[sun]\nelevation = {}\nazimuth = {}\n", elevation, azimuth);
}

std::string band(const std::string& light) {
  return "[[band]]\nname = \"PAR\"\n" + light + "\n";
}

TEST_F(LightPlausibility, BeamsAreWeakerThanOutsideTheAtmosphere) {
  // 1361 sin(10 degrees) = 236.3.
  expect_warned(lit_stand + sun("10") + band("direct = 350"), "band.direct", "give at most 236.3");
  expect_silent(lit_stand + sun("10") + band("direct = 236"));
  expect_warned(lit_stand + sun("90") + band("direct_normal = 1380"), "band.direct_normal", "give at most 1361");
  expect_silent(lit_stand + sun("90") + band("direct_normal = 1360"));
  // On 3 January the sun is nearer: 1361 * 1.033 = 1405.8.
  expect_silent(lit_stand + "[sun]\ntime = 2002-01-03T12:00:00Z\nlatitude = -22\nlongitude = 0\n" +
                band("direct_normal = 1390"));
}

// Outside the atmosphere the sun sends 519 W m-2 of PAR (Thekaekara 1973, scaled to 1361 W m-2), so a bound must be above that.
TEST_F(LightPlausibility, BandsHaveTheirShareOfTheSolarConstant) {
  EXPECT_GT(most_solar_share({400.0, 700.0}) * 1361.0, 525.0);
  EXPECT_LT(most_solar_share({400.0, 700.0}) * 1361.0, 640.0);
  EXPECT_GT(most_solar_share({450.0, 460.0}) * 1361.0, 20.8);  // the brightest of the spectrum
  EXPECT_GT(most_solar_share({1600.0, 1700.0}) * 1361.0, 23.4);
  EXPECT_EQ(most_solar_share({100.0, 50000.0}), 1.0);
  const std::string par = "\nrange_nm = [400, 700]", nir = "\nrange_nm = [700, 2500]";
  expect_warned(lit_stand + sun("90") + band("direct = 700" + par), "band.direct", "outside the atmosphere from 400 to 700 nm");
  expect_warned(lit_stand + sun("90") + band("direct_normal = 700" + par), "band.direct_normal",
                "or add unit = \"umol_m2_s\" if umol m-2 s-1 are meant");
  expect_silent(lit_stand + sun("90") + band("direct = 520" + par));
  expect_silent(lit_stand + sun("90") + band("direct = 1000"));
  expect_silent(lit_stand + sun("90") + band("direct = 2000\nunit = \"umol_m2_s\"" + par));
  expect_warned(lit_stand + sun("90") + band("direct = 900" + nir), "band.direct", "from 700 to 2500 nm");
  expect_silent(lit_stand + sun("90") + band("direct = 700" + nir));
}

TEST_F(LightPlausibility, EqualBandsAreJudgedTogether) {
  const auto equal = [](const std::string& light) {
    return "bands = { from = 400, to = 700, step = 100, " + light + " }\n" + lit_stand;
  };
  expect_warned(equal("direct = 700") + sun("90"), "bands.direct", "from 400 to 700 nm");
  expect_warned(equal("direct = 2000") + sun("90"), "bands.direct", "are meant, give 437.6 W m-2");
  expect_silent(equal("direct = 500") + sun("90"));
}

TEST_F(LightPlausibility, PhotonsAreNoWatts) {
  expect_warned(lit_stand + sun("60") + band("direct = 1600"), "band.direct",
                "unit = \"umol_m2_s\", which makes it 350.1 W m-2");
  expect_warned(lit_stand + "[sky]\nmodel = \"uniform\"\n" + band("diffuse = 1500"), "band.diffuse", "328.2 W m-2");
  const Scene scene = read(lit_stand + sun("60") + band("direct = 1600\nunit = \"umol_m2_s\""));
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_DOUBLE_EQ(scene.model.bands[0].direct_w_m2, 1600.0 / 4.57);
  EXPECT_EQ(scene.model.bands[0].umol_per_joule, 4.57);
  const Scene given = read(lit_stand + sun("60") + band("direct = 100\nunit = \"umol_m2_s\"\numol_per_joule = 5"));
  EXPECT_EQ(given.model.bands[0].direct_w_m2, 20.0);
  EXPECT_EQ(read(lit_stand + sun("60") + band("direct = 100\nunit = \"W_m2\"")).model.bands[0].umol_per_joule, 0.0);
}

TEST_F(LightPlausibility, AnglesAreDegreesFromNorth) {
  expect_warned(lit_stand + sun("0.7854") + band("direct = 1"), "sun.elevation", "radians would be 45.0001 degrees");
  expect_silent(lit_stand + sun("0.75") + band("direct = 1"));
  expect_silent(lit_stand + sun("1.6001") + band("direct = 1"));
  expect_warned(lit_stand + sun("30", "-60") + band("direct = 1"), "sun.azimuth",
                "give 300, or 120 if it was measured from south");
  expect_silent(lit_stand + sun("30", "0") + band("direct = 1"));
}

TEST_F(LightPlausibility, TheSunIsHighestAboutNoonByTheClock) {
  const auto at = [](const char* offset, const char* longitude) {
    return lit_stand + "[sun]\ntime = 2023-07-10T12:00:00" + offset + "\nlatitude = 40\nlongitude = " + longitude + "\n" +
           band("direct = 1");
  };
  const auto expect_said = [&](const std::string& text, const char* words) {
    const std::vector<std::string> warnings = read(text).warnings;  // the sun is low or below the horizon there
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
      return warning.find("sun.longitude: at ") != warning.npos && warning.find(words) != warning.npos;
    })) << fmt::format("{}", fmt::join(warnings, "; "));
  };
  expect_said(at("-05:00", "88.2"), "the sun is highest at about 01:07");
  expect_said(at("-05:00", "88.2"), "if it is west, give -88.2");
  expect_said(at("+08:00", "10"), "correct the longitude or the offset of the time");
  expect_silent(at("-05:00", "-88.2"));
  expect_silent(at("-05:00", "271.8"));
  expect_silent(at("+08:00", "76"));      // Kashgar
  expect_silent(at("+13:00", "-171.8"));  // Samoa
  expect_silent(at("Z", "-105"));
}

TEST_F(LightPlausibility, SharesAreOfOneWhole) {
  const std::string clear = lit_stand +
                            "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40\nlongitude = 116.28\n[sky]\nmodel = "
                            "\"uniform\"\n[weather]\nclear_sky = \"ineichen\"\n";
  const auto bands = [](const std::string& shares) {
    std::string text;
    for (const char* name : {"A", "B", "C"}) text += std::string("[[band]]\nname = \"") + name + "\"\n" + shares;
    return text;
  };
  expect_warned(clear + bands(""), "band.share", "add up to 1.5 of the broadband irradiance");
  expect_silent(clear + bands("share = 0.3333333\n"));
}

TEST_F(LightPlausibility, LeavesDoNotShine) {
  const std::string lit = "[optics.leaf]\nreflectance = 0.1\nemission = 5\n";
  const std::string shining = replaced(lit_stand, "[optics.leaf]\nreflectance = 0.1\n", lit) + sun("60") + band("direct = 1");
  expect_warned(shining, "optics.leaf.emission", "role = \"lamp\"");
  expect_silent(replaced(shining, "emission = 5", "emission = 5\nrole = \"lamp\""));
  expect_silent(replaced(shining, "emission = 5", "emission = 0"));
}

TEST_F(LightPlausibility, ReceiversBelongToTheStand) {
  const std::string lit = lit_stand + sun("60") + band("direct = 1");
  expect_warned(lit + "[[plane]]\nheight = 2.5\n", "plane.height", "lies above the stand");
  expect_silent(lit + "[[plane]]\nheight = 1.5\n");
  const std::string sensor = "[[sensor]]\nname = \"s\"\nfrom = [2.5, 0.5, 1]\n";
  expect_warned(lit + sensor, "sensor.from", "give X in 0..2 and Z in 0..3");
  const std::string inside = replaced(sensor, "2.5, 0.5", "1.5, 0.5");
  expect_silent(lit + inside);
  const std::string on_soil = lit + "[soil]\nreflectance = 0.1\n";
  expect_silent(on_soil + replaced(inside, "1.5, 0.5", "1.5, 0"));
  expect_warned(on_soil + replaced(inside, "1.5, 0.5", "1.5, -0.5"), "sensor.from", "Y = -0.5 m lies below the ground");
  expect_warned(on_soil + inside + "to = [1.5, -0.25, 1]\npoints = 3\n", "sensor.to", "Y = -0.25 m lies below the ground");
  expect_silent(lit + replaced(inside, "1.5, 0.5", "1.5, -0.5"));
  const std::string repeated = replaced(lit, "periodic = false", "periodic = true");
  expect_silent(repeated + sensor);
  expect_warned(repeated + replaced(sensor, "2.5, 0.5", "4.5, 0.5"), "sensor.from", "the periods next to it");
}

TEST_F(LightPlausibility, PlotsAreInMetres) {
  const std::string lit = lit_stand + sun("60") + band("direct = 1") + "";
  const std::string wide =
      replaced(replaced(lit, "[2, 3]", "[180, 240]"), "optics = \"leaf\"", "optics = \"leaf\"\nat = [[9, 0, 9]]");
  expect_warned(wide, "plot.size", "if centimetres were meant, give [1.8, 2.4]");
  expect_silent(replaced(wide, "[180, 240]", "[29, 240]"));
}

}  // namespace
}  // namespace sunfleck
