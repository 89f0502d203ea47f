// Tests counts beyond 32 bits, and integers near the ends of their ranges.
#include "base/error.h"
#include "base/random.h"
#include "extremes/tracers.h"
#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/beam_block.h"
#include "physics/transport/solve/run_addition.h"
#include "shared/beam.h"
#include "support/chi_square.h"
#include "support/comparison.h"
#include "support/error_text.h"
#include "support/leaf_scenes.h"
#include "support/scattering.h"

#include <array>
#include <limits>
#include <numeric>
#include <set>

namespace sunfleck::test {
namespace {

constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();

Mesh quarter() {
  MeshMaker maker;
  maker.triangle({0.0, 0.5, 0.0}, {0.0, 0.5, 0.7071}, {0.7071, 0.5, 0.0});
  return maker.mesh();
}

// Counts rays without sending them: a given number out of every 2^20 on the first element, the others on the first cell of the
// soil. A tracer may be anything that counts every ray once (physics/transport/model/tracer.h), so a run of billions of rays
// takes no time.
class CountingTracer final : public Tracer {
 public:
  CountingTracer(const CounterLayout& layout, std::uint64_t on_element, std::uint64_t spread)
      : layout_(layout), on_element_(on_element), spread_(spread) {}
  [[nodiscard]] TracerDevice device() const override { return {"cpu", "counting", "", true}; }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion&) override {
    const std::uint64_t rays = std::uint64_t{beam.columns} * beam.rows;
    const std::uint64_t share = on_element_ + (spread_ > 0 ? beam.key.x % spread_ : 0);
    const std::uint64_t hits = (rays * share) >> 20U;
    counters[layout_.first_bin_word] += static_cast<std::uint32_t>(hits);
    counters[shared::counter_first_cell] += static_cast<std::uint32_t>(rays - hits);
    return TraceOutcome::finished;
  }
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock&, std::span<const shared::Packet>, std::span<shared::Landing>,
                                   const StopQuestion&) override {
    return TraceOutcome::stopped;
  }

 private:
  const CounterLayout& layout_;
  std::uint64_t on_element_, spread_;
};

// Counts 32 replicates of the largest grid.
TEST(ExtremeCounts, EightBillionRaysInARun) {
  const RadiationModel model = black_model(quarter(), unit_plot, sun_at(60.0, 33.0));
  const Prepared prepared(model);
  CountingTracer tracer(prepared.layout, 3U << 18U, 0);
  const SolveSettings settings = fixed_work(model, 32.0 * static_cast<double>(max_grid_rays));
  const RadiationResult result = solve(model, prepared.layout, tracer, settings, {});
  EXPECT_EQ(result.direct.rays, std::uint64_t{1} << 33U);
  EXPECT_EQ(result.elements[0].upper, std::uint64_t{3} << 31U);
  EXPECT_EQ(result.soil_cells[0], std::uint64_t{1} << 31U);
  EXPECT_NEAR(result.bands[0].incident.value, 1.0, 1e-12);
  EXPECT_NEAR(result.bands[0].absorbed_vegetation.value, 0.75, 1e-12);
  EXPECT_NEAR(result.bands[0].absorbed_soil.value, 0.25, 1e-12);
  EXPECT_NEAR(result.ground_sunfleck_ratio.value, 0.25, 1e-12);
  EXPECT_NEAR(result.irradiance_w_m2(result.elements[0].upper, 0.25, 1.0), 3.0, 1e-12);
  EXPECT_NEAR(result.layers.back().sunfleck_ratio.value, 1.0, 1e-12);
  EXPECT_NEAR(result.direct.grid_m, 0x1p-16 / std::sqrt(2.0), 1e-12);
}

// No run reaches this bound: the run ends, and reports it, while the ledgers can still hold the incident flux.
TEST(ExtremeCounts, ARunHasNoMoreReplicatesThanItsLedgersHold) {
  const RadiationModel model = black_model(quarter(), unit_plot, sun_at(60.0, 33.0));
  const Prepared prepared(model);
  CountingTracer tracer(prepared.layout, 1U << 18U, 1U << 18U);
  SolveSettings settings;
  settings.accuracy.direct = 1e-12;
  const RadiationResult result = solve(model, prepared.layout, tracer, settings, {});
  EXPECT_TRUE(result.stop == StopReason::replicates_spent);
  EXPECT_EQ(result.direct.replicates, most_replicates);
  EXPECT_EQ(result.direct.rays, most_replicates * max_grid_rays);
  EXPECT_GT(result.bands[0].ledger.incident, std::int64_t{1} << 61U);
  EXPECT_EQ(result.bands[0].ledger.residual(), 0);
  EXPECT_NEAR(result.bands[0].incident.value, 1.0, 1e-9);
  EXPECT_NEAR(result.bands[0].absorbed_vegetation.value, 0.375, 0.01);
  EXPECT_NEAR(result.bands[0].absorbed_vegetation.value + result.bands[0].absorbed_soil.value, 1.0, 1e-9);
}

