// Measures whole simulations. feature: fixed work, eight replicates with 32,768 beam rays and as many first packets each, with
// one optional feature. solve: the paper's scene to its bounds.

#include "bench/benches.h"
#include "bench/measure.h"
#include "bench/ours.h"
#include "physics/transport/receivers/sensors.h"
#include "physics/transport/solve/solve.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace sunfleck::bench {
namespace {

struct Feature {
  std::string name;
  std::function<void(RadiationModel&)> change;
  bool element_errors = false;
};

void darken(RadiationModel& model) {
  for (SurfaceOptics& optics : model.optics) optics.upper = optics.lower = {FaceOptics{}};
  model.soil->reflectance = {0.0};
}

void add_band(RadiationModel& model) {
  model.bands.push_back({"NIR", 1.0, 0.0});
  for (SurfaceOptics& optics : model.optics) {
    optics.upper.push_back({0.45, 0.45});
    optics.lower.push_back({0.45, 0.45});
  }
  model.soil->reflectance.push_back(0.25);
}

void add_sky(RadiationModel& model) {
  model.sky = SkyModel{};
  model.bands[0].diffuse_w_m2 = 0.3;
}

void add_planes(RadiationModel& model) {
  for (const double height_m : {0.5, 1.0, 1.5}) {
    PlaneReceiver plane;
    plane.height_m = height_m;
    model.planes.push_back(plane);
  }
}

std::vector<Feature> all_features() {
  return {{"direct_alone", darken},
          {"plain", [](RadiationModel&) {}},
          {"element_errors", [](RadiationModel&) {}, true},
          {"second_band", add_band},
          {"sky", add_sky},
          {"three_planes", add_planes},
          {"200_layers", [](RadiationModel& model) { model.layers = 200; }}};
}

// Adds up the seconds spent inside a tracer; the rest of a simulation runs on the host.
class Timed final : public Tracer {
 public:
  explicit Timed(Tracer& tracer) : tracer_(tracer) {}

  [[nodiscard]] TracerDevice device() const override { return tracer_.device(); }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override {
    return timed([&] { return tracer_.count_beam(beam, counters, stop); });
  }
  [[nodiscard]] std::optional<TraceOutcome> record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                        std::span<shared::Landing> landings,
                                                        const StopQuestion& stop) override {
    return timed([&] { return tracer_.record_beam(beam, counters, landings, stop); });
  }
  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override {
    return timed([&] { return tracer_.keep_beam(beam, counters, stop); });
  }
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override {
    return timed([&] { return tracer_.trace(scene, packets, landings, stop); });
  }
  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) override {
    return timed([&] { return tracer_.make_rounds(passes, stop); });
  }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;

  template <class Trace>
  std::invoke_result_t<Trace> timed(const Trace& trace) {
    const Clock::time_point start = Clock::now();
    std::invoke_result_t<Trace> outcome = trace();
    seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
    return outcome;
  }

  Tracer& tracer_;
  double seconds_ = 0.0;
};

// Counter "tracing": seconds that the tracer took in each simulation.
void time_solve(benchmark::State& state, const Stand& stand, const GpuContext* context, const SolveSettings& settings) {
  Ours ours(stand, context);
  Timed timed(ours.tracer());
  for (auto _ : state) benchmark::DoNotOptimize(solve(stand.model, stand.prepared.layout, timed, settings, {}));
  state.counters["tracing"] = benchmark::Counter(timed.seconds(), benchmark::Counter::kAvgIterations);
}

void simulate_feature(benchmark::State& state, const GpuContext* context, const Feature& feature) {
  Stand stand(paper_plants);
  feature.change(stand.model);
  stand.prepared = test::Prepared(stand.model);
  SolveSettings settings;
  settings.passes = 8;
  settings.packets = 1U << 15U;
  settings.grid_m = std::sqrt(stand.model.plot.area_m2() / (*settings.packets * *settings.passes));
  settings.element_errors = feature.element_errors ? ElementErrors::keep : ElementErrors::skip;
  time_solve(state, stand, context, settings);
}

void simulate_paper(benchmark::State& state, const GpuContext* context) {
  time_solve(state, stand_of(paper_plants), context, {});
}

}  // namespace

void register_features(const GpuContext* context) {
  const auto add = [](const Feature& feature, const char* who, const GpuContext* on) {
    add_benchmark(fmt::format("feature/{}/{}", feature.name, who), simulate_feature, on, feature);
  };
  for (const Feature& feature : all_features()) {
    add(feature, "cpu", nullptr);
    if (context != nullptr) add(feature, "device", context);
  }
  add_benchmark("solve/paper/cpu", simulate_paper, static_cast<const GpuContext*>(nullptr));
  if (context != nullptr) add_benchmark("solve/paper/device", simulate_paper, context);
}

}  // namespace sunfleck::bench
