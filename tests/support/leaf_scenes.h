#pragma once
// Canopies whose leaves reflect and transmit, and settings for testing them.

#include "support/models.h"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace sunfleck::test {

// Leaves with equal faces, over Lambertian soil.
struct BandOptics {
  std::string name;
  double reflectance, transmittance, soil_reflectance;
};
inline const BandOptics paper_par{"PAR", 0.12, 0.06, 0.15};
inline const BandOptics usual_nir{"NIR", 0.45, 0.45, 0.20};

// Gives every surface of a black_model these optics; each band has 1 W m-2 on the horizontal.
inline RadiationModel scattering_model(RadiationModel model, std::span<const BandOptics> bands) {
  model.bands.clear();
  std::vector<FaceOptics> faces;
  if (model.soil) model.soil->reflectance.clear();
  for (const BandOptics& band : bands) {
    model.bands.push_back({band.name, 1.0, 0.0});
    faces.push_back({band.reflectance, band.transmittance});
    if (model.soil) model.soil->reflectance.push_back(band.soil_reflectance);
  }
  for (SurfaceOptics& optics : model.optics) optics.upper = optics.lower = faces;
  return model;
}

inline RadiationModel scattering_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun,
                                       std::span<const BandOptics> bands) {
  return scattering_model(black_model(mesh, plot, sun), bands);
}

inline RadiationModel paper_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun) {
  return scattering_model(mesh, plot, sun, std::array{paper_par, usual_nir});
}

struct ScatterWork {
  double rays = 1e6;     // of all replicates together
  double packets = 1e4;  // of each replicate's first round
  int replicates = 32;
  std::uint64_t seed = 1;
  double bound = 1e-4;  // a tenth of it stays unshot, far below the errors tested
};

inline SolveSettings fixed_scatter(const RadiationModel& model, const ScatterWork& work) {
  SolveSettings settings = fixed_work(model, work.rays, work.replicates, work.seed);
  settings.packets = work.packets;
  settings.accuracy.indirect = work.bound;
  return settings;
}

// Returns all light that lands on the soil plane (W m-2 of ground), from the map of its cells.
inline double soil_irradiance_w_m2(const RadiationModel& model, const RadiationResult& result, std::size_t band) {
  double sum_w = 0.0;
  for (const std::uint64_t landings : result.soil_cells) {
    sum_w += static_cast<double>(landings) * result.ground_per_ray_m2 * model.bands[band].direct_w_m2;
  }
  for (std::size_t k = band; k < result.cell_indirect.size(); k += model.bands.size()) {
    sum_w += static_cast<double>(result.cell_indirect[k]) * result.w_per_quantum[band];
  }
  return sum_w / model.plot.area_m2();
}

// Replaces the beam by the same amount of sky light.
inline void shine_from_sky(RadiationModel& model, const SkyModel& sky) {
  for (Waveband& band : model.bands) {
    band.diffuse_w_m2 = band.direct_w_m2;
    band.direct_w_m2 = 0.0;
  }
  model.sky = sky;
}

// Returns the sky's unscattered light on the soil plane (W m-2 of ground).
inline double sky_on_soil_w_m2(const RadiationModel& model, const RadiationResult& result, std::size_t band) {
  double sum_w = 0.0;
  for (std::size_t k = band; k < result.cell_sky.size(); k += model.bands.size()) {
    sum_w += static_cast<double>(result.cell_sky[k]) * result.w_per_quantum[band];
  }
  return sum_w / model.plot.area_m2();
}

// Scene S1 of the validation table (B12): 300 square leaves of 0.1 m, one organ each, over 1 m2.
struct ExplicitLeaf {
  glm::dvec3 centre_m, normal;  // x east, y north, z up
};
struct ExplicitScene {
  std::vector<ExplicitLeaf> leaves;
  Mesh mesh;
};
inline ExplicitScene explicit_scene() {
  std::uint64_t state = 20020808;
  const auto unit = [&] {  // the generator SplitMix64
    std::uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  };
  ExplicitScene scene;
  MeshMaker maker;
  for (int leaf = 0; leaf < 300; ++leaf) {
    const double x = unit();
    const double y = unit();
    const double z = 0.1 + 0.9 * unit();
    const double c = unit();
    const double phi = 2.0 * std::numbers::pi * unit();
    const double psi = 2.0 * std::numbers::pi * unit();
    const double s = std::sqrt(1.0 - c * c);
    const glm::dvec3 normal(s * std::cos(phi), s * std::sin(phi), c);
    const glm::dvec3 e1(c * std::cos(phi), c * std::sin(phi), -s);
    const glm::dvec3 e2(-std::sin(phi), std::cos(phi), 0.0);
    const glm::dvec3 a = 0.05 * (std::cos(psi) * e1 + std::sin(psi) * e2);
    const glm::dvec3 b = 0.05 * (-std::sin(psi) * e1 + std::cos(psi) * e2);
    const glm::dvec3 centre(x, y, z);
    scene.leaves.push_back({centre, normal});
    const auto placed = [](const glm::dvec3& enu) { return from_enu(enu.x, enu.y, enu.z); };
    maker.organ("leaf", 1, leaf + 1);
    maker.quad(placed(centre - a - b), placed(centre + a - b), placed(centre + a + b), placed(centre - a + b));
  }
  scene.mesh = maker.mesh();
  return scene;
}

}  // namespace sunfleck::test
