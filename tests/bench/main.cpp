// sunfleck_bench [--device=NAME] [Google Benchmark's options]: compares our engine with Embree in the same process.
//   trace/RAYS/PLOT/WHO        rays per second; RAYS: beam, leaf or random (packets in the tree's order, or in random order);
//                              PLOT: endless or single; WHO: embree1, embree8, cpu or device
//   growth/RAYS/WHO/plants:N   the same over canopies from 32,000 to ten million triangles
//   copies/RAYS/WHO/TREE       rays per second among copies of one plant; TREE: shared, or own triangles for each
//   build/WHO/plants:N         from triangles to a finished tree, on one thread
//   safeguard/WHAT/WHO/WITH    with and without a precaution
//   feature/WHAT/WHO           a whole simulation of fixed work, with one optional feature
//   solve/paper/WHO            the paper's scene to its bounds; counter "tracing" is the tracer's part of the time, s
//   device/...                 measurements of gpu_check.sh: see bench_device.cpp
//   rounds/...                 the rounds of indirect passes on the device and on the host: see bench_rounds.cpp
// The ratios compare medians: --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true, as report.sh runs it.

#include "bench/benches.h"

#include "devices/tracers/engine.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace {

// Takes our own option out of the command line and leaves Google Benchmark's options.
std::string take_device(std::vector<char*>& arguments) {
  constexpr std::string_view option = "--device=";
  std::string device = "lavapipe";
  std::erase_if(arguments, [&](const char* argument) {
    if (!std::string_view(argument).starts_with(option)) return false;
    device = argument + option.size();
    return true;
  });
  return device;
}

int run(std::vector<char*> arguments) {
  using namespace sunfleck;
  const std::string device = take_device(arguments);
  const std::unique_ptr<GpuContext> context = open_device(device);
  auto count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  if (context) {
    benchmark::AddCustomContext("device", context->description().name);
    benchmark::AddCustomContext("driver", context->description().driver);
  }
  bench::register_tracing(context.get());
  bench::register_growth(context.get());
  bench::register_copies(context.get());
  bench::register_builds();
  bench::register_safeguards(context.get());
  bench::register_features(context.get());
  bench::register_device(context.get());
  bench::register_rounds(context.get());
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sunfleck_bench: %s\n", error.what());
    return 1;
  }
}
