#pragma once
// One measurement of tracing.

#include "bench/rays.h"
#include "devices/gpu/context.h"
#include "physics/transport/model/tracer.h"

#include <benchmark/benchmark.h>

#include <string>

namespace sunfleck::bench {

enum class Rays { beam, leaf, random };
enum class Who { embree_single, embree_eight, ours };

struct Way {
  std::string name;
  Who who = Who::ours;
  const GpuContext* context = nullptr;  // null for the CPU path
};

[[nodiscard]] const char* name_of(Rays rays);

// Registers a benchmark by wall time, in milliseconds, which also reports the processor time of all threads.
template <class... Measure>
benchmark::internal::Benchmark* add_benchmark(const std::string& name, Measure... measure) {
  return benchmark::RegisterBenchmark(name.c_str(), measure...)
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

// Times the tracing of a million beam rays or a quarter of a million packets, without their preparation. Items are rays; the
// counter "triangles" is the number of the stand's triangles, "met" the share of rays that end on an element, where known.
void measure(benchmark::State& state, Rays rays, const Stand& stand, const Way& way);
void measure_ours(benchmark::State& state, Rays rays, const Stand& stand, Tracer& tracer);

}  // namespace sunfleck::bench
