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

inline RadiationModel paper_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun) {
  return leaf_model(mesh, plot, sun, std::array{par_band, nir_band});
}

struct ScatterWork {
  double rays = 1e6;     // of all replicates together
  double packets = 1e4;  // of each replicate's first round
  int replicates = usual_replicates;
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

// Returns the sky's unscattered light on the soil plane (W m-2 of ground).
inline double sky_on_soil_w_m2(const RadiationModel& model, const RadiationResult& result, std::size_t band) {
  double sum_w = 0.0;
  for (std::size_t k = band; k < result.cell_sky.size(); k += model.bands.size()) {
    sum_w += static_cast<double>(result.cell_sky[k]) * result.w_per_quantum[band];
  }
  return sum_w / model.plot.area_m2();
}

// Returns leaves in the open under sun and sky, over reflecting soil.
inline RadiationModel leaves_in_the_open() {
  RadiationModel model = paper_model(random_leaves(30, 0.01, unit_plot, 0.5, 3), unit_plot, sun_at(30.0, 120.0));
  model.sky = SkyModel{};
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.5;
  return model;
}

}  // namespace sunfleck::test
