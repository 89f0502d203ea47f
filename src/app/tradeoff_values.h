#pragma once
// The values whose errors `tradeoff` measures, taken from a run's result, and what they are judged against.

#include "io/tradeoff_table.h"
#include "transport/model.h"
#include "transport/result.h"

#include <array>
#include <vector>

namespace sunfleck {

// One quantity's values in one run.
struct QuantityValues {
  std::vector<double> value;
  std::vector<double> half_width;  // NaN where the run reports none
};
using RunValues = std::array<QuantityValues, 4>;  // [quantity]

// Value i counts with its weight, its error relative to its scale. The weights of values that are not judged are 0.
struct QuantityNorm {
  std::vector<double> weight, scale;
};
using RunNorms = std::array<QuantityNorm, 4>;

// The same scene with nothing but the sun's beam, 1 W m-2 of it, and surfaces that absorb all: what they absorb is the direct
// light. Same elements, layers and cells, so that tree and counters serve both.
[[nodiscard]] RadiationModel direct_light_model(const RadiationModel& model);

// What is absorbed: [band][vegetation, soil]; [layer][band]; [organ][band]; [band][element] with their half-widths.
[[nodiscard]] RunValues absorbed_values(const RadiationModel& model, const RadiationResult& result);

// All light but the beam: what vegetation and soil absorb of it, relative half-width as the pass reports it; the upward flux
// through the planes below and above the layers; organs' irradiance; triangles' irradiance, without half-widths.
[[nodiscard]] RunValues indirect_values(const RadiationModel& model, const RadiationResult& result);

// How values like these (of which only `value` is read) are judged: canopy and layers relative to themselves, or to a hundredth
// of the incident flux if that is more; organs but soil relative to themselves, from a tenth of the mean organ's flux
// upwards; triangles by their area, relative to their mean. `incident_w_m2` is [band].
[[nodiscard]] RunNorms make_norms(const RadiationModel& model, const RunValues& values,
                                  const std::vector<double>& incident_w_m2);

[[nodiscard]] std::vector<double> incident_w_m2(const RadiationResult& result);

}  // namespace sunfleck
