// Measures where the rounds of indirect passes are made: fixed work, eight replicates of 131,072 first packets.
//   rounds/BAND/WHERE   WHERE is `device` or `host`, while the device traces in both, one replicate at a time; `lanes`: on the device, all
//                       eight at once, as far as there are threads; counters of one replicate: submissions, bytes to and from the
//                       device, and packets

#include "bench/benches.h"
#include "bench/measure.h"
#include "bench/ours.h"
#include "physics/transport/solve/solve.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sunfleck::bench {
namespace {

void make_rounds(benchmark::State& state, const GpuContext* context, const LeafBand& band, RoundsAt where, int at_once) {
  Stand stand(paper_plants);
  set_leaf_bands(stand.model, std::array{band});
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
  for (const LeafBand& band : {par_band, nir_band}) {
    add_benchmark(fmt::format("rounds/{}/device", band.name), make_rounds, context, band, RoundsAt::device, 1);
    add_benchmark(fmt::format("rounds/{}/lanes", band.name), make_rounds, context, band, RoundsAt::device, 8);
    add_benchmark(fmt::format("rounds/{}/host", band.name), make_rounds, context, band, RoundsAt::host, 1);
  }
}

}  // namespace sunfleck::bench
