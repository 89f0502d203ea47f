// Tests that copies which share one tree receive the light that they receive with triangles of their own.

#include "support/copies.h"
#include "support/comparison.h"
#include "support/leaf_scenes.h"
#include "support/scattering.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunfleck::test {
namespace {

// Returns a packet that starts on an element, as the solver starts it.
shared::Packet packet_from(const RadiationModel& model, std::uint32_t element, glm::dvec2 weights, const glm::vec3& direction) {
  const Triangle corners = model.canopy.corners[element];
  const glm::dvec3 a(corners[0]);
  glm::dvec3 at = a + (glm::dvec3(corners[1]) - a) * weights.x + (glm::dvec3(corners[2]) - a) * weights.y;
  shared::Packet packet{{}, element, direction, 0};
  if (model.plot.periodic) {
    const glm::dvec2 periods(std::floor(at.x / model.canopy.period_m.x), std::floor(at.z / model.canopy.period_m.y));
    at -= glm::dvec3(periods.x * model.canopy.period_m.x, 0.0, periods.y * model.canopy.period_m.y);
    packet.image = pack_image(-static_cast<int>(periods.x), -static_cast<int>(periods.y));
  }
  packet.origin = at;
  return packet;
}

struct FollowedModel {
  explicit FollowedModel(RadiationModel given)
      : model(std::move(given)),
        prepared(model),
        block(make_packet_block(model, prepared.layout)),
        tracer(prepared.bvh, tracer_scene(model)) {}

  [[nodiscard]] std::uint32_t surface_met(const shared::Packet& packet) const {
    return tracer.follow_packet(block, packet, 0).surface;
  }

  RadiationModel model;
  Prepared prepared;
  shared::PacketBlock block;
  CpuTracer tracer;
};

// Both trees agree on every ray except for those that pass within a few roundings of an edge or meet two leaves at once: moved
// by 2 micrometres, such a ray meets with the flat tree what it met with the shared one.
void expect_same_hits(const CopiesStand& stand) {
  const FollowedModel flat(stand_of_copies(stand, false));
  const FollowedModel shared(stand_of_copies(stand, true));
  ASSERT_TRUE(flat.prepared.bvh.copies.empty());
  ASSERT_FALSE(shared.prepared.bvh.copies.empty());
  ASSERT_EQ(flat.model.canopy.size(), shared.model.canopy.size());
  Random random(stand.seed);
  constexpr int rays = 20'000;
  int on_leaves = 0, apart = 0, unexplained = 0;
  for (int k = 0; k < rays; ++k) {
    const auto element = static_cast<std::uint32_t>(random.uniform() * static_cast<double>(flat.model.canopy.size()));
    const glm::dvec2 weights(random.uniform(0.0, 0.5), random.uniform(0.0, 0.5));
    const glm::vec3 direction = inclined(std::acos(random.uniform(-1.0, 1.0)), random.uniform(0.0, 2.0 * std::numbers::pi));
    const std::uint32_t expected = flat.surface_met(packet_from(flat.model, element, weights, direction));
    const std::uint32_t got = shared.surface_met(packet_from(shared.model, element, weights, direction));
    on_leaves += expected < shared::landed_on_ground ? 1 : 0;
    if (got == expected) continue;
    ++apart;
    bool explained = false;
    for (int nearby = 0; nearby < 64 && !explained; ++nearby) {
      shared::Packet moved = packet_from(flat.model, element, weights, direction);
      for (int axis = 0; axis < 3; ++axis) moved.origin[axis] += static_cast<float>(random.uniform(-2e-6, 2e-6));
      explained = flat.surface_met(moved) == got;
    }
    unexplained += explained ? 0 : 1;
  }
  std::printf("%d of %d rays on leaves; %d met something else, %d of them far from an edge\n", on_leaves, rays, apart,
              unexplained);
  EXPECT_GT(on_leaves, rays / 3);
  EXPECT_LE(apart, rays / 1000);
  EXPECT_EQ(unexplained, 0);
}

TEST(Copies, MeetTheRaysThatTheirOwnTrianglesMeet) {
  for (const Plot& plot : {unit_plot, unit_stand, Plot{0.35, 0.8, true}}) {
    for (const bool of_all_sizes : {false, true}) expect_same_hits({plot, 12, of_all_sizes, 5});
    expect_same_hits({plot, 12, true, 7, 300});
  }
}

// Corners differ by the rounding of single precision and, in a periodic plot, by whole periods.
TEST(Copies, StandWhereTheirOwnTrianglesStand) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const Canopy flat = stand_of_copies({plot}, false).canopy;
    const Canopy shared = stand_of_copies({plot}, true).canopy;
    ASSERT_EQ(flat.size(), shared.size());
    EXPECT_EQ(flat.organ_of, shared.organ_of);
    EXPECT_EQ(flat.optics_of, shared.optics_of);
    EXPECT_EQ(flat.plants, shared.plants);
    for (std::size_t e = 0; e < flat.size(); ++e) {
      for (std::size_t k = 0; k < 3; ++k) {
        glm::dvec3 apart = glm::dvec3(shared.corners[e][k]) - glm::dvec3(flat.corners[e][k]);
        if (plot.periodic) {
          apart.x -= std::round(apart.x / flat.period_m.x) * flat.period_m.x;
          apart.z -= std::round(apart.z / flat.period_m.y) * flat.period_m.y;
        }
        EXPECT_LE(glm::length(apart), 1e-6) << e;
      }
    }
  }
}

