#pragma once
// The irradiance of one side of an element, or of a cell of the soil's map, in one band.

#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <algorithm>
#include <cstddef>

namespace sunfleck {

struct Irradiance {
  double direct_w_m2 = 0.0;    // by the beam's first landings
  double sky_w_m2 = 0.0;       // by unscattered sky light, a part of indirect
  double indirect_w_m2 = 0.0;  // by all light but the beam

  [[nodiscard]] double total_w_m2() const { return direct_w_m2 + indirect_w_m2; }
  // The sky's part is larger than the whole only by rounding.
  [[nodiscard]] double scattered_w_m2() const { return std::max(0.0, indirect_w_m2 - sky_w_m2); }
};

// Returns zeros where the area is 0. A side is numbered 2 * element + face, the upper face is 0.
[[nodiscard]] inline Irradiance side_irradiance(const RadiationModel& model, const RadiationResult& result, std::size_t side,
                                                double area_m2, std::size_t band) {
  return {result.side_direct_w_m2(side, area_m2, model.bands[band].direct_w_m2), result.side_sky_w_m2(side, area_m2, band),
          result.side_indirect_w_m2(side, area_m2, band)};
}

[[nodiscard]] inline Irradiance cell_irradiance(const RadiationModel& model, const RadiationResult& result, std::size_t cell,
                                                double area_m2, std::size_t band) {
  return {result.irradiance_w_m2(result.soil_cells[cell], area_m2, model.bands[band].direct_w_m2),
          result.cell_sky_w_m2(cell, area_m2, band), result.cell_indirect_w_m2(cell, area_m2, band)};
}

// Returns the flux that both faces absorb per one-sided area, W m-2, of that incident on each.
[[nodiscard]] inline double absorbed_w_m2(const SurfaceOptics& optics, double upper_w_m2, double lower_w_m2, std::size_t band) {
  return upper_w_m2 * optics.upper[band].absorptance() + lower_w_m2 * optics.lower[band].absorptance();
}

}  // namespace sunfleck
