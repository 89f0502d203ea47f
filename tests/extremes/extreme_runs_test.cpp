// Tests that whole runs over scenes with many extremes at once give the same numbers on the CPU path and on the device.
#include "extremes/tracers.h"
#include "support/leaf_scenes.h"

#include <fmt/format.h>

namespace sunfleck::test {
namespace {

class ExtremeRuns : public EveryTracer {};

// Returns needles, leaves without area, the same leaf twice, leaves that overlap in one plane, and one larger than the plot.
Mesh odd_leaves(double size_m) {
  MeshMaker maker;
  const auto at = [&](double x, double y, double z) { return glm::dvec3(x, y, z) * size_m; };
  maker.triangle(at(0.1, 0.2, 0.1), at(0.9, 0.8, 0.9), at(0.9, 0.8, 0.9001));
  maker.triangle(at(0.2, 0.7, 0.1), at(0.2, 0.7, 0.9), at(0.2000001, 0.7, 0.1));
  maker.triangle(at(0.5, 0.9, 0.5), at(0.5, 0.9, 0.5), at(0.5, 0.9, 0.5));
  maker.triangle(at(0.2, 0.1, 0.3), at(0.2, 0.9, 0.3), at(0.2, 0.5, 0.3));
  for (int copy = 0; copy < 2; ++copy) maker.triangle(at(0.3, 0.4, 0.3), at(0.3, 0.4, 0.7), at(0.7, 0.4, 0.3));
  maker.triangle(at(0.4, 0.4, 0.4), at(0.4, 0.4, 0.8), at(0.8, 0.4, 0.4));
  maker.triangle(at(0.6, 0.0, 0.6), at(0.6, 0.0, 0.9), at(0.9, 0.0, 0.6));
  maker.triangle(at(-1.3, 0.3, -0.4), at(2.1, 0.35, 0.3), at(0.2, 0.3, 2.7));
  return maker.mesh();
}

ScatterWork little() {
  return {.rays = 4000, .packets = 300, .replicates = 8, .bound = 0.01};
}

TEST_F(ExtremeRuns, UnderSunsOnEveryAxisAndAtEveryHeight) {
  for (const double elevation : {90.0, 89.9999, 1.0, 0.1}) {
    for (const double azimuth : {0.0, 90.0, 180.0, 270.0, 45.0}) {
      SCOPED_TRACE(fmt::format("elevation {}, azimuth {}", elevation, azimuth));
      for (const bool periodic : {true, false}) {
        const RadiationModel model = paper_model(odd_leaves(1.0), {1.0, 1.0, periodic}, sun_at(elevation, azimuth));
        run(model, fixed_scatter(model, little()));
      }
    }
  }
}

TEST_F(ExtremeRuns, OfEverySize) {
  for (const double size_m : {1e-6, 0.01, 1000.0, 1e4}) {
    SCOPED_TRACE(size_m);
    RadiationModel model = paper_model(odd_leaves(size_m), {size_m, size_m, true}, sun_at(5.0, 77.0));
    model.soil->patch_m = 0.03 * size_m;
    model.sky = SkyModel{.kind = SkyKind::uniform};
    for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.5;
    run(model, fixed_scatter(model, little()));
  }
}

TEST_F(ExtremeRuns, FarFromZero) {
  for (const glm::dvec3& far_m : {glm::dvec3(1000, 0, 0), glm::dvec3(-1000, 1000, 700), glm::dvec3(1e6, 0, 1e6)}) {
    for (const bool periodic : {true, false}) {
      Mesh mesh = odd_leaves(1.0);
      for (glm::dvec3& vertex : mesh.vertices) vertex += far_m;
      RadiationModel model = paper_model(mesh, {1.0, 1.0, periodic}, sun_at(40.0, 77.0));
      run(model, fixed_scatter(model, little()));
    }
  }
}

TEST_F(ExtremeRuns, OfOneTriangleAndOfNone) {
  MeshMaker one;
  one.triangle({0.2, 0.5, 0.2}, {0.2, 0.5, 0.8}, {0.8, 0.7, 0.2});
  for (const Mesh& mesh : {one.mesh(), Mesh()}) {
    for (const bool periodic : {true, false}) {
      RadiationModel model = paper_model(mesh, {1.0, 1.0, periodic}, sun_at(0.1, 90.0));
      model.soil->reflectance = {1.0, 0.2};
      const RadiationResult result = run(model, fixed_scatter(model, little()));
      EXPECT_EQ(result.bands[0].ledger.absorbed_soil, 0);
      model.soil.reset();
      run(model, fixed_scatter(model, little()));
    }
  }
}

}  // namespace
}  // namespace sunfleck::test
