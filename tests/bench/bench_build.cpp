// Measures the building of a tree from triangles, ours and Embree's, on one thread each.

#include "base/threads.h"
#include "bench/benches.h"
#include "bench/measure.h"
#include "bench/peer.h"
#include "physics/bvh/build.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <optional>
#include <utility>

namespace sunfleck::bench {
namespace {

constexpr int built_fields[] = {16, 158};

void build_ours(benchmark::State& state, int plants) {
  const Stand& stand = stand_of(plants);
  const CpuThreads one(1);
  for (auto _ : state) benchmark::DoNotOptimize(build_bvh(stand.model.canopy, box_padding_m(stand.model)));
  state.counters["triangles"] = static_cast<double>(stand.triangles());
}

void build_embree(benchmark::State& state, int plants) {
  const Stand& stand = stand_of(plants);
  for (auto _ : state) {
    state.PauseTiming();
    std::optional<Peer> peer(std::in_place, stand, 1);
    state.ResumeTiming();
    peer->build();
    state.PauseTiming();
    peer.reset();
    state.ResumeTiming();
  }
  state.counters["triangles"] = static_cast<double>(stand.triangles());
}

}  // namespace

void register_builds() {
  for (const int plants : built_fields) {
    add_benchmark(fmt::format("build/embree/plants:{}", plants), build_embree, plants);
    add_benchmark(fmt::format("build/sunfleck/plants:{}", plants), build_ours, plants);
  }
}

}  // namespace sunfleck::bench
