// Tests plates that cover the plot over soil (B7 of the validation table), surfaces that absorb nothing, many bands, and the
// bias caused by few packets.
#include "base/error.h"
#include "support/scattering.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr int replicates = 32;
const Plot plot{1.0, 1.0, true};

enum class Facing { up, down };

struct PlateOptics {
  FaceOptics top, bottom;  // for light from above and from below
  double soil;
};
constexpr PlateOptics par{{0.12, 0.06}, {0.12, 0.06}, 0.15};
constexpr PlateOptics nir{{0.45, 0.45}, {0.45, 0.45}, 0.20};
constexpr PlateOptics two_faced{{0.30, 0.10}, {0.05, 0.55}, 0.40};

// Returns plates of the plot's size, the top one first, one organ each.
RadiationModel plates(int count, const std::vector<PlateOptics>& bands, Facing facing = Facing::up) {
  MeshMaker maker;
  for (int k = 0; k < count; ++k) {
    maker.organ("leaf", 1, k + 1);
    const double y_m = 0.37 * (count - k);
    if (facing == Facing::up) {
      maker.level(0.0, 1.0, 0.0, 1.0, y_m);
    } else {
      maker.quad({0.0, y_m, 0.0}, {1.0, y_m, 0.0}, {1.0, y_m, 1.0}, {0.0, y_m, 1.0});
    }
  }
  RadiationModel model = black_model(maker.mesh(), plot, paper_sun());
  set_bands(model, bands.size());
  for (std::size_t b = 0; b < bands.size(); ++b) {
    model.soil->reflectance[b] = bands[b].soil;
    for (SurfaceOptics& optics : model.optics) {
      (facing == Facing::up ? optics.upper : optics.lower)[b] = bands[b].top;
      (facing == Facing::up ? optics.lower : optics.upper)[b] = bands[b].bottom;
    }
  }
  return model;
}

// Solves the plates' own equations for the light down on plate k and up on it from below, by substitution until nothing
// changes.
struct Exact {
  std::vector<double> down, up;  // [plate]
  double reflected = 0.0, on_soil = 0.0;
};
Exact exact_exchange(std::size_t count, const PlateOptics& optics) {
  Exact exact{std::vector<double>(count), std::vector<double>(count)};
  for (int sweep = 0; sweep < 1000; ++sweep) {
    for (std::size_t k = 0; k < count; ++k) {
      exact.down[k] = k == 0 ? 1.0 : optics.top.transmittance * exact.down[k - 1] + optics.bottom.reflectance * exact.up[k - 1];
    }
    exact.on_soil = optics.top.transmittance * exact.down.back() + optics.bottom.reflectance * exact.up.back();
    for (std::size_t k = count; k-- > 0;) {
      exact.up[k] = k + 1 == count ? optics.soil * exact.on_soil
                                   : optics.top.reflectance * exact.down[k + 1] + optics.bottom.transmittance * exact.up[k + 1];
    }
  }
  exact.reflected = optics.top.reflectance * exact.down[0] + optics.bottom.transmittance * exact.up[0];
  return exact;
}

double absorbed(const Exact& exact, const PlateOptics& optics, std::size_t plate) {
  return exact.down[plate] * optics.top.absorptance() + exact.up[plate] * optics.bottom.absorptance();
}

TEST(Plates, EquationsGiveTheTable) {
  EXPECT_NEAR(exact_exchange(1, par).reflected, 0.12054990, 5e-9);
  EXPECT_NEAR(exact_exchange(1, par).up[0], 0.00916497, 5e-9);
  EXPECT_NEAR(exact_exchange(2, par).on_soil, 0.00371980, 5e-9);
  EXPECT_NEAR(absorbed(exact_exchange(2, par), par, 1), 0.05037971, 5e-9);
  EXPECT_NEAR(exact_exchange(1, nir).reflected, 0.49450549, 5e-9);
  EXPECT_NEAR(exact_exchange(2, nir).on_soil, 0.28621908, 5e-9);
  EXPECT_NEAR(absorbed(exact_exchange(2, nir), nir, 0), 0.12862191, 5e-9);
}

