// Tests the exchange between surfaces that see each other (B2 and B3 of the validation table), and a blind whose strips shade
// their own copies in other periods.
#include "programs/validate/known/exchange_scenes.h"
#include "support/scattering.h"
#include "support/wrapped_tracer.h"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <vector>

namespace sunfleck::test {
namespace {

// Returns the share of the light emitted by one surface of the pair that lands on the other.
Estimate view_factor(const FacingPair& pair, std::size_t from, std::uint64_t seed) {
  RadiationModel model = lamp_model(pair.mesh, {1.0, 1.0, false});
  model.optics.at(from).emission_w_m2 = {3.0};
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 2048, usual_replicates, seed));
  // Rounding leaves hardly more than one quantum a packet.
  EXPECT_LE(result.bands[0].ledger.unshot, 2 * static_cast<std::int64_t>(result.indirect.packets));
  return absorbed_by_organ(model, result, 1 - from, 0).scaled(model.plot.area_m2() / (3.0 * pair.area_m2[from]));
}

// Lamps that shine upwards from half height light nothing below: no plane under them has any flux.
TEST(Exchange, LampsSendNothingBelow) {
  MeshMaker maker;
  maker.level(0.1, 0.9, 0.2, 0.8, 0.5);
  maker.level(0.0, 1.0, 0.0, 1.0, 1.0);
  RadiationModel model = lamp_model(maker.mesh(), {1.0, 1.0, true});
  model.optics.at(0).emission_w_m2 = {3.0};
  model.planes.push_back({0.25, 2, 2});
  model.planes.push_back({0.75, 2, 2});
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 1024));
  // Half of what rounding leaves, and what waits for another round, may count as moved.
  const double tolerance_w_m2 = result.bands[0].unshot + 1e-9;
  for (const LayerResult& layer : result.layers) {
    const bool between = layer.height_m > 0.501 && layer.height_m < 0.999;
    if (!between && layer.height_m > 0.499) continue;
    EXPECT_NEAR(layer.down[0].value, 0.0, tolerance_w_m2) << layer.height_m;
    // How many packets leave from which of the lamps is a matter of chance.
    EXPECT_NEAR(layer.up[0].value, between ? 3.0 * 0.8 * 0.6 : 0.0, between ? 5e-3 : tolerance_w_m2) << layer.height_m;
  }
  ASSERT_EQ(result.planes.size(), 2U);
  for (const PlaneResult& plane : result.planes) EXPECT_NEAR(plane.total_down[0].value, 0.0, tolerance_w_m2) << plane.height_m;
}

TEST(Exchange, ViewFactors) {
  const std::vector<FacingPair> pairs = facing_pairs();
  constexpr int seeds = 8;
  ZScores scores(usual_replicates);
  for (const FacingPair& pair : pairs) {
    Estimate exchange[2];
    for (const std::size_t from : {0U, 1U}) {
      const double expected = pair.factor * pair.area_m2[0] / pair.area_m2[from];
      double sum = 0.0;
      double squares = 0.0;
      for (int seed = 1; seed <= seeds; ++seed) {
        const Estimate got = view_factor(pair, from, 2 * static_cast<std::uint64_t>(seed) + from);
        scores.add(got, expected, pair.what);
        sum += got.value;
        squares += got.half_width * got.half_width;
      }
      const Estimate mean{sum / seeds, std::sqrt(squares) / seeds};
      expect_agrees(mean, expected, usual_replicates, 3e-4, 2 * pairs.size(), pair.what);
      exchange[from] = mean.scaled(pair.area_m2[from]);
    }
    expect_same(exchange[0], exchange[1], usual_replicates, 3e-4 * (pair.area_m2[0] + pair.area_m2[1]), pairs.size(),
                "  reciprocity");
  }
  scores.expect_plausible();
}

