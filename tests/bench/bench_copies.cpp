// Measures rays per second in a stand whose plants are copies of one mesh, when these share its triangles and when each has its
// own.

#include "bench/benches.h"
#include "bench/measure.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <vector>

namespace sunfleck::bench {

void register_copies(const GpuContext* context) {
  std::vector<Way> ways = {{"cpu", Who::ours, nullptr}};
  if (context != nullptr) ways.push_back({"device", Who::ours, context});
  for (const Rays rays : {Rays::beam, Rays::leaf}) {
    for (const Way& way : ways) {
      for (const Copies copies : {Copies::own, Copies::shared}) {
        const char* tree = copies == Copies::shared ? "shared" : "own";
        add_benchmark(fmt::format("copies/{}/{}/{}", rays == Rays::beam ? "beam" : "leaf", way.name, tree),
                      [=](benchmark::State& state) { measure(state, rays, stand_of_copies(copies), way); });
      }
    }
  }
}

}  // namespace sunfleck::bench
