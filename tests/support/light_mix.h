#pragma once
// A small scene with a little of everything that replicates count: sun, sky, two bands, soil, scattering leaves, receivers.

#include "support/scattering.h"

namespace sunfleck::test {

inline RadiationModel light_mix() {
  const Plot plot{1.0, 1.0, true};
  RadiationModel model = black_model(random_leaves(40, 0.02, plot, 1.0, 3), plot, sun_at(50.0, 120.0));
  set_bands(model, 2);
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.3;
  for (std::size_t k = 0; k < model.optics.size(); ++k) set_faces(model, k, {{0.1, 0.05}, {0.4, 0.4}});
  model.soil->reflectance = {0.15, 0.3};
  model.sky = SkyModel{};
  model.planes.push_back({0.5, 4, 4});
  return model;
}

// Returns settings that need about 16 quick replicates or more.
inline SolveSettings to_a_wide_bound() {
  SolveSettings settings;
  settings.accuracy.direct = 0.02;
  settings.accuracy.indirect = 0.02;
  settings.element_errors = ElementErrors::keep_sides;
  return settings;
}

}  // namespace sunfleck::test
