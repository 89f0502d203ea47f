// Measures where the rounds of indirect passes are made: fixed work, eight replicates of 131,072 first packets.
//   rounds/STAND/WHERE  STAND is PAR or NIR in the sparse maize, or with PAR, `planes`, the same with two receivers, or `copies`, a stand
//                       whose plants share triangles. WHERE is `device` or `host`, while the device traces in both, one replicate at a
//                       time; `lanes`: on the device, all eight at once, as far as there are threads; counters of one replicate:
//                       submissions, bytes to and from the device, and packets

#include "bench/benches.h"
#include "bench/measure.h"
#include "bench/ours.h"
#include "physics/transport/solve/solve.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace sunfleck::bench {
namespace {

using MakeModel = std::function<RadiationModel()>;

RadiationModel maize(const LeafBand& band) {
  RadiationModel model = stand_of(paper_plants).model;
  set_leaf_bands(model, std::array{band});
  return model;
}

RadiationModel planes() {
  RadiationModel model = maize(par_band);
  model.planes = {{0.5, 180, 240}, {1.5, 1, 1}};
  return model;
}

RadiationModel copies() {
  RadiationModel model = stand_of_copies(Copies::shared).model;
  set_leaf_bands(model, std::array{par_band});
  return model;
}

void make_rounds(benchmark::State& state, const GpuContext* context, const MakeModel& make, RoundsAt where, int at_once) {
  const Stand stand(make());
  OurChoices choices;
  choices.cut.rounds_at = where;
  Ours ours(stand, context, choices);
  SolveSettings settings;
  settings.passes = 8;
  settings.packets = 1U << 17U;
  settings.replicates_at_once = at_once;
  settings.grid_m = std::sqrt(stand.model.plot.area_m2() / (*settings.packets * *settings.passes));
  const DeviceTraffic before = context->traffic();
  std::uint64_t packets = 0;
  for (auto _ : state) packets += solve(stand.model, stand.prepared.layout, ours.tracer(), settings, {}).indirect.packets;
  const DeviceTraffic& after = context->traffic();
  const double replicates = static_cast<double>(state.iterations()) * *settings.passes;
  state.counters["submissions"] = static_cast<double>(after.submissions - before.submissions) / replicates;
  state.counters["up"] = static_cast<double>(after.uploaded_bytes - before.uploaded_bytes) / replicates;
  state.counters["down"] = static_cast<double>(after.downloaded_bytes - before.downloaded_bytes) / replicates;
  state.counters["packets"] = static_cast<double>(packets) / replicates;
}

}  // namespace

void register_rounds(const GpuContext* context) {
  if (context == nullptr) return;
  const std::array<std::pair<const char*, MakeModel>, 4> stands{{{"PAR", [] { return maize(par_band); }},
                                                                 {"NIR", [] { return maize(nir_band); }},
                                                                 {"planes", planes},
                                                                 {"copies", copies}}};
  for (const auto& [name, make] : stands) {
    add_benchmark(fmt::format("rounds/{}/device", name), make_rounds, context, make, RoundsAt::device, 1);
    add_benchmark(fmt::format("rounds/{}/lanes", name), make_rounds, context, make, RoundsAt::device, 8);
    add_benchmark(fmt::format("rounds/{}/host", name), make_rounds, context, make, RoundsAt::host, 1);
  }
}

}  // namespace sunfleck::bench
