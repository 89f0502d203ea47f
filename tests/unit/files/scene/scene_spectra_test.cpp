// Tests wavebands by wavelength, and optics from spectra.
#include "files/scene/scene_reader.h"
#include "support/scene_text.h"

#include <gtest/gtest.h>

#include <string>

namespace sunfleck {
namespace {

constexpr double rounding = 1e-12;

class SceneSpectra : public SceneFolder {
 protected:
  void SetUp() override {
    write(folder_ / "leaf.csv", "wavelength_nm,reflectance,transmittance\n400,0.1,0.0\n600,0.1,0.2\n800,0.5,0.4\n");
    write(folder_ / "sun.csv", "400 1\n500 1\n500.001 3\n800 3\n");
  }

  // Returns the scene whose text, after the plot and the sun, is this.
  [[nodiscard]] Scene with(const std::string& head, const std::string& rest) const {
    return read(head + "[plot]\nsize = [1, 1]\n[sun]\nelevation = 90\nazimuth = 0\n" + rest);
  }
  [[nodiscard]] std::string refusal(const std::string& head, const std::string& rest) const {
    std::string message = refusal_of([&] { static_cast<void>(with(head, rest)); });
    expect_three_parts(message);
    return message;
  }
};

const std::string red_and_nir =
    "[[band]]\nname = \"red\"\nrange_nm = [500, 600]\ndirect = 1\n[[band]]\nname = \"NIR\"\nrange_nm = [600, 800]\ndirect = "
    "1\n";
const std::string soil_of_leaf = "[soil]\nspectrum = \"leaf.csv\"\n";

TEST_F(SceneSpectra, AreAveragedOverEachBand) {
  const Scene scene = with("", red_and_nir + soil_of_leaf);
  ASSERT_TRUE(scene.model.soil);
  EXPECT_NEAR(scene.model.soil->reflectance[0], 0.1, rounding);
  EXPECT_NEAR(scene.model.soil->reflectance[1], 0.3, rounding);
  EXPECT_EQ(scene.model.bands[1].weighted_by, "equal energy");
  EXPECT_EQ(scene.model.bands[1].from_nm, 600.0);
}

TEST_F(SceneSpectra, AreWeightedByTheLightSpectrum) {
  write(folder_ / "rising.csv", "600 0\n800 2\n");
  const Scene scene =
      with("light_spectrum = \"rising.csv\"\n", "[[band]]\nname = \"NIR\"\nrange_nm = [600, 800]\ndirect = 1\n" + soil_of_leaf);
  EXPECT_NEAR(scene.model.soil->reflectance[0], 0.1 + 0.4 * 2.0 / 3.0, rounding);
  EXPECT_EQ(scene.model.bands[0].weighted_by, "rising.csv");
  EXPECT_EQ(scene.files.size(), 5U) << "the scene, and each file by the name that leads to it and as it was read";
}

TEST_F(SceneSpectra, SetBothFacesOrEach) {
  write(folder_ / "tile.obj", "v 0 1 0\nv 0 1 1\nv 1 1 0\nusemtl leaf\nf 1 2 3\n");
  const std::string tile = "[[geometry]]\nfile = \"tile.obj\"\n";
  const Scene both = with("", red_and_nir + "[optics.leaf]\nspectrum = \"leaf.csv\"\n" + tile);
  EXPECT_NEAR(both.model.optics[0].upper[1].transmittance, 0.3, rounding);
  EXPECT_NEAR(both.model.optics[0].lower[1].transmittance, 0.3, rounding);
  const Scene one =
      with("", red_and_nir + "[optics.leaf.upper]\nspectrum = \"leaf.csv\"\n[optics.leaf.lower]\nreflectance = 0.2\n" + tile);
  EXPECT_NEAR(one.model.optics[0].upper[0].transmittance, 0.15, rounding);
  EXPECT_EQ(one.model.optics[0].lower[0].transmittance, 0.0);
}

TEST_F(SceneSpectra, ShareTheLightOfEqualBands) {
  const Scene scene = with("light_spectrum = \"sun.csv\"\nbands = { from = 400, to = 600, step = 50, direct = 400 }\n", "");
  ASSERT_EQ(scene.model.bands.size(), 4U);
  EXPECT_EQ(scene.model.bands[0].name, "400_450");
  EXPECT_EQ(scene.model.bands[3].name, "550_600");
  EXPECT_NEAR(scene.model.bands[0].direct_w_m2, 50.0, 1e-2);
  EXPECT_NEAR(scene.model.bands[3].direct_w_m2, 150.0, 1e-2);
  double sum = 0.0;
  for (const Waveband& band : scene.model.bands) sum += band.direct_w_m2;
  EXPECT_NEAR(sum, 400.0, 1e-9);
}

TEST_F(SceneSpectra, GivePhotonsPerEnergy) {
  const Scene scene = with("", "[[band]]\nname = \"PAR\"\nrange_nm = [400, 700]\ndirect = 1\numol_per_joule = \"spectrum\"\n");
  EXPECT_NEAR(scene.model.bands[0].umol_per_joule, 4.598, 1e-3);
}

TEST_F(SceneSpectra, OutsideTheirRangeAreRefused) {
  const std::string wide = "[[band]]\nname = \"all\"\nrange_nm = [400, 2500]\ndirect = 1\n";
  EXPECT_NE(refusal("", wide + soil_of_leaf)
                .find("soil.spectrum = \"leaf.csv\" (band all is 400 to 2500 nm, but the file has 400 "
                      "to 800 nm)"),
            std::string::npos);
  EXPECT_NE(refusal("", "[[band]]\nname = \"PAR\"\ndirect = 1\n" + soil_of_leaf).find("band PAR has no wavelengths"),
            std::string::npos);
  EXPECT_NE(refusal("light_spectrum = \"sun.csv\"\nbands = { from = 300, to = 600, step = 50, direct = 1 }\n", "")
                .find("reach beyond light_spectrum"),
            std::string::npos);
  EXPECT_NE(refusal("bands = { from = 700, to = 400, step = 10, direct = 1 }\n", "")
                .find("bands.to = 400 (it must be above `from`, 700)"),
            std::string::npos);
  EXPECT_NE(refusal("bands = { start = 400, to = 700, step = 10 }\n", "").find("use from"), std::string::npos);
  EXPECT_NE(refusal("bands = { from = 0.4, to = 700, step = 10 }\n", "").find("give nm, such as 400"), std::string::npos);
  EXPECT_NE(refusal("bands = { from = 400, to = 800, step = 30, direct = 1 }\n", "").find("gives 13.3333 bands"),
            std::string::npos);
  EXPECT_NE(refusal("", "[[band]]\nname = \"a\"\nrange_nm = [700, 400]\ndirect = 1\n").find("it must ascend"),
            std::string::npos);
  EXPECT_NE(refusal("", red_and_nir + "[soil]\nspectrum = \"leaf.csv\"\nreflectance = 0.1\n").find("spectrum is also given"),
            std::string::npos);
}

}  // namespace
}  // namespace sunfleck