constexpr double ask = 1e-4;

// Compares fluxes within the errors that the run reports.
TEST(Plates, FluxesOfOneAndTwoPlates) {
  const std::vector<PlateOptics> bands = {par, nir, two_faced};
  constexpr std::size_t comparisons = 21;
  for (const int count : {1, 2}) {
    const RadiationModel model = plates(count, bands);
    const RadiationResult result = simulate_soundly(model, fixed_packets(model, 2048, replicates));
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const Exact exact = exact_exchange(static_cast<std::size_t>(count), bands[b]);
      const std::string what = fmt::format("{} plates, rho {}", count, bands[b].top.reflectance);
      expect_agrees(result.bands[b].reflected, exact.reflected, replicates, ask, comparisons, (what + ": reflected").c_str());
      expect_agrees(result.bands[b].absorbed_soil, (1.0 - bands[b].soil) * exact.on_soil, replicates, ask, comparisons,
                    (what + ": soil").c_str());
      for (std::size_t k = 0; k < exact.down.size(); ++k) {
        expect_agrees(result.organs[k].absorbed[b], absorbed(exact, bands[b], k), replicates, ask, comparisons,
                      fmt::format("{}: plate {}", what, k + 1).c_str());
      }
    }
  }
}

// Makes sixty-four small runs. Only the number of packets that leave each side is random, so most fluxes of a run carry the
// same information: one flux of a plate and soil, and three of two plates and soil, count as independent.
TEST(Plates, ReportedErrorsAreTrue) {
  const std::vector<PlateOptics> bands = {par, nir};
  ZScores scores(replicates);
  for (const int count : {1, 2}) {
    const RadiationModel model = plates(count, bands);
    const Prepared prepared(model);
    const Exact exact_par = exact_exchange(static_cast<std::size_t>(count), par);
    const Exact exact_nir = exact_exchange(static_cast<std::size_t>(count), nir);
    for (std::uint64_t seed = 1; seed <= 32; ++seed) {
      const RadiationResult result = simulate(model, prepared, fixed_packets(model, 512, replicates, 100 * seed));
      expect_sound(model, result);
      scores.add(result.bands[1].reflected, exact_nir.reflected, "NIR reflected");
      if (count == 1) continue;
      scores.add(result.organs[1].absorbed[1], absorbed(exact_nir, nir, 1), "NIR lower plate");
      scores.add(result.bands[0].absorbed_soil, (1.0 - par.soil) * exact_par.on_soil, "PAR soil");
    }
  }
  scores.expect_plausible();
}

// Compares D_k and U_k; turning the plates' other face up changes nothing.
TEST(Plates, LightOnBothSides) {
  const std::vector<PlateOptics> bands = {par, nir, two_faced};
  for (const Facing facing : {Facing::up, Facing::down}) {
    const std::size_t top = facing == Facing::up ? 0 : 1;
    for (const int count : {1, 2}) {
      const RadiationModel model = plates(count, bands, facing);
      const SideIrradiance got(model, model.canopy.organ_of, 4096, replicates, 1000);
      for (std::size_t b = 0; b < bands.size(); ++b) {
        const Exact exact = exact_exchange(static_cast<std::size_t>(count), bands[b]);
        for (std::size_t k = 0; k < exact.down.size(); ++k) {
          const std::string what = fmt::format("{} plates, rho {}, plate {}", count, bands[b].top.reflectance, k + 1);
          expect_agrees(got.of(k, top, b), exact.down[k], replicates, ask, 60, (what + ": D").c_str());
          expect_agrees(got.of(k, 1 - top, b), exact.up[k], replicates, ask, 60, (what + ": U").c_str());
        }
        expect_agrees(got.of_soil(b), exact.on_soil, replicates, ask, 60, "  on soil");
      }
    }
  }
}

