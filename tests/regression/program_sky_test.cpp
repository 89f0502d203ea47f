// Tests the sky through the program itself: an upright black square over black soil, alone, receives what the tables of the sky
// models state (E1 to E4 of the validation table).
#include "regression/program.h"
#include "support/table.h"

#include <array>

namespace sunfleck::regression {
namespace {

class ProgramSky : public ProgramTest {
 protected:
  static constexpr double bound = 0.002;

  void SetUp() override {
    folder_.write("north.obj", "v 0.05 0.03 0\nv 0.05 0.03 0.1\nv 0.05 0.13 0.1\nv 0.05 0.13 0\nf 1 2 3\nf 1 3 4\n");
    folder_.write("east.obj", "v 0.1 0.03 0.05\nv 0 0.03 0.05\nv 0 0.13 0.05\nv 0.1 0.13 0.05\nf 1 2 3\nf 1 3 4\n");
  }

  // Returns the sky irradiance on both faces relative to the horizontal: first on the face after which the square is named,
  // then on the face behind.
  [[nodiscard]] std::array<double, 2> faces(const std::string& square, const std::string& sky) const {
    folder_.write("scene.toml",
                  "[plot]\nsize = [0.1, 0.1]\nperiodic = false\n[sun]\nelevation = 53.0176\nazimuth = 120.569\n"
                  "[[band]]\nname = \"PAR\"\ndiffuse = 100.0\n[soil]\nreflectance = 0\n[optics.leaf]\n"
                  "reflectance = 0\n[sky]\n" +
                      sky + "\n[[geometry]]\nfile = \"" + square + "\"\noptics = \"leaf\"\n");
    simulate("scene.toml", {"--device", "cpu", "--error", std::to_string(bound), "--export", "csv", "--images", "none"});
    const Table triangles(file("triangles.csv"));
    EXPECT_EQ(triangles.size(), 2U);
    std::array<double, 2> sum{};
    double area_m2 = 0.0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const double own_m2 = triangles.number(t, "area_m2");
      area_m2 += own_m2;
      sum[0] += own_m2 * triangles.number(t, "PAR_sky_upper");
      sum[1] += own_m2 * triangles.number(t, "PAR_sky_lower");
      EXPECT_EQ(triangles.number(t, "PAR_direct_upper"), 0.0);
      EXPECT_EQ(triangles.number(t, "PAR_sky_upper"), triangles.number(t, "PAR_indirect_upper")) << "black soil";
    }
    EXPECT_EQ(summary()["bands"][0]["residual"], 0);
    return {sum[0] / area_m2 / 100.0, sum[1] / area_m2 / 100.0};
  }
};

TEST_F(ProgramSky, AnUprightSquareSeesTheTables) {
  struct Row {
    const char* sky;
    std::array<double, 4> toward;  // north, east, south, west
  };
  const std::array rows = {Row{"model = \"cie-overcast\"", {0.396177, 0.396177, 0.396177, 0.396177}},
                           Row{"model = \"cie\"\ntype = 7", {0.31939, 0.56812, 0.48199, 0.29284}},
                           Row{"model = \"perez\"\ndni = 850\ndhi = 100", {0.43355, 0.80890, 0.66418, 0.41844}}};
  for (const Row& row : rows) {
    const std::array north_south = faces("north.obj", row.sky);
    const std::array east_west = faces("east.obj", row.sky);
    const std::array got = {north_south[0], east_west[0], north_south[1], east_west[1]};
    for (std::size_t k = 0; k < got.size(); ++k) {
      // The bound holds for both faces together; the relative error of one face may be half as large again.
      std::printf("%-32.32s face %zu expected %.5f got %.5f\n", row.sky, k, row.toward[k], got[k]);
      EXPECT_NEAR(got[k], row.toward[k], (0.003 + 1.5 * bound) * row.toward[k]) << row.sky << " face " << k;
    }
  }
}

}  // namespace
}  // namespace sunfleck::regression
