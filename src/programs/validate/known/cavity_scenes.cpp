#include "programs/validate/known/cavity_scenes.h"

#include <cmath>
#include <string>

namespace sunfleck {
namespace {

using std::numbers::pi;

// Adds a rectangle facing along u x v, cut into n x n cells.
void add_wall(MeshMaker& mesh, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int n) {
  mesh.organ("wall" + std::to_string(mesh.mesh().organs.size()));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto at = [&](int a, int b) {
        return corner + u * (static_cast<double>(a) / n) + v * (static_cast<double>(b) / n);
      };
      mesh.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

MeshMaker box(int cells) {
  const glm::dvec3 x(1.0, 0.0, 0.0);
  const glm::dvec3 y(0.0, 0.6, 0.0);
  const glm::dvec3 z(0.0, 0.0, 0.8);
  const glm::dvec3 low(0.0, 0.1, 0.0);
  MeshMaker mesh;
  add_wall(mesh, low, z, x, cells);
  add_wall(mesh, low + y, x, z, cells);
  add_wall(mesh, low, y, z, cells);
  add_wall(mesh, low + x, z, y, cells);
  add_wall(mesh, low, x, y, cells);
  add_wall(mesh, low + z, y, x, cells);
  return mesh;
}

// Returns half a sphere from rings of trapezoids; the upper faces look inwards.
Mesh bowl(int around, int rings) {
  MeshMaker mesh;
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

Mesh empty_box(int cells) {
  return box(cells).mesh();
}

Mesh furnished_box(int cells) {
  MeshMaker mesh = box(cells);
  mesh.organ("leaf");
  mesh.polygon({0.3, 0.35, 0.3}, inclined(0.3, 1.0), 0.04, 4);
  mesh.polygon({0.6, 0.4, 0.5}, inclined(1.2, 2.5), 0.06, 3, 0.4);
  mesh.polygon({0.51, 0.443, 0.567}, inclined(1.3, 2.5), 0.05, 5, 1.0);
  mesh.polygon({0.75, 0.25, 0.2}, inclined(1.5708, 4.0), 0.03, 4, 0.7);
  return mesh.mesh();
}

RadiationModel dark_box(const Mesh& box, std::size_t bands) {
  return lamp_model(box, {1.0, 0.8, false}, bands);
}

RadiationModel furnace(const Mesh& box) {
  constexpr std::array<FaceOptics, 4> leaves = {FaceOptics{0.5, 0.5}, {0.3, 0.7}, {1.0, 0.0}, {0.15, 0.85}};
  RadiationModel model = dark_box(box, furnace_reflectances.size());
  for (std::size_t o = 0; o < model.optics.size(); ++o) {
    if (o < box_walls) model.optics[o].emission_w_m2.assign(furnace_reflectances.size(), 1.0);
    for (std::size_t b = 0; b < furnace_reflectances.size(); ++b) {
      if (o < box_walls) model.optics[o].upper[b].reflectance = furnace_reflectances[b];
      if (o >= box_walls) model.optics[o].upper[b] = model.optics[o].lower[b] = leaves[b];
    }
  }
  return model;
}

Bowl bowl_under(const SunPosition& sun, int around, std::span<const double> reflectances) {
  Bowl scene{black_model(bowl(around, around / 4), {1.0, 1.0, false}, sun)};
  set_bands(scene.model, reflectances.size());
  for (std::size_t b = 0; b < reflectances.size(); ++b) scene.model.optics[0].upper[b].reflectance = reflectances[b];
  double inner_m2 = 0.0;
  for (const Triangle& corners : scene.model.canopy.corners) inner_m2 += area_m2(corners);
  scene.opening_m2 = 0.5 * around * std::sin(2.0 * pi / around) * 0.25;
  scene.kept = 1.0 - scene.opening_m2 / inner_m2;
  return scene;
}

}  // namespace sunfleck
