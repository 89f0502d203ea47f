#include "programs/validate/known/canopy_scenes.h"

#include "programs/validate/known/case_scenes.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace sunfleck {

Mesh explicit_leaves() {
  std::uint64_t state = 20020808;
  const auto unit = [&] {
    std::uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  };
  MeshMaker mesh;
  for (int leaf = 0; leaf < 300; ++leaf) {
    const double x = unit();
    const double y = unit();
    const double z = 0.1 + 0.9 * unit();
    const double c = unit();
    const double phi = 2.0 * std::numbers::pi * unit();
    const double psi = 2.0 * std::numbers::pi * unit();
    const double s = std::sqrt(1.0 - c * c);
    const glm::dvec3 e1(c * std::cos(phi), c * std::sin(phi), -s);
    const glm::dvec3 e2(-std::sin(phi), std::cos(phi), 0.0);
    const glm::dvec3 a = 0.05 * (std::cos(psi) * e1 + std::sin(psi) * e2);
    const glm::dvec3 b = 0.05 * (-std::sin(psi) * e1 + std::cos(psi) * e2);
    const glm::dvec3 centre(x, y, z);
    const auto placed = [](const glm::dvec3& at) { return from_east_north_up(at.x, at.y, at.z); };
    mesh.organ("leaf", 1, leaf + 1);
    mesh.quad(placed(centre - a - b), placed(centre + a - b), placed(centre + a + b), placed(centre - a + b));
  }
  return mesh.mesh();
}

Estimate KnownMean::fit() const {
  const auto n = static_cast<double>(points_.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, squares = 0.0;
  for (const auto& [px, py] : points_) x += px / n, y += py / n;
  for (const auto& [px, py] : points_) xx += (px - x) * (px - x), xy += (px - x) * (py - y);
  const double slope = xy / xx;
  for (const auto& [px, py] : points_) squares += std::pow(py - y - slope * (px - x), 2.0);
  const double moved = x - mean_x_;
  return {y - slope * moved, std::sqrt(squares / (n - 2.0) * (1.0 / n + moved * moved / xx))};
}

}  // namespace sunfleck
