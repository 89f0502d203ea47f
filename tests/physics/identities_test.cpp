// Tests what must hold in every scene (A8 and B14 of the validation table): the beam's flux and the ledger add up, and no
// shift, turn, larger plot or finer mesh changes a result.
#include "support/comparison.h"
#include "support/error_text.h"
#include "support/same_stands.h"
#include "support/wrapped_tracer.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck::test {
namespace {

constexpr double identity_rays = 1e6;

// The sunlit areas, seen along the beam, and the sunlit soil fill the plot.
TEST(Identities, SunlitAreasFillThePlot) {
  for (const double elevation : {90.0, 53.0176, 15.0}) {
    const RadiationModel model = black_model(leafy_stand(), stand_plot, sun_at(elevation, 120.569));
    const RadiationResult result = simulate(model, fixed_work(model, identity_rays, usual_replicates));
    const glm::dvec3 to_sun = direction_to_sun(*model.sun);
    double filled_m2 = result.bands[0].absorbed_soil.value * stand_plot.area_m2();
    double landed_m2 = 0.0;
    // Each leaf is flat, so both of its triangles have its normal.
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const BeamLandings& element = result.elements[e];
      landed_m2 += static_cast<double>(element.upper + element.lower) * result.ground_per_ray_m2;
      if (e % 2 == 1) continue;
      const OrganResult& leaf = result.organs[model.canopy.organ_of[e]];
      filled_m2 += leaf.sunlit_fraction.value * leaf.area_m2 *
                   std::abs(glm::dot(unit_normal(model.canopy.corners[e]), to_sun)) / to_sun.y;
    }
    for (const std::uint64_t cell : result.soil_cells) landed_m2 += static_cast<double>(cell) * result.ground_per_ray_m2;
    EXPECT_NEAR(filled_m2, stand_plot.area_m2(), 1e-5 * stand_plot.area_m2());
    EXPECT_NEAR(landed_m2, stand_plot.area_m2(), 1e-6 * stand_plot.area_m2());
    EXPECT_LE(standard_error(result.bands[0].absorbed_soil, usual_replicates), 2e-4);
  }
}

// Adds bands of every kind: black, leaf-like, all reflected, all transmitted, both together, and without incoming light.
void add_bands(RadiationModel& model) {
  const std::vector<FaceOptics> faces = {{0.0, 0.0}, {0.12, 0.06}, {1.0, 0.0}, {0.0, 1.0}, {0.45, 0.55}, {0.3, 0.3}};
  const std::vector<double> direct_w_m2 = {1.0, 350.0, 1e-12, 1e12, 450.0, 0.0};
  model.bands.clear();
  for (std::size_t b = 0; b < faces.size(); ++b) model.bands.push_back({"band" + std::to_string(b), direct_w_m2[b], 0.0});
  for (SurfaceOptics& optics : model.optics) optics.upper = optics.lower = faces;
  if (model.soil) model.soil->reflectance = {0.0, 0.15, 1.0, 0.5, 1.0, 0.2};
}

void expect_closed(const RadiationModel& model, const RadiationResult& result) {
  for (std::size_t b = 0; b < result.bands.size(); ++b) {
    const BandResult& band = result.bands[b];
    const FluxLedger& ledger = band.ledger;
    EXPECT_EQ(ledger.residual(), 0) << band.name;
    EXPECT_EQ(ledger.incident > 0, model.bands[b].direct_w_m2 > 0.0) << band.name;
    const double sum =
        band.absorbed_vegetation.value + band.absorbed_soil.value + band.reflected.value + band.transmitted.value + band.unshot;
    EXPECT_NEAR(sum, band.incident.value, 1e-12 * band.incident.value) << band.name;
    if (model.plot.periodic) {
      EXPECT_NEAR(band.incident.value, model.bands[b].direct_w_m2, 1e-7 * model.bands[b].direct_w_m2) << band.name;
    }
    // Soil transmits nothing; scattered light passes it only beside an isolated plot.
    if (model.soil && model.plot.periodic) {
      EXPECT_EQ(ledger.transmitted, 0) << band.name;
    }
    if (!model.soil) {
      EXPECT_EQ(ledger.absorbed_soil, 0) << band.name;
      EXPECT_EQ(ledger.transmitted > 0, ledger.incident > 0) << band.name;
    }
  }
  EXPECT_EQ(result.bands[0].ledger.unshot, 0);
  for (const std::size_t conserving : {2U, 3U, 4U}) EXPECT_EQ(result.bands[conserving].ledger.absorbed_vegetation, 0);
  for (const std::size_t white_soil : {2U, 4U}) EXPECT_EQ(result.bands[white_soil].ledger.absorbed_soil, 0);
}