// Scaling each round's packets to the unshot flux is a ratio estimate: this test bounds its bias with few packets.
TEST(Plates, FewPacketsAreUnbiased) {
  constexpr int many = 10000;
  const std::vector<PlateOptics> bands = {par, {{0.2, 0.05}, {0.1, 0.3}, 0.1}};
  const RadiationModel model = plates(2, bands);
  for (const double packets : {64.0, 1024.0}) {
    SolveSettings settings = fixed_packets(model, packets, many, 5);
    settings.grid_m = fixed_work(model, 256.0 * many).grid_m;
    settings.accuracy.indirect = 3e-3;
    const RadiationResult result = simulate_soundly(model, settings);
    std::printf("%.0f packets a replicate, %.1f with all rounds, %.1f s\n", packets,
                static_cast<double>(result.indirect.packets) / many, result.indirect.seconds);
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const Exact exact = exact_exchange(2, bands[b]);
      EXPECT_LT(result.bands[b].unshot, 1e-5);
      expect_agrees(result.bands[b].reflected, exact.reflected, many, ask, 12, "reflected");
      expect_agrees(result.bands[b].absorbed_soil, (1.0 - bands[b].soil) * exact.on_soil, many, ask, 12, "soil");
      expect_agrees(result.organs[1].absorbed[b], absorbed(exact, bands[b], 1), many, ask, 12, "second plate");
    }
  }
}

// The leaves have rho + tau = 1 and stand over white soil: everything comes back out.
TEST(Plates, NothingIsAbsorbedWhereNothingAbsorbs) {
  RadiationModel model = black_model(random_leaves(60, 0.02, plot, 1.0, 7), plot, paper_sun());
  const std::vector<FaceOptics> faces = {{0.5, 0.5}, {0.7, 0.3}, {1.0, 0.0}, {0.0, 1.0}, {0.1, 0.9}};
  set_bands(model, faces.size());
  for (std::size_t o = 0; o < model.optics.size(); ++o) set_faces(model, o, faces);
  model.soil->reflectance.assign(faces.size(), 1.0);
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 4096, replicates));
  for (const BandResult& band : result.bands) {
    EXPECT_EQ(band.ledger.absorbed_vegetation, 0) << band.name;
    EXPECT_EQ(band.ledger.absorbed_soil, 0) << band.name;
    EXPECT_EQ(band.ledger.reflected + band.ledger.unshot, band.ledger.incident) << band.name;
    EXPECT_LT(band.unshot, 2e-9) << band.name;
  }
}

RadiationModel twenty_bands(bool periodic) {
  constexpr std::size_t count = 20;
  RadiationModel model = black_model(random_leaves(60, 0.02, plot, 1.0, 7), {1.0, 1.0, periodic}, paper_sun());
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
class LosingTracer final : public Tracer {
 public:
  LosingTracer(const RadiationModel& model, const Bvh& bvh) : honest_(bvh, tracer_scene(model)) {}
  [[nodiscard]] TracerDevice device() const override { return honest_.device(); }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override {
    ++replicate_;
    traces_ = 0;
    return honest_.count_beam(beam, counters, stop);
  }
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override {
    const TraceOutcome outcome = honest_.trace(scene, packets, landings, stop);
    if (replicate_ == 8 && ++traces_ == 2) landings[landings.size() / 2].surface = shared::lost_on_its_way + 1;
    return outcome;
  }

 private:
  CpuTracer honest_;
  int replicate_ = 0;
  int traces_ = 0;
};

TEST(Plates, OneLostPacketFailsTheRun) {
  const RadiationModel model = plates(2, {par, nir});
  const Prepared prepared(model);
  LosingTracer tracer(model, prepared.bvh);
  SolveSettings settings = fixed_packets(model, 1024, 8);
  settings.replicates_at_once = 1;  // the tracer counts replicates, one after the other
  try {
    (void)solve(model, prepared.layout, tracer, settings, {});
    ADD_FAILURE() << "a packet was lost unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::failure) << error.what();
  }
}

}  // namespace
}  // namespace sunfleck::test