class ExtremeCounters : public EveryTracer {};

// One replicate never has more rays than a counter can hold; counting starts from the counters' present values.
TEST_F(ExtremeCounters, CountUpToTheirLastNumber) {
  static_assert(max_grid_rays < (std::uint64_t{1} << 32U));
  MeshMaker roof;
  roof.level(0.0, 1.0, 0.0, 1.0, 0.5);
  const RadiationModel model = black_model(roof.mesh(), unit_plot, sun_at(60.0, 33.0));
  const Prepared prepared(model);
  const shared::BeamBlock beam = make_beam_block(model, prepared.layout, 30'000, 1, 0);
  CpuTracer cpu(prepared.bvh, tracer_scene(model));
  std::vector<std::uint32_t> plain(prepared.layout.words());
  EXPECT_TRUE(cpu.count_beam(beam, plain, {}) == TraceOutcome::finished);
  EXPECT_EQ(std::accumulate(plain.begin(), plain.end(), std::uint64_t{0}), std::uint64_t{beam.columns} * beam.rows);
  std::vector<std::uint32_t> begun(plain.size());
  for (std::size_t word = 0; word < begun.size(); ++word) begun[word] = 0xffffffffU - plain[word];
  const GpuTree tree(context(), prepared.bvh, BufferUse::uniform_texel);
  VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words());
  for (Tracer* tracer : {static_cast<Tracer*>(&cpu), static_cast<Tracer*>(&device)}) {
    std::vector<std::uint32_t> counters = begun;
    EXPECT_TRUE(tracer->count_beam(beam, counters, {}) == TraceOutcome::finished);
    for (const std::uint32_t word : counters) EXPECT_EQ(word, 0xffffffffU);
  }
}

// The largest grids in every shape: the last rays lie in the last cells, on the rectangle, and do not all coincide.
TEST(ExtremeCounts, LastRaysOfTheLargestGrids) {
  for (const double ratio : {1.0, 3.0, 1e3, 0x1p20, 1e-3, 0x1p-20}) {
    const BeamGrid grid = endless_beam_grid({ratio, 1.0}, 1.0, {0.0, 1.0, 0.0}, static_cast<double>(max_grid_rays));
    EXPECT_LE(grid.rays(), max_grid_rays);
    EXPECT_GE(grid.rays(), max_grid_rays - max_grid_rays / 16);
    shared::BeamBlock beam{};
    beam.edge_u = {1.0F, 0.0F, 0.0F};
    beam.edge_v = {0.0F, 0.0F, 1.0F};
    beam.columns = grid.columns;
    beam.rows = grid.rows;
    beam.per_column = 1.0F / static_cast<float>(grid.columns);
    beam.per_row = 1.0F / static_cast<float>(grid.rows);
    beam.key = {1, 2};
    const auto rays = static_cast<std::uint32_t>(grid.rays());
    std::set<float> places;
    for (std::uint32_t ray = rays - 64; ray < rays; ++ray) {
      const glm::vec3 origin = shared::beam_origin(beam, ray);
      const std::uint32_t strip_rows = grid.rows % 4 == 0 ? 4 : grid.rows % 4;
      EXPECT_GE(origin.x, 1.0 - 65.0 / grid.columns - 0x1p-23);
      EXPECT_GE(origin.z, 1.0 - (strip_rows + 1.0) / grid.rows - 0x1p-23);
      EXPECT_LE(origin.x, 1.0F + 0x1p-23F);
      EXPECT_LE(origin.z, 1.0F + 0x1p-23F);
      places.insert(grid.columns > grid.rows ? origin.z : origin.x);
    }
    EXPECT_GT(places.size(), 8U) << ratio;
  }
}

// A sample may begin with the first ray and end with the last one, of the most rays that a grid has too.
TEST(ExtremeCounts, SampledRaysExist) {
  for (const std::uint32_t rays : {4U, 1U << 20U, static_cast<std::uint32_t>(max_grid_rays)}) {
    for (const std::uint32_t count : {1U, 3U, 4U, 1U << 20U, static_cast<std::uint32_t>(max_grid_rays)}) {
      if (count > rays) continue;
      EXPECT_EQ(shared::sampled_ray({rays, count, 0}, 0), 0U);
      EXPECT_EQ(shared::sampled_ray({rays, count, rays - 1}, count - 1), rays - 1);
    }
  }
}

// Ray numbers up to the end of 32 bits, and replicates beyond, have separate streams, each evenly spread.
TEST(ExtremeCounts, RandomNumbersOfFarReplicatesAndRays) {
  std::set<std::uint64_t> keys;
  const std::array<std::uint64_t, 5> starts{0, (std::uint64_t{1} << 32U) - 500, std::uint64_t{1} << 40U,
                                            std::uint64_t{1} << 48U, std::numeric_limits<std::uint64_t>::max() - 2000};
  for (const std::uint64_t start : starts) {
    for (std::uint64_t replicate = start; replicate < start + 1000; ++replicate) {
      keys.insert(RandomStream(1, replicate).word());
    }
  }
  EXPECT_EQ(keys.size(), 5000U);
  std::vector<std::size_t> cells(1024);
  constexpr std::uint32_t draws = 1U << 17U;
  for (std::uint32_t k = 0; k < draws; ++k) {
    const std::uint64_t key = RandomStream(1, (std::uint64_t{1} << 33U) + k % 7).word();
    const auto words =
        shared::random_words({static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)}, 0xffffffffU - k, 0);
    ++cells[static_cast<std::size_t>(shared::unit_interval(words.x) * 1024.0F)];
  }
  expect_flat(cells, "rays before 2^32");
}

