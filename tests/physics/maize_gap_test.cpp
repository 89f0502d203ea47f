// Counts the light gaps of the maize stands with a rasteriser that shares no code with the tracers.

#include "physics/canopy/maize_plant.h"
#include "support/maize_stands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

using std::numbers::pi;

// Returns the share of the ground of the endless stand that a beam from `to_sun` reaches: projects the mesh along the beam onto
// a grid of points that wraps at the plot's edges.
double gap_fraction(const Mesh& mesh, const glm::dvec2& size_m, const glm::dvec3& to_sun) {
  constexpr double spacing_m = 0.005;
  const int columns = static_cast<int>(std::lround(size_m.x / spacing_m));
  const int rows = static_cast<int>(std::lround(size_m.y / spacing_m));
  const auto wrap = [](int i, int n) { return (i % n + n) % n; };
  std::vector<char> shaded(static_cast<std::size_t>(columns) * rows, 0);
  for (const glm::uvec3& corners : mesh.triangles) {
    std::array<glm::dvec2, 3> p;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& v = mesh.vertices[corners[k]];
      p[k] = glm::dvec2(v.x - v.y * to_sun.x / to_sun.y, v.z - v.y * to_sun.z / to_sun.y) / size_m * glm::dvec2(columns, rows);
    }
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const double sense = cross(p[1] - p[0], p[2] - p[0]) > 0.0 ? 1.0 : -1.0;
    const auto lo = glm::ceil(glm::min(p[0], glm::min(p[1], p[2])));
    const auto hi = glm::max(p[0], glm::max(p[1], p[2]));
    for (double x = lo.x; x <= hi.x; ++x) {
      for (double y = lo.y; y <= hi.y; ++y) {
        const glm::dvec2 point(x, y);
        bool inside = true;
        for (int k = 0; k < 3; ++k) inside = inside && sense * cross(p[(k + 1) % 3] - p[k], point - p[k]) >= 0.0;
        if (inside) shaded[wrap(static_cast<int>(y), rows) * columns + wrap(static_cast<int>(x), columns)] = 1;
      }
    }
  }
  return static_cast<double>(std::count(shaded.begin(), shaded.end(), 0)) / static_cast<double>(shaded.size());
}

struct GapAtZenith {
  double gap_fraction;  // mean over azimuths
  double path;          // G L / cos(zenith) for randomly placed leaves with the same orientations
};

GapAtZenith gap_at_zenith(const Mesh& mesh, const glm::dvec2& size_m, double zenith_rad) {
  const int azimuths = zenith_rad == 0.0 ? 1 : 8;
  GapAtZenith mean{0.0, 0.0};
  for (int i = 0; i < azimuths; ++i) {
    const double azimuth_rad = 2.0 * pi * (i + 0.5) / azimuths;
    const glm::dvec3 to_sun(std::sin(zenith_rad) * std::cos(azimuth_rad), std::cos(zenith_rad),
                            std::sin(zenith_rad) * std::sin(azimuth_rad));
    double projected_m2 = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) projected_m2 += std::abs(glm::dot(area_vector(mesh, t), to_sun));
    mean.gap_fraction += gap_fraction(mesh, size_m, to_sun) / azimuths;
    mean.path += projected_m2 / (size_m.x * size_m.y * to_sun.y) / azimuths;
  }
  return mean;
}

// Fits -ln P0 = clumping * G L / cos(zenith) by least squares through the origin, for zenith angles 0 to 60 degrees.
double clumping_index(const MaizeStand& stand) {
  const Mesh leaves = leaves_of(make_maize(stand));
  double sum_xy = 0.0;
  double sum_xx = 0.0;
  for (int zenith_deg = 0; zenith_deg <= 60; zenith_deg += 10) {
    const GapAtZenith gap = gap_at_zenith(leaves, plot_size_m(stand), zenith_deg * degree);
    sum_xy += -std::log(gap.gap_fraction) * gap.path;
    sum_xx += gap.path * gap.path;
  }
  return sum_xy / sum_xx;
}

TEST(MaizeGaps, GapFractionOfAPlateIsExact) {
  // A plate of 0.4 x 0.3 m, 0.8 m above a plot of 1 x 1 m: no sun can lengthen the shadow of a level plate.
  Mesh plate;
  plate.vertices = {{0.3, 0.8, 0.35}, {0.7, 0.8, 0.35}, {0.7, 0.8, 0.65}, {0.3, 0.8, 0.65}};
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  const double one_line_of_points = 0.005 * (0.4 + 0.3);
  EXPECT_NEAR(gap_fraction(plate, {1.0, 1.0}, glm::normalize(glm::dvec3(1.3, 1.0, -0.7))), 0.88, one_line_of_points);
}

TEST(MaizeGaps, LeavesAreClumpedOnPlants) {
  for (const MaizeStand& stand : {sparse_stand(1), dense_stand(1)}) {
    const double clumping = clumping_index(stand);
    RecordProperty(stand.per_row == 3 ? "sparse" : "dense", std::to_string(clumping));
    EXPECT_GE(clumping, 0.65);
    EXPECT_LE(clumping, 0.95);
  }
}

TEST(MaizeGaps, HalfTheResolutionGivesTheSameGapFraction) {
  MaizeDetail coarse;
  coarse.blade_step_m *= 2.0;
  coarse.strips_per_half /= 2;
  coarse.tube_sides /= 2;
  const MaizeStand stand = sparse_stand(1);
  const Mesh fine_mesh = make_maize(stand);
  const Mesh coarse_mesh = make_maize(stand, coarse);
  EXPECT_LT(coarse_mesh.triangles.size(), fine_mesh.triangles.size() / 2);
  for (const double zenith_deg : {0.0, 30.0, 60.0}) {
    const double fine = gap_at_zenith(fine_mesh, plot_size_m(stand), zenith_deg * degree).gap_fraction;
    const double rough = gap_at_zenith(coarse_mesh, plot_size_m(stand), zenith_deg * degree).gap_fraction;
    EXPECT_NEAR(rough, fine, 0.01 * fine) << "zenith angle " << zenith_deg;
  }
}

}  // namespace
}  // namespace sunfleck