TEST(Copies, ReceiveWhatTheirOwnTrianglesReceive) {
  double squares = 0.0;
  int comparisons = 0;
  for (std::uint32_t scene = 0; scene < 12; ++scene) {
    CopiesStand stand;
    stand.plot = scene % 3 == 0 ? unit_stand : scene % 3 == 1 ? unit_plot : Plot{0.5, 0.9, true};
    stand.plants = 4 + static_cast<int>(scene % 5) * 3;
    stand.of_all_sizes = scene % 2 == 0;
    stand.seed = 10 + scene;
    RadiationModel flat = stand_of_copies(stand, false);
    RadiationModel shared = stand_of_copies(stand, true);
    const bool overcast = scene % 4 == 3;
    if (overcast) {
      shine_from_sky(flat, {});
      shine_from_sky(shared, {});
    }
    constexpr int replicates = 12;
    ScatterWork work{.rays = 2e4, .packets = 1e3, .replicates = replicates, .seed = 2 * scene + 1};
    const RadiationResult expected = simulate(flat, fixed_scatter(flat, work));
    ++work.seed;
    const RadiationResult got = simulate(shared, fixed_scatter(shared, work));
    const auto compare = [&](const Estimate& a, const Estimate& b, const char* what) {
      const double error = std::hypot(standard_error(a, replicates), standard_error(b, replicates));
      const double z = (b.value - a.value) / error;
      squares += z * z;
      ++comparisons;
      EXPECT_LE(std::abs(z), table_quantile(12 * 7, replicates)) << what << " of scene " << scene;
    };
    EXPECT_EQ(got.lost_rays, 0U);
    if (!overcast) compare(expected.sunlit_leaf_fraction, got.sunlit_leaf_fraction, "sunlit share");
    for (std::size_t b = 0; b < 2; ++b) {
      EXPECT_EQ(got.bands[b].ledger.residual(), 0);
      compare(expected.bands[b].absorbed_vegetation, got.bands[b].absorbed_vegetation, "absorbed by vegetation");
      compare(expected.bands[b].absorbed_soil, got.bands[b].absorbed_soil, "absorbed by soil");
      compare(expected.bands[b].reflected, got.bands[b].reflected, "reflected");
    }
    EXPECT_NEAR(got.leaf_area_index, expected.leaf_area_index, 1e-5 * expected.leaf_area_index);
  }
  std::printf("z has a root mean square of %.2f in %d comparisons\n", std::sqrt(squares / comparisons), comparisons);
  EXPECT_LE(squares / comparisons, 1.5);
}

