#include "programs/validate/cavity_cases.h"

#include "programs/validate/case_scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sunfleck {
namespace {

using std::numbers::pi;
constexpr std::size_t walls = 6;

// Adds a rectangle facing along u x v, cut into n x n cells.
void add_wall(CaseMesh& mesh, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
  constexpr int n = 3;
  mesh.organ(fmt::format("wall{}", mesh.mesh().organs.size()));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto at = [&](int a, int b) {
        return corner + u * (static_cast<double>(a) / n) + v * (static_cast<double>(b) / n);
      };
      mesh.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

// Builds a closed box of 1 x 0.6 x 0.8 m whose upper faces look inwards, with leaves in it that do not intersect the walls.
Mesh furnished_box() {
  const glm::dvec3 x(1.0, 0.0, 0.0);
  const glm::dvec3 y(0.0, 0.6, 0.0);
  const glm::dvec3 z(0.0, 0.0, 0.8);
  const glm::dvec3 low(0.0, 0.1, 0.0);
  CaseMesh mesh;
  add_wall(mesh, low, z, x);
  add_wall(mesh, low + y, x, z);
  add_wall(mesh, low, y, z);
  add_wall(mesh, low + x, z, y);
  add_wall(mesh, low, x, y);
  add_wall(mesh, low + z, y, x);
  mesh.organ("leaf");
  mesh.polygon({0.3, 0.35, 0.3}, inclined_normal(0.3, 1.0), 0.04, 4);
  mesh.polygon({0.6, 0.4, 0.5}, inclined_normal(1.2, 2.5), 0.06, 3, 0.4);
  mesh.polygon({0.51, 0.443, 0.567}, inclined_normal(1.3, 2.5), 0.05, 5, 1.0);
  mesh.polygon({0.75, 0.25, 0.2}, inclined_normal(1.5708, 4.0), 0.03, 4, 0.7);
  return mesh.mesh();
}

// Builds half a sphere of radius 0.5, open upwards, from rings of trapezoids; the upper faces look inwards.
Mesh bowl(int around, int rings) {
  CaseMesh mesh;
  mesh.organ("bowl");
  const auto at = [&](int ring, int k) {
    const double polar = 0.5 * pi * ring / rings;  // from the bottom
    const double angle = 2.0 * pi * (k % around) / around;
    return glm::dvec3(0.5 + 0.5 * std::sin(polar) * std::cos(angle), 0.6 - 0.5 * std::cos(polar),
                      0.5 + 0.5 * std::sin(polar) * std::sin(angle));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      if (ring > 0) mesh.triangle(at(ring, k), at(ring, k + 1), at(ring + 1, k + 1));
      mesh.triangle(at(ring, k), at(ring + 1, k + 1), at(ring + 1, k));
    }
  }
  return mesh.mesh();
}

}  // namespace

// In a closed box whose walls all emit E and reflect rho, every surface receives E / (1 - rho), including both sides of leaves
// with rho + tau = 1.
void furnace_cases(CaseBench& bench) {
  constexpr std::array reflectances = {0.1, 0.5, 0.9, 0.95};
  constexpr std::array<FaceOptics, 4> leaves = {FaceOptics{0.5, 0.5}, {0.3, 0.7}, {1.0, 0.0}, {0.15, 0.85}};
  RadiationModel model = lamp_case(furnished_box(), {1.0, 0.8, false}, reflectances.size());
  for (std::size_t o = 0; o < model.optics.size(); ++o) {
    if (o < walls) model.optics[o].emission_w_m2.assign(reflectances.size(), 1.0);
    for (std::size_t b = 0; b < reflectances.size(); ++b) {
      if (o < walls) model.optics[o].upper[b].reflectance = reflectances[b];
      if (o >= walls) model.optics[o].upper[b] = model.optics[o].lower[b] = leaves[b];
    }
  }
  const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 4096));
  // Some of the light leaving a point within the packets' offset from a wall (2^-17 of the extent) slips out past the wall.
  constexpr double slipped = 2e-5;
  double absorbed_by_leaves = 0.0;
  for (std::size_t b = 0; b < reflectances.size(); ++b) {
    const double even = 1.0 / (1.0 - reflectances[b]);
    const auto share = [&](std::size_t organ) { return result.organs[organ].indirect[b].scaled(1.0 / even); };
    const Ask ask{.largest_error = 0.01, .tolerance = slipped * even};
    bench.compare(fmt::format("walls reflect {:g}, light on the floor", reflectances[b]), share(0), 1.0, ask);
    bench.compare(fmt::format("walls reflect {:g}, light on a wall", reflectances[b]), share(3), 1.0, ask);
    bench.compare(fmt::format("walls reflect {:g}, light on both sides of leaves", reflectances[b]), share(walls).scaled(0.5),
                  1.0, ask);
    absorbed_by_leaves += result.organs[walls].absorbed[b].value;
  }
  bench.equal("absorbed by leaves that absorb nothing", absorbed_by_leaves, 0.0, 1e-12);
}

// Of a beam from any direction into a spherical cavity that is the share f of its sphere, rho (1 - f) / (1 - rho f) comes out
// again. In a cavity of plane facets a facet does not see itself, so f is 1 - opening / inner area (reciprocity). The outside
// of the bowl and the ground are black.
void cavity_cases(CaseBench& bench) {
  constexpr std::array inside = {0.2, 0.5, 0.8};
  constexpr int around = 96;
  const Mesh mesh = bowl(around, around / 4);
  const double opening_m2 = 0.5 * around * std::sin(2.0 * pi / around) * 0.25;
  for (const double elevation : {60.0, 15.0}) {
    RadiationModel model = black_case(mesh, {1.0, 1.0, false}, case_sun(elevation, 40.0));
    set_case_bands(model, inside.size());
    double inner_m2 = 0.0;
    for (const Triangle& corners : model.canopy.corners) inner_m2 += area_m2(corners);
    const double kept = 1.0 - opening_m2 / inner_m2;
    for (std::size_t b = 0; b < inside.size(); ++b) model.optics[0].upper[b].reflectance = inside[b];
    const RadiationResult result = bench.simulate(model, case_work(model, 5e5, 8192));
    for (std::size_t b = 0; b < inside.size(); ++b) {
      bench.compare(fmt::format("bowl that reflects {:g}, sun {:g} degrees high", inside[b], elevation),
                    result.bands[b].reflected.scaled(model.plot.area_m2() / opening_m2),
                    inside[b] * (1.0 - kept) / (1.0 - inside[b] * kept), {.largest_error = 2e-3, .tolerance = 2e-5});
    }
  }
}

}  // namespace sunfleck