TEST(Identities, LedgerClosesInEveryBand) {
  for (const bool periodic : {true, false}) {
    for (const bool has_soil : {true, false}) {
      RadiationModel model = black_model(leafy_stand(), {stand_plot.size_x_m, stand_plot.size_z_m, periodic}, beijing_sun());
      if (!has_soil) model.soil.reset();
      add_bands(model);
      expect_closed(model, simulate(model, fixed_work(model, 2e5, 8)));
    }
  }
}

// The canopy absorbs the share of the landing light given by the absorptance: 0.82 times the organs' direct and indirect light.
TEST(Identities, AbsorbedIsTheAbsorptanceOfWhatLands) {
  RadiationModel model = black_model(leafy_stand(), stand_plot, beijing_sun());
  add_bands(model);
  const RadiationResult result = simulate(model, fixed_work(model, 2e5, 8));
  double landed = 0.0;
  for (const OrganResult& organ : result.organs) {
    landed += (organ.direct[1].value + organ.indirect[1].value) * organ.area_m2 / stand_plot.area_m2();
  }
  EXPECT_NEAR(result.bands[1].absorbed_vegetation.value, 0.82 * landed, 1e-9 * 350.0);
}

// An isolated stand takes the beam that first meets the stand or the plot's ground: here a plate whose shadow falls partly
// beside the plot (A3's plate, x east: the plot ends where the shadow of 0.4 m width still reaches 0.2187 m further west).
TEST(Identities, IsolatedStandTakesWhatMeetsItOrItsPlot) {
  MeshMaker maker;
  const auto corner = [](double x, double y) { return from_east_north_up(x - 1.0, y - 1.0, 0.8); };
  maker.quad(corner(0.3, 0.35), corner(0.7, 0.35), corner(0.7, 0.65), corner(0.3, 0.65));
  const RadiationModel model = black_model(maker.mesh(), {1.0, 1.0, false}, beijing_sun());
  const RadiationResult result = simulate(model, fixed_work(model, 4e6, usual_replicates));
  const double centre_x = 0.5 - 0.8 * 0.64840851;
  const double in_plot_m2 = (centre_x + 0.2) * 0.3;
  const double incident = 1.0 - in_plot_m2 + 0.12;
  expect_agrees(result.bands[0].incident, incident, usual_replicates, 5e-4, 3, "incident");
  expect_agrees(result.bands[0].absorbed_vegetation, 0.12, usual_replicates, 2e-4, 3, "plate");
  expect_agrees(result.bands[0].absorbed_soil, 1.0 - in_plot_m2, usual_replicates, 3e-4, 3, "soil");
}

void expect_same_aggregates(const RadiationModel& a, const RadiationModel& b, const char* what) {
  const RadiationResult got_a = simulate(a, fixed_work(a, identity_rays, usual_replicates, 1));
  const RadiationResult got_b = simulate(b, fixed_work(b, identity_rays, usual_replicates, 2));
  constexpr std::size_t comparisons = 20;
  expect_same(got_a.bands[0].absorbed_vegetation, got_b.bands[0].absorbed_vegetation, usual_replicates, 3e-4, comparisons,
              what);
  expect_same(got_a.sunlit_leaf_fraction, got_b.sunlit_leaf_fraction, usual_replicates, 3e-3, comparisons, what);
  expect_same(got_a.ground_sunfleck_ratio, got_b.ground_sunfleck_ratio, usual_replicates, 3e-4, comparisons, what);
  EXPECT_NEAR(got_a.leaf_area_index, got_b.leaf_area_index, 1e-6);
}

RadiationModel placed_black_model(const Plot& ground, const SunPosition& sun, const std::vector<Placement>& placements) {
  RadiationModel model = black_model(leafy_stand(), ground, sun);
  place_stand(model, placements);
  return model;
}