// Plates that cover the plot are infinite plates. The destination of every packet is certain, so nothing is left to chance.
TEST(Exchange, TwoInfinitePlates) {
  constexpr std::array rows = {PlatePair{0.5, 0.5}, PlatePair{0.12, 0.15}};
  struct Absorbed {
    double lamp, other;
  };
  constexpr std::array absorbed = {Absorbed{0.33333333, 0.66666667}, Absorbed{0.13441955, 0.86558045}};
  for (const double gap_m : {0.02, 1.0, 30.0}) {
    const RadiationModel model = lamp_below_plate(gap_m, rows);
    const RadiationResult result = simulate_soundly(model, fixed_packets(model, 2048, usual_replicates));
    for (std::size_t b = 0; b < rows.size(); ++b) {
      EXPECT_NEAR(result.organs[0].absorbed[b].value, absorbed[b].lamp, 2e-8) << gap_m;
      EXPECT_NEAR(result.organs[1].absorbed[b].value, absorbed[b].other, 2e-8) << gap_m;
      EXPECT_EQ(result.bands[b].ledger.reflected + result.bands[b].ledger.transmitted, 0) << gap_m;
    }
  }
}

// Ignores a packet's own element in every period, including its copies: the mistake that the blind exposes.
class ForgetfulTracer final : public WrappedTracer {
 public:
  ForgetfulTracer(const RadiationModel& model, const Bvh& bvh, CpuTracer& honest) : WrappedTracer(honest), honest_(honest) {
    without_.assign(model.canopy.size(), bvh);
    for (std::uint32_t e = 0; e < without_.size(); ++e) {
      std::erase_if(without_[e].triangles, [e](const BvhTriangle& reference) { return reference.element == e; });
      tracers_.emplace_back(without_[e], tracer_scene(model), CpuWalk::every_element);
    }
  }

  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& /*stop*/) override {
    for (std::size_t k = 0; k < packets.size(); ++k) {
      const bool own = packets[k].element != shared::no_element;
      landings[k] = (own ? tracers_[packets[k].element] : honest_).follow_packet(scene, packets[k], 0);
    }
    return TraceOutcome::finished;
  }

 private:
  CpuTracer& honest_;
  std::vector<Bvh> without_;       // [element], all references except its own
  std::deque<CpuTracer> tracers_;  // [element]
};

// A strip meets itself in the next period just as it would meet another strip there.
TEST(Exchange, StripShadesItsOwnCopies) {
  const RadiationModel one = leaning_strips(1);
  const RadiationModel two = leaning_strips(2);
  const SolveSettings settings = fixed_packets(one, 8192, usual_replicates, 1);
  const RadiationResult got_one = simulate_soundly(one, settings);
  const RadiationResult got_two = simulate_soundly(two, fixed_packets(two, 8192, usual_replicates, 2));
  const BandResult& a = got_one.bands[0];
  const BandResult& b = got_two.bands[0];
  expect_same(a.absorbed_vegetation, b.absorbed_vegetation, usual_replicates, 1e-3, 3, "strips");
  expect_same(a.absorbed_soil, b.absorbed_soil, usual_replicates, 1e-3, 3, "soil");
  expect_same(a.reflected, b.reflected, usual_replicates, 1e-3, 3, "reflected");

  const Prepared prepared(one);
  CpuTracer honest(prepared.bvh, tracer_scene(one));
  ForgetfulTracer forgetful(one, prepared.bvh, honest);
  const BandResult wrong = solve(one, prepared.layout, forgetful, settings, {}).bands[0];
  std::printf("without its own copies: strips %.5f instead of %.5f, reflected %.5f instead of %.5f\n",
              wrong.absorbed_vegetation.value, a.absorbed_vegetation.value, wrong.reflected.value, a.reflected.value);
  const double error = standard_error(a.absorbed_vegetation, usual_replicates);
  EXPECT_GT(std::abs(wrong.absorbed_vegetation.value - a.absorbed_vegetation.value), 20.0 * error);
}

}  // namespace
}  // namespace sunfleck::test