// Whatever the size of the light, a replicate's quanta are about 2^46 and never above 2^47.
TEST(ExtremeQuanta, StayNearTheirNumber) {
  RadiationModel model = black_model(quarter(), unit_plot, sun_at(60.0, 33.0));
  model.sky = SkyModel{};
  for (const std::uint64_t rays : {std::uint64_t{1}, std::uint64_t{1} << 14U, max_grid_rays}) {
    for (double power = -300.0; power <= 300.0; power += 0.37) {
      model.bands = {{"PAR", 1.0, std::pow(10.0, power)}};
      const BandQuanta quanta = make_band_quanta(model, {rays, rays, 1.0 / static_cast<double>(rays), 1.0})[0];
      const double incident = static_cast<double>(quanta.per_ray) * static_cast<double>(rays) + static_cast<double>(quanta.sky);
      EXPECT_LE(incident, 0x1p47 * (1.0 + 1e-9)) << power;
      EXPECT_GE(incident, 0x1p45) << power;
      // The second term of the tolerance is what a beam loses by rounding to quanta.
      EXPECT_NEAR(incident * quanta.w_m2_per_quantum / (1.0 + model.bands[0].diffuse_w_m2), 1.0,
                  1e-12 + static_cast<double>(rays) * 0x1p-47);
    }
  }
}

TEST(ExtremeQuanta, SplitToTheLastOneUpToTheEndOf63Bits) {
  Random random(3);
  for (const std::int64_t quanta : {std::int64_t{0}, std::int64_t{1}, std::int64_t{3}, (std::int64_t{1} << 53U) + 1,
                                    (std::int64_t{1} << 62U) - 1, largest}) {
    for (const auto& [reflectance, transmittance] :
         {std::pair{0.12, 0.06}, std::pair{0.5, 0.5}, std::pair{1.0, 0.0}, std::pair{0.0, 1.0}, std::pair{0.1, 0.9},
          std::pair{1e-300, 0.0}, std::pair{1.0 - 1e-9, 1e-9}}) {
      for (int k = 0; k < 50; ++k) {
        const auto u = k == 0 ? 0U : (k == 1 ? 0xffffffffU : static_cast<std::uint32_t>(random.uniform() * 0x1p32));
        const QuantaSplit split = split_quanta(quanta, split_coefficients(reflectance, transmittance), u);
        EXPECT_EQ(split.absorbed + split.reflected + split.transmitted, quanta);
        EXPECT_GE(std::min({split.absorbed, split.reflected, split.transmitted}), 0);
        if (reflectance + transmittance == 1.0) {
          EXPECT_EQ(split.absorbed, 0) << quanta << " " << reflectance;
        }
        const double exact = static_cast<double>(quanta) * reflectance;
        // Coefficients are rounded to 2^-32.
        EXPECT_NEAR(static_cast<double>(split.reflected), exact, 1.0 + 0x1p-33 * static_cast<double>(quanta));
      }
    }
  }
}

// Light enclosed between mirrors lands again and again. Sums that would overflow fail the run.
TEST(ExtremeQuanta, TooManyLandingsFailTheRun) {
  RadiationModel model = leaf_model(quarter(), unit_plot, sun_at(60.0, 33.0), std::array{nir_band});
  const Prepared prepared(model);
  const Surfaces surfaces(model);
  const CanopyAreas areas(model, prepared.layout, surfaces);
  const Conversion conversion(model, prepared.layout, surfaces, areas, nullptr, {});
  RunSums sums(conversion, ElementErrors::skip);
  Replicate replicate;
  replicate.counters.resize(prepared.layout.words());
  replicate.direct = conversion.sum(replicate.counters);
  IndirectSums& indirect = replicate.packets.emplace(model, prepared.layout, surfaces);
  const std::int64_t whole = std::int64_t{20000} << 46U;  // most_rounds times the whole flux
  indirect.surface_landed[0] = whole;
  indirect.side_landed.add(0, {&whole, 1});
  int added = 0;
  const std::string message = refusal_of(
      [&] {
        for (; added < 100; ++added) add_replicate(replicate, sums);
      },
      ErrorKind::failure);
  EXPECT_NE(message.find("band NIR: its light landed too often"), std::string::npos) << message;
  EXPECT_NE(message.find("); "), std::string::npos);
  EXPECT_EQ(added, 3);  // 2^60.3 each, 2^62 in total
}

}  // namespace
}  // namespace sunfleck::test
