// Measures rays per second: Embree, the CPU path and the Vulkan path on the same rays.

#include "bench/benches.h"
#include "bench/measure.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <string>

namespace sunfleck::bench {
namespace {

constexpr std::array all_plots = {Plots::endless, Plots::single};
constexpr std::array all_rays = {Rays::beam, Rays::leaf, Rays::random};
// Plants, for 32,000 to ten million triangles.
constexpr std::array traced_fields = {2, 16, 158, 630};

const char* name_of(Plots plots) {
  return plots == Plots::endless ? "endless" : "single";
}

void add(const std::string& name, Rays rays, int plants, Plots plots, const Way& way) {
  add_benchmark(name, [=](benchmark::State& state) { measure(state, rays, stand_of(plants, plots), way); });
}

std::vector<Way> ours(const GpuContext* context) {
  std::vector<Way> ways = {{"cpu", Who::ours, nullptr}};
  if (context != nullptr) ways.push_back({"device", Who::ours, context});
  return ways;
}

}  // namespace

void register_tracing(const GpuContext* context) {
  std::vector<Way> ways = ours(context);
  ways.insert(ways.begin(), {{"embree1", Who::embree_single, nullptr}, {"embree8", Who::embree_eight, nullptr}});
  for (const Plots plots : all_plots) {
    for (const Rays rays : all_rays) {
      for (const Way& way : ways) {
        add(fmt::format("trace/{}/{}/{}", name_of(rays), name_of(plots), way.name), rays, paper_plants, plots, way);
      }
    }
  }
}

void register_growth(const GpuContext* context) {
  std::vector<Way> ways = ours(context);
  ways.insert(ways.begin(), {"embree1", Who::embree_single, nullptr});
  for (const int plants : traced_fields) {
    for (const Rays rays : {Rays::beam, Rays::leaf}) {
      for (const Way& way : ways) {
        add(fmt::format("growth/{}/{}/plants:{}", name_of(rays), way.name, plants), rays, plants, Plots::endless, way);
      }
    }
  }
}

}  // namespace sunfleck::bench