// The layers hold what the whole canopy absorbs, though copies of different size and height reach into different ones.
TEST(Copies, AreCountedInTheirOwnLayers) {
  const RadiationModel model = stand_of_copies({unit_plot, 10, true, 3}, true);
  const RadiationModel flat = stand_of_copies({unit_plot, 10, true, 3}, false);
  const SolveSettings settings = fixed_scatter(model, {.rays = 4e5, .packets = 4e3});
  const RadiationResult got = simulate_soundly(model, settings);
  const RadiationResult expected = simulate_soundly(flat, settings);
  for (std::size_t b = 0; b < 2; ++b) {
    double in_layers = 0.0;
    for (std::size_t k = 0; k + 1 < got.layers.size(); ++k) in_layers += got.layers[k].absorbed[b].value;
    EXPECT_NEAR(in_layers, got.bands[b].absorbed_vegetation.value, 1e-6);
    for (std::size_t k = 0; k + 1 < got.layers.size(); ++k) {
      const double error = std::hypot(standard_error(got.layers[k].absorbed[b], usual_replicates),
                                      standard_error(expected.layers[k].absorbed[b], usual_replicates));
      EXPECT_LE(std::abs(got.layers[k].absorbed[b].value - expected.layers[k].absorbed[b].value), 4.0 * error + rounding) << k;
    }
  }
}

// No light leaves a closed box of any size and heading, and where one wall glows all light is even after the first landing.
TEST(Copies, OfAClosedBoxKeepTheirLight) {
  MeshMaker maker;
  constexpr double half_m = 0.2;
  const std::array<glm::dvec3, 8> at = {{{-half_m, 0.0, -half_m},
                                         {half_m, 0.0, -half_m},
                                         {half_m, 0.0, half_m},
                                         {-half_m, 0.0, half_m},
                                         {-half_m, 0.4, -half_m},
                                         {half_m, 0.4, -half_m},
                                         {half_m, 0.4, half_m},
                                         {-half_m, 0.4, half_m}}};
  const std::array<std::array<int, 4>, 6> walls = {
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  for (const auto& wall : walls) {
    maker.organ(maker.mesh().organs.empty() ? "lamp" : "wall" + std::to_string(maker.mesh().organs.size()));
    maker.quad(at[static_cast<std::size_t>(wall[0])], at[static_cast<std::size_t>(wall[1])],
               at[static_cast<std::size_t>(wall[2])], at[static_cast<std::size_t>(wall[3])]);
  }
  std::vector<Placement> placements;
  for (int k = 0; k < 5; ++k) placements.push_back({{1.0 * k, 0.1 * k, 0.5}, 0.4 * k, 0.6 + 0.2 * k});
  for (const bool periodic : {false, true}) {
    const Plot plot{5.0, 1.0, periodic};
    const PlacedMesh part{maker.mesh(), placements, {}, true};
    RadiationModel model = lamp_model({}, plot);
    model.canopy = assemble_canopy(std::span(&part, 1), plot);
    for (const std::string& name : model.canopy.optics_names) model.optics.push_back({name, {}, {}, {}, {}});
    set_bands(model, 1);
    for (SurfaceOptics& optics : model.optics) optics.upper[0] = optics.lower[0] = {0.6, 0.0};
    model.optics[0].emission_w_m2 = {1.0};
    const RadiationResult result = simulate_soundly(model, fixed_packets(model, 16384, usual_replicates));
    const FluxLedger& ledger = result.bands[0].ledger;
    EXPECT_EQ(ledger.residual(), 0);
    EXPECT_LE(static_cast<double>(ledger.reflected + ledger.transmitted), 1e-4 * static_cast<double>(ledger.incident));
  }
}

}  // namespace
}  // namespace sunfleck::test
