#pragma once
// One measurement of tracing.

#include "bench/rays.h"
#include "gpu/context.h"
#include "transport/tracer.h"

#include <benchmark/benchmark.h>

#include <string>

namespace sunfleck::bench {

enum class Rays { beam, leaf, random };
enum class Who { embree_single, embree_eight, ours };

struct Way {
  std::string name;
  Who who = Who::ours;
  const GpuContext* context = nullptr;  // none: the CPU path
};

[[nodiscard]] const char* name_of(Rays rays);

// Registers a benchmark by wall time, in milliseconds, with the processor time of all threads beside it.
template <class... Measure>
benchmark::internal::Benchmark* add_benchmark(const std::string& name, Measure... measure) {
  return benchmark::RegisterBenchmark(name.c_str(), measure...)
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

// Times the tracing of a million beam rays or a quarter of a million packets; what prepares them is left out. Items are rays;
// counter "triangles" is the stand's number of them, "met" the share of rays that end on an element, where it is known.
void measure(benchmark::State& state, Rays rays, const Stand& stand, const Way& way);
void measure_ours(benchmark::State& state, Rays rays, const Stand& stand, Tracer& tracer);

}  // namespace sunfleck::bench
