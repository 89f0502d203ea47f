#include "physics/transport/solve/darkness.h"

#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/planes.h"
#include "physics/transport/solve/result_of.h"
#include "physics/transport/solve/run_addition.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace sunfleck {
namespace {

// A confidence interval needs several replicates.
constexpr int darkness_replicates = 8;

}  // namespace

bool has_lamps(const RadiationModel& model) {
  const std::vector<BandQuanta> quanta = make_band_quanta(model, {});
  return std::any_of(quanta.begin(), quanta.end(), [](const BandQuanta& band) { return band.lamps > 0; });
}

bool is_dark(const RadiationModel& model) {
  return !model.has_beam() && !model.has_sky() && !has_lamps(model);
}

RadiationResult dark_result(const RadiationModel& model, const CounterLayout& layout, const SolveSettings& settings) {
  const Surfaces surfaces(model);
  std::optional<PlaneReceivers> receivers;
  if (!model.planes.empty()) receivers.emplace(model, layout, surfaces);
  const CanopyAreas areas(model, layout, surfaces);
  const Conversion conversion(model, layout, surfaces, areas, receivers ? &*receivers : nullptr, {});
  RunSums sums(conversion, settings.element_errors);
  Replicate nothing;
  nothing.counters.resize(layout.words());
  nothing.direct = conversion.sum(nothing.counters);
  for (int k = 0; k < darkness_replicates; ++k) add_replicate(nothing, sums);
  RadiationResult result = result_of(sums, settings.accuracy.confidence);
  result.stop = StopReason::bound_reached;
  result.direct.relative_error = 0.0;
  if (!settings.grid_m && !settings.passes) result.direct.bound = settings.accuracy.direct;
  return result;
}

}  // namespace sunfleck
