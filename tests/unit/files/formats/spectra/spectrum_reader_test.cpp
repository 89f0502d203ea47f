// Tests the forms in which spectra come, and the messages about those that cannot be read.
#include "files/formats/spectra/spectrum_reader.h"

#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace sunfleck::test {
namespace {

class SpectrumFile : public ::testing::Test {
 protected:
  [[nodiscard]] SurfaceSpectra surface(const std::string& text) const { return read_surface_spectra(file(text)); }
  [[nodiscard]] Spectrum light(const std::string& text) const { return read_light_spectrum(file(text)); }

  // Checks that a table is read as 400 and 500 nm, reflectance 0.1 and 0.2, transmittance 0.05 and 0.1.
  void expect_leaf(const std::string& text) const {
    SCOPED_TRACE(text);
    const SurfaceSpectra leaf = surface(text);
    expect_values(leaf.reflectance, 0.1, 0.2);
    ASSERT_TRUE(leaf.transmittance);
    expect_values(*leaf.transmittance, 0.05, 0.1);
  }
  static void expect_values(const Spectrum& spectrum, double first, double second) {
    ASSERT_EQ(spectrum.values.size(), 2U);
    EXPECT_NEAR(spectrum.wavelength_nm[0], 400.0, 1e-9);
    EXPECT_NEAR(spectrum.wavelength_nm[1], 500.0, 1e-9);
    EXPECT_NEAR(spectrum.values[0], first, 1e-12);
    EXPECT_NEAR(spectrum.values[1], second, 1e-12);
  }

  // Returns the message about a surface's table without the folder's path.
  [[nodiscard]] std::string refusal(const std::string& text) const {
    const std::string message = refusal_of([&] { static_cast<void>(surface(text)); });
    expect_three_parts(message);
    return message.substr(message.find("leaf.csv"));
  }

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& text) const { return folder_.write("leaf.csv", text); }

  TempFolder folder_;
};

TEST_F(SpectrumFile, MaySeparateItsColumnsInAnyUsualWay) {
  expect_leaf("wavelength_nm,reflectance,transmittance\n400,0.1,0.05\n500,0.2,0.1\n");
  expect_leaf("wavelength;reflectance;transmittance\r\n400;0,1;0,05\r\n500;0,2;0,1\r\n");
  expect_leaf("Wavelength (nm)\tReflectance\tTransmittance\n400\t0.1\t0.05\n500\t0.2\t0.1\n");
  expect_leaf("400 0.1 0.05\n500 0.2 0.1\n");
  expect_leaf("  400,0  0,1  0,05\n  500,0  0,2  0,1\n");
  expect_leaf("\xef\xbb\xbf\"wl\",\"r\",\"t\"\n\"400\",\"0.1\",\"0.05\",\n\"500\",\"0.2\",\"0.1\",\n");
}

TEST_F(SpectrumFile, MayHaveRemarksAndAPreamble) {
  expect_leaf("# PROSPECT, N = 1.5\n# wavelength reflectance transmittance\n400 0.1 0.05\n# a remark\n\n500 0.2 0.1\n");
  expect_leaf("Name: a leaf\nOrigin: 12,5 m; a library\nX Units: nm\n\n400\t0.1\t0.05\n500\t0.2\t0.1\n");
  expect_leaf("# measured at 45 percent relative humidity, 200 micrometers thick\n400 0.1 0.05\n500 0.2 0.1\n");
  expect_leaf("lambda,tau,rho\n400,0.05,0.1\n500,0.1,0.2\n");
  expect_leaf("id,nm,refl. mean,trans. mean\n1,400,0.1,0.05\n1,500,0.2,0.1\n");
}

TEST_F(SpectrumFile, MayDescendAndUseOtherUnits) {
  expect_leaf("500 0.2 0.1\n400 0.1 0.05\n");
  expect_leaf("wavelength_um,reflectance,transmittance\n0.4,0.1,0.05\n0.5,0.2,0.1\n");
  expect_leaf("0.4 0.1 0.05\n0.5 0.2 0.1\n");
  expect_leaf("wavelength,reflectance (%),transmittance [%]\n400,10,5\n500,20,10\n");
  expect_leaf("X Units: Wavelength (micrometers)\nY Units: Reflectance (percent)\n0.4\t10\t5\n0.5\t20\t10\n");
}

TEST_F(SpectrumFile, OfASoilNeedsNoTransmittance) {
  const SurfaceSpectra soil = surface("wavelength,reflectance\n400,0.1\n500,0.2\n");
  expect_values(soil.reflectance, 0.1, 0.2);
  EXPECT_FALSE(soil.transmittance);
}

TEST_F(SpectrumFile, OfLightHoldsAnyUnit) {
  expect_values(light("400 1200\n500 1600.5\n"), 1200.0, 1600.5);
  expect_values(light("Wavelength nm,Etr W*m-2*nm-1,Global tilt  W*m-2*nm-1,Direct\n400,1,2,3\n500,4,5,6\n"), 2.0, 5.0);
  expect_values(light("photons?;wavelength\n7;400\n8;500\n"), 7.0, 8.0);
}

TEST_F(SpectrumFile, IsRefusedWithItsPlaceAndACure) {
  EXPECT_EQ(refusal(""),
            "leaf.csv: 0 rows of numbers (a spectrum needs at least two, in columns); give columns such as "
            "wavelength_nm,reflectance,transmittance");
  EXPECT_EQ(
      refusal("400,10\n500,20\n"),
      "leaf.csv:1: reflectance 10 (it must be a share from 0 to 1); name the column reflectance (%) if these are percent");
  EXPECT_NE(refusal("400,0.1\n500,x\n").find("leaf.csv:2: 'x' (not a finite number)"), std::string::npos);
  EXPECT_NE(refusal("400,0.1\n500,0.1,0.1\n").find("leaf.csv:2: 3 cells (the rows before have 2)"), std::string::npos);
  EXPECT_NE(refusal("400,0.1\n500,0.1\n500,0.2\n").find("leaf.csv:3: wavelength 500 nm"), std::string::npos);
  EXPECT_NE(refusal("400,0.1\n600,0.1\n500,0.2\n600,0.3\n").find("leaf.csv:3: wavelength 500 nm"), std::string::npos);
  EXPECT_NE(refusal("400,0.6,0.3\n500,0.6,0.5\n").find("leaf.csv:2: reflectance + transmittance = 1.1"), std::string::npos);
  EXPECT_NE(refusal("wavelength,green\n400,0.1\n500,0.1\n").find("leaf.csv:1: columns wavelength, green"), std::string::npos);
  EXPECT_NE(refusal("400,0.1,0.1,0.1\n500,0.1,0.1,0.1\n").find("4 columns without names"), std::string::npos);
  EXPECT_NE(refusal("400,-0.1\n500,0.1\n").find("reflectance -0.1"), std::string::npos);
  EXPECT_NE(refusal_of([&] { static_cast<void>(light("400 1\n500 -1\n")); }).find("light -1"), std::string::npos);
}

TEST_F(SpectrumFile, SurvivesBeingCut) {
  const std::string text = "wavelength_nm;reflectance;transmittance\n400;0,1;0,05\n500;0,2;0,1\n";
  int refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto message = message_of([&] { static_cast<void>(surface(text.substr(0, length))); });
    if (!message) continue;
    ++refused;
    expect_three_parts(*message);
  }
  EXPECT_GE(refused, 50) << "all cuts before the second row end, but few within its last cell";
}

}  // namespace
}  // namespace sunfleck::test
