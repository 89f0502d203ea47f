// Tests the exchange between surfaces that see each other (B2 and B3 of the validation table), and a blind whose strips shade
// their own copies in other periods.
#include "support/scattering.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr int replicates = 32;
constexpr double pi = std::numbers::pi;

// Adds a horizontal rectangle facing down.
void ceiling(MeshMaker& maker, double x0, double x1, double z0, double z1, double y) {
  maker.quad({x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1});
}

// Two surfaces whose upper faces see each other, one organ each.
struct Pair {
  const char* what;
  Mesh mesh;
  std::array<double, 2> area_m2;
  double factor;  // view factor from the first to the second
};

Mesh facing_squares(double gap_m) {
  MeshMaker maker;
  maker.organ("first");
  maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
  maker.organ("second");
  ceiling(maker, 0.0, 1.0, 0.0, 1.0, 0.5 + gap_m);
  return maker.mesh();
}

Mesh floor_and_wall(double height_m) {
  MeshMaker maker;
  maker.organ("first");
  maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
  maker.organ("second");
  maker.quad({0.0, 0.5, 0.0}, {0.0, 0.5 + height_m, 0.0}, {0.0, 0.5 + height_m, 1.0}, {0.0, 0.5, 1.0});
  return maker.mesh();
}

// Returns polygons with the discs' areas. With equal area they differ from discs by about 1.2e-3 of the radius at the rim,
// which changes the view factor only in second order: 1e-6.
Mesh facing_discs(double first_radius_m, double second_radius_m) {
  constexpr int corners = 64;
  MeshMaker maker;
  maker.organ("first");
  maker.polygon({0.5, 0.5, 0.5}, {0.0, 1.0, 0.0}, pi * first_radius_m * first_radius_m, corners);
  maker.organ("second");
  maker.polygon({0.5, 1.5, 0.5}, {0.0, -1.0, 0.0}, pi * second_radius_m * second_radius_m, corners);
  return maker.mesh();
}

// Returns the share of the light emitted by one surface of the pair that lands on the other.
Estimate view_factor(const Pair& pair, std::size_t from, std::uint64_t seed) {
  RadiationModel model = dark_model(pair.mesh, {1.0, 1.0, false});
  model.optics.at(from).emission_w_m2 = {3.0};
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 2048, replicates, seed));
  EXPECT_EQ(result.bands[0].ledger.unshot, 0);
  return absorbed_by_organ(model, result, 1 - from, 0).scaled(model.plot.area_m2() / (3.0 * pair.area_m2[from]));
}

TEST(Exchange, ViewFactors) {
  const std::vector<Pair> pairs = {
      {"parallel squares, gap 1", facing_squares(1.0), {1.0, 1.0}, 0.19982490},
      {"parallel squares, gap 0.5", facing_squares(0.5), {1.0, 1.0}, 0.41525328},
      {"perpendicular squares", floor_and_wall(1.0), {1.0, 1.0}, 0.20004378},
      {"floor, wall of height 2", floor_and_wall(2.0), {1.0, 2.0}, 0.23285260},
      {"equal discs", facing_discs(1.0, 1.0), {pi, pi}, 0.38196601},
      {"disc below one of twice its radius", facing_discs(1.0, 2.0), {pi, 4.0 * pi}, 0.76393202},
  };
  constexpr int seeds = 8;
  ZScores scores(replicates);
  for (const Pair& pair : pairs) {
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
      expect_agrees(mean, expected, replicates, 3e-4, 2 * pairs.size(), pair.what);
      exchange[from] = mean.scaled(pair.area_m2[from]);
    }
    expect_same(exchange[0], exchange[1], replicates, 3e-4 * (pair.area_m2[0] + pair.area_m2[1]), pairs.size(),
                "  reciprocity");
  }
  scores.expect_plausible();
}

