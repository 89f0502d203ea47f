// Tests plates that cover the plot over soil (B7 of the validation table), surfaces that absorb nothing, many bands, and the
// bias caused by few packets.
#include "programs/validate/known/exchange_scenes.h"
#include "support/error_text.h"
#include "support/scattering.h"
#include "support/wrapped_tracer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr double ask = 1e-4;

// Compares fluxes within the errors that the run reports.
TEST(Plates, FluxesOfOneAndTwoPlates) {
  const std::vector<PlateStack> bands = {par_plates, nir_plates, two_faced_plates};
  constexpr std::size_t comparisons = 21;
  for (const std::size_t count : {1U, 2U}) {
    const RadiationModel model = plates_over_soil(count, bands);
    const RadiationResult result = simulate_soundly(model, fixed_packets(model, 2048, usual_replicates));
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const PlateLight exact = light_on_plates(count, bands[b]);
      const std::string what = fmt::format("{} plates, rho {}", count, bands[b].top.reflectance);
      expect_agrees(result.bands[b].reflected, exact.reflected, usual_replicates, ask, comparisons,
                    (what + ": reflected").c_str());
      expect_agrees(result.bands[b].absorbed_soil, (1.0 - bands[b].soil_reflectance) * exact.on_soil, usual_replicates, ask,
                    comparisons, (what + ": soil").c_str());
      for (std::size_t k = 0; k < exact.down.size(); ++k) {
        expect_agrees(result.organs[k].absorbed[b], absorbed_by_plate(exact, bands[b], k), usual_replicates, ask, comparisons,
                      fmt::format("{}: plate {}", what, k + 1).c_str());
        // No ray of the beam passes the upper plate, but a few more might have.
        const FaceOptics& top = bands[b].top;
        EXPECT_GE(result.organs[k].absorbed[b].half_width, 0.99 * top.absorptance() * result.organs[k].direct[b].half_width);
        const double missed_w = result.organs[k].direct[b].half_width * result.organs[k].area_m2;
        EXPECT_GE(result.plants.front().incident_w[b].half_width, 0.99 * missed_w);
      }
    }
  }
}

// Makes sixty-four small runs. Only the number of packets that leave each side is random, so most fluxes of a run carry the
// same information: one flux of a plate and soil, and three of two plates and soil, count as independent.
TEST(Plates, ReportedErrorsAreTrue) {
  const std::vector<PlateStack> bands = {par_plates, nir_plates};
  ZScores scores(usual_replicates);
  for (const std::size_t count : {1U, 2U}) {
    const RadiationModel model = plates_over_soil(count, bands);
    const Prepared prepared(model);
    const PlateLight exact_par = light_on_plates(count, par_plates);
    const PlateLight exact_nir = light_on_plates(count, nir_plates);
    for (std::uint64_t seed = 1; seed <= 32; ++seed) {
      const RadiationResult result = simulate(model, prepared, fixed_packets(model, 512, usual_replicates, 100 * seed));
      expect_sound(model, result);
      scores.add(result.bands[1].reflected, exact_nir.reflected, "NIR reflected");
      if (count == 1) continue;
      scores.add(result.organs[1].absorbed[1], absorbed_by_plate(exact_nir, nir_plates, 1), "NIR lower plate");
      scores.add(result.bands[0].absorbed_soil, (1.0 - par_plates.soil_reflectance) * exact_par.on_soil, "PAR soil");
    }
  }
  scores.expect_plausible();
}

// Compares D_k and U_k; turning the plates' other face up changes nothing.
TEST(Plates, LightOnBothSides) {
  const std::vector<PlateStack> bands = {par_plates, nir_plates, two_faced_plates};
  for (const SkyFace face : {SkyFace::upper, SkyFace::lower}) {
    const std::size_t top = face == SkyFace::upper ? 0 : 1;
    for (const std::size_t count : {1U, 2U}) {
      const RadiationModel model = plates_over_soil(count, bands, face);
      const SideIrradiance got(model, model.canopy.organ_of, 4096, usual_replicates, 1000);
      for (std::size_t b = 0; b < bands.size(); ++b) {
        const PlateLight exact = light_on_plates(count, bands[b]);
        for (std::size_t k = 0; k < exact.down.size(); ++k) {
          const std::string what = fmt::format("{} plates, rho {}, plate {}", count, bands[b].top.reflectance, k + 1);
          expect_agrees(got.of(k, top, b), exact.down[k], usual_replicates, ask, 60, (what + ": D").c_str());
          expect_agrees(got.of(k, 1 - top, b), exact.up[k], usual_replicates, ask, 60, (what + ": U").c_str());
        }
        expect_agrees(got.of_soil(b), exact.on_soil, usual_replicates, ask, 60, "  on soil");
      }
    }
  }
}