TEST(Identities, ShiftOfTheStandChangesNothing) {
  const RadiationModel model = black_model(leafy_stand(), stand_plot, beijing_sun());
  for (const glm::dvec3& shift_m : {glm::dvec3(0.37, 0.0, 1.21), glm::dvec3(-0.5, 0.0, 0.75)}) {
    expect_same_aggregates(model, placed_black_model(stand_plot, beijing_sun(), {{shift_m, 0.0}}), "shifted");
  }
}

TEST(Identities, TurnOfStandAndSunChangesNothing) {
  const SunPosition sun = beijing_sun();
  const RadiationModel model = black_model(leafy_stand(), stand_plot, sun);
  const SunPosition turned_sun{sun.elevation_rad, sun.azimuth_rad + radians(90.0)};
  const Plot turned_plot{stand_plot.size_z_m, stand_plot.size_x_m, true};
  expect_same_aggregates(model, placed_black_model(turned_plot, turned_sun, {{glm::dvec3(0.0), radians(90.0)}}), "turned");
}

TEST(Identities, PlotOfFourCopiesChangesNothing) {
  const RadiationModel model = black_model(leafy_stand(), stand_plot, beijing_sun());
  expect_same_aggregates(
      model, placed_black_model({2 * stand_plot.size_x_m, 2 * stand_plot.size_z_m, true}, beijing_sun(), four_copies()),
      "four copies");
}

TEST(Identities, TrianglesCutInFourChangeNothing) {
  expect_same_aggregates(black_model(leafy_stand(), stand_plot, beijing_sun()),
                         black_model(cut_in_four(leafy_stand()), stand_plot, beijing_sun()), "cut in four");
}

// Changes one counter of the last replicate by one.
class CheatingTracer final : public WrappedTracer {
 public:
  enum class Cheat { drop, invent };
  CheatingTracer(Tracer& honest, Cheat cheat, std::size_t first, std::size_t end)
      : WrappedTracer(honest), cheat_(cheat), first_(first), end_(end) {}

  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override {
    const TraceOutcome outcome = WrappedTracer::count_beam(beam, counters, stop);
    if (++calls_ < 8) return outcome;
    for (std::size_t word = first_; word < end_; ++word) {
      if (counters[word] == 0) continue;
      counters[word] += cheat_ == Cheat::drop ? -1U : 1U;
      ++cheats_;
      break;
    }
    return outcome;
  }
  [[nodiscard]] int cheats() const { return cheats_; }

 private:
  Cheat cheat_;
  std::size_t first_, end_;
  int calls_ = 0;
  int cheats_ = 0;
};

void expect_found_out(const RadiationModel& model, CheatingTracer::Cheat cheat, std::size_t first, std::size_t end) {
  const Prepared prepared(model);
  CpuTracer honest(prepared.bvh, tracer_scene(model));
  CheatingTracer tracer(honest, cheat, first, std::min<std::size_t>(end, prepared.layout.words()));
  SCOPED_TRACE(cheat == CheatingTracer::Cheat::drop ? "a landing is lost" : "a landing is invented");
  refusal_of([&] { (void)solve(model, prepared.layout, tracer, fixed_work(model, 1e4, 8), {}); }, ErrorKind::failure);
  EXPECT_EQ(tracer.cheats(), 1);
}

TEST(Identities, OneLostOrInventedLandingFailsTheRun) {
  constexpr std::size_t all = ~std::size_t{0};
  for (const bool periodic : {true, false}) {
    RadiationModel model = black_model(leafy_stand(), {1.0, 1.5, periodic}, beijing_sun());
    const std::size_t first_bin = Prepared(model).layout.first_bin_word;
    for (const auto cheat : {CheatingTracer::Cheat::drop, CheatingTracer::Cheat::invent}) {
      expect_found_out(model, cheat, shared::counter_first_cell, first_bin);
      expect_found_out(model, cheat, first_bin, all);
      if (!periodic) expect_found_out(model, cheat, shared::counter_met, shared::counter_met + 1);
      if (!periodic) expect_found_out(model, cheat, shared::counter_missed, shared::counter_missed + 1);
      RadiationModel bare = model;
      bare.soil.reset();
      expect_found_out(bare, cheat, shared::counter_transmitted, shared::counter_transmitted + 1);
    }
  }
}

}  // namespace
}  // namespace sunfleck::test