// Plates that cover the plot are infinite plates. The destination of every packet is certain, so nothing is left to chance.
TEST(Exchange, TwoInfinitePlates) {
  struct Row {
    double lamp, other;        // reflectances
    double by_lamp, by_other;  // absorbed
  };
  const std::array rows = {Row{0.5, 0.5, 0.33333333, 0.66666667}, Row{0.12, 0.15, 0.13441955, 0.86558045}};
  for (const double gap_m : {0.02, 1.0, 30.0}) {
    MeshMaker maker;
    maker.organ("lamp");
    maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
    maker.organ("other");
    ceiling(maker, 0.0, 1.0, 0.0, 1.0, 0.5 + gap_m);
    RadiationModel model = dark_model(maker.mesh(), {1.0, 1.0, true}, rows.size());
    model.optics[0].emission_w_m2 = {1.0, 1.0};
    for (std::size_t b = 0; b < rows.size(); ++b) {
      model.optics[0].upper[b].reflectance = rows[b].lamp;
      model.optics[1].upper[b].reflectance = rows[b].other;
    }
    const RadiationResult result = simulate_soundly(model, fixed_packets(model, 2048, replicates));
    for (std::size_t b = 0; b < rows.size(); ++b) {
      EXPECT_NEAR(result.organs[0].absorbed[b].value, rows[b].by_lamp, 2e-8) << gap_m;
      EXPECT_NEAR(result.organs[1].absorbed[b].value, rows[b].by_other, 2e-8) << gap_m;
      EXPECT_EQ(result.bands[b].ledger.reflected + result.bands[b].ledger.transmitted, 0) << gap_m;
    }
  }
}

// Returns leaning strips, endless along Z, every half metre.
RadiationModel blind(int strips) {
  const double pitch_m = 0.5;
  MeshMaker maker;
  maker.organ("leaf");
  for (int k = 0; k < strips; ++k) {
    const double x_m = (k + 0.3) * pitch_m;
    maker.quad({x_m, 0.2, 0.0}, {x_m + 0.1, 1.0, 0.0}, {x_m + 0.1, 1.0, 1.0}, {x_m, 0.2, 1.0});
  }
  RadiationModel model = black_model(maker.mesh(), {strips * pitch_m, 1.0, true}, paper_sun());
  set_faces(model, 0, {{0.45, 0.45}});
  model.soil->reflectance = {0.2};
  return model;
}

// Ignores a packet's own element in every period, including its copies: the mistake that the blind exposes.
class ForgetfulTracer final : public Tracer {
 public:
  ForgetfulTracer(const RadiationModel& model, const Bvh& bvh) : honest_(bvh, tracer_scene(model)) {
    without_.assign(model.canopy.size(), bvh);
    for (std::uint32_t e = 0; e < without_.size(); ++e) {
      std::erase_if(without_[e].triangles, [e](const BvhTriangle& reference) { return reference.element == e; });
      tracers_.emplace_back(without_[e], tracer_scene(model), CpuWalk::every_element);
    }
  }

  [[nodiscard]] TracerDevice device() const override { return honest_.device(); }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override {
    return honest_.count_beam(beam, counters, stop);
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
  CpuTracer honest_;
  std::vector<Bvh> without_;        // [element], all references except its own
  std::vector<CpuTracer> tracers_;  // [element]
};

// A strip meets itself in the next period just as it would meet another strip there.
TEST(Exchange, StripShadesItsOwnCopies) {
  const RadiationModel one = blind(1);
  const RadiationModel two = blind(2);
  const SolveSettings settings = fixed_packets(one, 8192, replicates, 1);
  const RadiationResult got_one = simulate_soundly(one, settings);
  const RadiationResult got_two = simulate_soundly(two, fixed_packets(two, 8192, replicates, 2));
  const BandResult& a = got_one.bands[0];
  const BandResult& b = got_two.bands[0];
  expect_same(a.absorbed_vegetation, b.absorbed_vegetation, replicates, 1e-3, 3, "strips");
  expect_same(a.absorbed_soil, b.absorbed_soil, replicates, 1e-3, 3, "soil");
  expect_same(a.reflected, b.reflected, replicates, 1e-3, 3, "reflected");

  const Prepared prepared(one);
  ForgetfulTracer forgetful(one, prepared.bvh);
  const BandResult wrong = solve(one, prepared.layout, forgetful, settings, {}).bands[0];
  std::printf("without its own copies: strips %.5f instead of %.5f, reflected %.5f instead of %.5f\n",
              wrong.absorbed_vegetation.value, a.absorbed_vegetation.value, wrong.reflected.value, a.reflected.value);
  const double error = standard_error(a.absorbed_vegetation, replicates);
  EXPECT_GT(std::abs(wrong.absorbed_vegetation.value - a.absorbed_vegetation.value), 20.0 * error);
}

}  // namespace
}  // namespace sunfleck::test