// Scaling each round's packets to the unshot flux is a ratio estimate: this test bounds its bias with few packets.
TEST(Plates, FewPacketsAreUnbiased) {
  constexpr int many = 10000;
  const std::vector<PlateStack> bands = {par_plates, {{0.2, 0.05}, {0.1, 0.3}, 0.1}};
  const RadiationModel model = plates_over_soil(2, bands);
  for (const double packets : {64.0, 1024.0}) {
    SolveSettings settings = fixed_packets(model, packets, many, 5);
    settings.grid_m = fixed_work(model, 256.0 * many).grid_m;
    settings.accuracy.indirect = 3e-3;
    const RadiationResult result = simulate_soundly(model, settings);
    std::printf("%.0f packets a replicate, %.1f with all rounds, %.1f s\n", packets,
                static_cast<double>(result.indirect.packets) / many, result.indirect.seconds);
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const PlateLight exact = light_on_plates(2, bands[b]);
      EXPECT_LT(result.bands[b].unshot, 1e-5);
      expect_agrees(result.bands[b].reflected, exact.reflected, many, ask, 12, "reflected");
      expect_agrees(result.bands[b].absorbed_soil, (1.0 - bands[b].soil_reflectance) * exact.on_soil, many, ask, 12, "soil");
      expect_agrees(result.organs[1].absorbed[b], absorbed_by_plate(exact, bands[b], 1), many, ask, 12, "second plate");
    }
  }
}

// A plate that lets light in but not out, and one that is nearly white: light that is still under way when a loose bound ends the
// run would cross a plane several times, and nothing else makes an error here.
TEST(Plates, UnshotFluxIsInEveryIntervalThatItWouldReach) {
  const std::vector<PlateStack> bands = {{{0.0, 1.0}, {1.0, 0.0}, 0.8}, {{0.5, 0.5}, {0.9, 0.05}, 0.9}};
  RadiationModel model = plates_over_soil(1, bands);
  model.planes.push_back({0.0, 2, 2});
  SolveSettings settings = fixed_packets(model, 2048, usual_replicates);
  settings.accuracy.indirect = 0.02;
  settings.element_errors = ElementErrors::refine;
  const RadiationResult result = simulate_soundly(model, settings);
  const LayerResult& ground = result.layers.front();
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const PlateLight exact = light_on_plates(1, bands[b]);
    const double beam_w_m2 = model.bands[b].direct_w_m2;
    const auto expect_held = [&](const Estimate& got, double truth, const char* what) {
      EXPECT_GT(std::abs(got.value - truth), 1e-5) << what << " of band " << b;
      EXPECT_LE(std::abs(got.value - truth), got.half_width) << what << " of band " << b;
      EXPECT_LE(got.half_width, 3.0 * std::abs(got.value - truth) + 0.01) << what << " of band " << b;
    };
    ASSERT_GT(result.bands[b].unshot, 1e-5);
    expect_held(ground.down[b], exact.on_soil, "light down at the ground");
    expect_held(ground.up[b], exact.up[0], "light up at the ground");
    expect_held(result.planes[0].total_down[b], exact.on_soil, "light through the plane");
    expect_held(result.organs[0].indirect[b], exact.down[0] + exact.up[0] - beam_w_m2, "scattered light on the plate");
    double from_below = 0.0, half_widths = 0.0;
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const double element_m2 = area_m2(model.canopy.corners[e]);
      from_below += result.side_indirect_w_m2(2 * e + 1, element_m2, b) * element_m2;
      half_widths += result.side_error[(2 * e + 1) * bands.size() + b] * element_m2;
    }
    EXPECT_LE(std::abs(from_below - exact.up[0]), half_widths) << "light from below on the triangles of band " << b;
  }
}

