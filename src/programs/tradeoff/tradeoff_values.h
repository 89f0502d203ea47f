#pragma once
// The values whose errors `tradeoff` measures, taken from a run's result, and the norms in which errors are expressed.

#include "files/results/tables/tradeoff_table.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <array>
#include <vector>

namespace sunfleck {

// The values of one quantity in one run.
struct QuantityValues {
  std::vector<double> value;
  std::vector<double> half_width;  // NaN where the run reports none
};
using RunValues = std::array<QuantityValues, 4>;  // [quantity]

// Value i counts with weight[i], and its error is relative to scale[i]. Values that are not judged have weight 0.
struct QuantityNorm {
  std::vector<double> weight, scale;
};
using RunNorms = std::array<QuantityNorm, 4>;

// Returns the same scene with only the sun's beam, of 1 W m-2, and surfaces that absorb everything: what they absorb is the
// direct light. Elements, layers and cells are the same, so that the tree and the counters serve both.
[[nodiscard]] RadiationModel direct_light_model(const RadiationModel& model);

// Returns the absorbed light with half-widths: [band][vegetation, soil]; [layer][band]; [organ][band]; [band][element].
[[nodiscard]] RunValues absorbed_values(const RadiationModel& model, const RadiationResult& result);

// Returns all light except the beam: the part that vegetation and soil absorb, with the relative half-width reported by the
// pass; the upward flux through the planes below and above the layers; the irradiance of organs; the irradiance of triangles,
// without half-widths.
[[nodiscard]] RunValues indirect_values(const RadiationModel& model, const RadiationResult& result);

// Returns how to judge values such as these, of which only `value` is read. Canopy and layers are judged relative to
// themselves, or to a hundredth of the incident flux if that is larger; organs other than soil relative to themselves, if they
// have at least a tenth of the mean organ's flux; triangles weighted by area, relative to their mean. `incident_w_m2` is
// [band].
[[nodiscard]] RunNorms make_norms(const RadiationModel& model, const RunValues& values,
                                  const std::vector<double>& incident_w_m2);

[[nodiscard]] std::vector<double> incident_w_m2(const RadiationResult& result);

}  // namespace sunfleck