// The leaves have rho + tau = 1 and stand over white soil: everything comes back out.
TEST(Plates, NothingIsAbsorbedWhereNothingAbsorbs) {
  RadiationModel model = black_model(random_leaves(60, 0.02, unit_plot, 1.0, 7), unit_plot, beijing_sun());
  const std::vector<FaceOptics> faces = {{0.5, 0.5}, {0.7, 0.3}, {1.0, 0.0}, {0.0, 1.0}, {0.1, 0.9}};
  set_bands(model, faces.size());
  for (std::size_t o = 0; o < model.optics.size(); ++o) set_faces(model, o, faces);
  model.soil->reflectance.assign(faces.size(), 1.0);
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 4096, usual_replicates));
  for (const BandResult& band : result.bands) {
    EXPECT_EQ(band.ledger.absorbed_vegetation, 0) << band.name;
    EXPECT_EQ(band.ledger.absorbed_soil, 0) << band.name;
    EXPECT_EQ(band.ledger.reflected + band.ledger.unshot, band.ledger.incident) << band.name;
    EXPECT_LT(band.unshot, 2e-9) << band.name;
  }
}

RadiationModel twenty_bands(bool periodic) {
  constexpr std::size_t count = 20;
  RadiationModel model = black_model(random_leaves(60, 0.02, unit_plot, 1.0, 7), {1.0, 1.0, periodic}, beijing_sun());
  model.optics.push_back({"lamp", {}, {}, {}});
  model.canopy.optics_names.emplace_back("lamp");
  model.canopy.optics_of[10] = model.canopy.optics_of[11] = static_cast<std::uint16_t>(model.optics.size() - 1);
  set_bands(model, count);
  for (std::size_t b = 0; b < count; ++b) {
    const double share = static_cast<double>(b) / (count - 1);
    for (std::size_t o = 0; o < model.optics.size(); ++o) {
      model.optics[o].upper[b] = {0.9 * share, 0.08 * share};
      model.optics[o].lower[b] = {0.2 * share, 0.3 * (1.0 - share)};
    }
    model.optics.back().emission_w_m2.push_back(b % 3 == 0 ? std::pow(10.0, share * 6.0 - 3.0) : 0.0);
    model.soil->reflectance[b] = 0.5 * (1.0 - share);
    model.bands[b].direct_w_m2 = b % 5 == 4 ? 0.0 : std::pow(10.0, 8.0 * share - 4.0);
  }
  return model;
}

TEST(Plates, LedgerClosesInTwentyBands) {
  for (const bool periodic : {true, false}) {
    RadiationModel model = twenty_bands(periodic);
    const RadiationResult with_soil = simulate_soundly(model, fixed_packets(model, 4096, 8));
    model.soil.reset();
    const RadiationResult without_soil = simulate_soundly(model, fixed_packets(model, 4096, 8));
    for (std::size_t b = 0; b < model.bands.size(); ++b) {
      EXPECT_EQ(with_soil.bands[b].ledger.incident > 0, b % 5 != 4 || b % 3 == 0) << b;
      EXPECT_EQ(without_soil.bands[b].ledger.absorbed_soil, 0) << b;
      if (periodic) {
        EXPECT_EQ(with_soil.bands[b].ledger.transmitted, 0) << b;
      }
    }
  }
}

// Hides where one packet of the last replicate landed.
class LosingTracer final : public WrappedTracer {
 public:
  using WrappedTracer::WrappedTracer;
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override {
    ++replicate_;
    traces_ = 0;
    return WrappedTracer::count_beam(beam, counters, stop);
  }
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override {
    const TraceOutcome outcome = WrappedTracer::trace(scene, packets, landings, stop);
    if (replicate_ == 8 && ++traces_ == 2) landings[landings.size() / 2].surface = shared::lost_on_its_way + 1;
    return outcome;
  }

 private:
  int replicate_ = 0;
  int traces_ = 0;
};

TEST(Plates, OneLostPacketFailsTheRun) {
  const RadiationModel model = plates_over_soil(2, std::array{par_plates, nir_plates});
  const Prepared prepared(model);
  CpuTracer honest(prepared.bvh, tracer_scene(model));
  LosingTracer tracer(honest);
  SolveSettings settings = fixed_packets(model, 1024, 8);
  settings.replicates_at_once = 1;  // the tracer counts replicates, one after the other
  refusal_of([&] { (void)solve(model, prepared.layout, tracer, settings, {}); }, ErrorKind::failure);
}

}  // namespace
}  // namespace sunfleck::test
