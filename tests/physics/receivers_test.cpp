// Tests horizontal receivers: maps of the light that comes down through a plane, which agree with the profile to the last
// quantum.
#include "physics/transport/indirect/beam_landings.h"
#include "physics/transport/model/beam_block.h"
#include "support/comparison.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace sunfleck::test {
namespace {

std::uint64_t sum(const std::vector<std::uint64_t>& cells) {
  return std::accumulate(cells.begin(), cells.end(), std::uint64_t{0});
}

std::int64_t sum_band(const PlaneResult& plane, std::size_t bands, std::size_t band) {
  std::int64_t total = 0;
  for (std::size_t k = band; k < plane.down.size(); k += bands) total += plane.down[k];
  return total;
}

// Returns leaves of every orientation, most of which cross the edge of a layer.
RadiationModel leafy(const Plot& plot, bool sky) {
  RadiationModel model = paper_model(random_leaves(60, 0.04, plot, 1.0, 7), plot, beijing_sun());
  model.layers = 10;
  if (!sky) return model;
  model.sky = SkyModel{.kind = SkyKind::overcast};
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.4;
  return model;
}

// Adds planes at the edges of the layers.
void add_edges(RadiationModel& model, const std::vector<int>& edges) {
  const double height_m = make_counter_layout(model).layers.height_m;
  for (const int edge : edges) model.planes.push_back({height_m * edge / model.layers, 9, 14});
}

TEST(Receivers, AgreeWithTheProfileToTheLastQuantum) {
  for (const bool sky : {false, true}) {
    RadiationModel model = leafy({1.0, 1.5, true}, sky);
    const std::vector<int> edges{0, 1, 4, 9, 10};
    add_edges(model, edges);
    const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 2e5, .packets = 4096, .replicates = 16}));
    ASSERT_EQ(result.planes.size(), edges.size());
    for (std::size_t p = 0; p < edges.size(); ++p) {
      const PlaneResult& plane = result.planes[p];
      const LayerResult& layer = result.layers[static_cast<std::size_t>(edges[p])];
      EXPECT_EQ(sum(plane.crossing), result.direct.rays);
      EXPECT_DOUBLE_EQ(plane.sunfleck_ratio.value, layer.sunfleck_ratio.value);
      EXPECT_DOUBLE_EQ(plane.sunfleck_ratio.half_width, layer.sunfleck_ratio.half_width);
      for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_DOUBLE_EQ(plane.total_down[b].value, layer.down[b].value) << edges[p];
        const double per_quantum = result.w_per_quantum[b] / model.plot.area_m2();
        const double beam = static_cast<double>(sum(plane.reached)) * result.ground_per_ray_m2 / model.plot.area_m2();
        const double map = beam * model.bands[b].direct_w_m2 + static_cast<double>(sum_band(plane, 2, b)) * per_quantum;
        EXPECT_NEAR(map, layer.down[b].value, 1e-13) << edges[p];
      }
    }
  }
}

// The light that comes down to the ground is what black soil absorbs, quantum for quantum.
TEST(Receivers, GroundPlaneTakesWhatBlackSoilAbsorbs) {
  for (const bool sky : {false, true}) {
    RadiationModel model = leafy({1.0, 1.5, true}, sky);
    model.soil->reflectance = {0.0, 0.0};
    add_edges(model, {0});
    const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 1e5, .packets = 2048, .replicates = 8}));
    for (std::size_t b = 0; b < 2; ++b) {
      const FluxLedger& ledger = result.bands[b].ledger;
      const std::uint64_t reached = sum(result.planes[0].reached);
      const std::int64_t beam = ledger.absorbed_soil - sum_band(result.planes[0], 2, b);
      EXPECT_EQ(beam % static_cast<std::int64_t>(reached), 0) << b;
      if (!sky) {
        EXPECT_EQ(beam / static_cast<std::int64_t>(reached), ledger.incident / static_cast<std::int64_t>(result.direct.rays));
      }
    }
  }
}

// The soil and the leaves below the plane are black, so all light that passes the plane downwards is absorbed below it.
TEST(Receivers, PlaneTakesWhatIsAbsorbedBelow) {
  MeshMaker maker;
  maker.organ("upper", 1, 1);
  maker.quad({0.1, 0.8, 0.2}, {0.1, 1.0, 0.9}, {0.8, 0.9, 0.8}, {0.7, 0.7, 0.1});
  maker.organ("lower", 1, 2);
  maker.quad({0.3, 0.05, 0.1}, {0.2, 0.45, 0.6}, {0.9, 0.35, 0.7}, {0.8, 0.1, 0.2});
  const Plot plot{1.0, 1.0, true};
  RadiationModel model = paper_model(maker.mesh(), plot, beijing_sun());
  for (FaceOptics& face : model.optics[1].upper) face = {};
  for (FaceOptics& face : model.optics[1].lower) face = {};
  model.soil->reflectance = {0.0, 0.0};
  model.planes = {{0.6, 20, 20}};  // no edge of a layer
  const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 1e5, .packets = 4096, .replicates = 8}));
  for (std::size_t b = 0; b < 2; ++b) {
    const double lower = result.organs[1].absorbed[b].value * result.organs[1].area_m2 / plot.area_m2();
    EXPECT_NEAR(result.planes[0].total_down[b].value, lower + result.bands[b].absorbed_soil.value, 1e-9) << b;
  }
}

TEST(Receivers, EmptyPlotIsInFullSunEverywhere) {
  for (const bool periodic : {true, false}) {
    RadiationModel model = black_model({}, {2.0, 1.0, periodic}, sun_at(35.0, 200.0));
    model.planes = {{0.0, 20, 10}, {0.5, 7, 3}};
    const RadiationResult result = simulate(model, fixed_work(model, 1e5, 8));
    for (const PlaneResult& plane : result.planes) {
      EXPECT_EQ(plane.reached, plane.crossing);
      EXPECT_EQ(plane.sunfleck_ratio.value, 1.0);
      EXPECT_GT(sum(plane.reached), 0U);
    }
  }
}

// Beside and above an isolated stand a plane sees the whole sun and sky, although much of that light meets nothing afterwards.
TEST(Receivers, IsolatedPlanesSeeLightThatMeetsNothing) {
  MeshMaker maker;
  maker.level(0.9, 1.1, 0.9, 1.1, 0.2);
  const Plot plot{2.0, 2.0, false};
  RadiationModel model = black_model(maker.mesh(), plot, sun_at(45.0, 180.0));
  model.bands[0].direct_w_m2 = 300.0;
  model.bands[0].diffuse_w_m2 = 100.0;
  model.sky = SkyModel{.kind = SkyKind::uniform};
  model.planes = {{0.5, 4, 4}, {3.0, 4, 4}};
  const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 1e5, .packets = 16384, .replicates = 8}));
  for (const PlaneResult& plane : result.planes) {
    EXPECT_EQ(plane.sunfleck_ratio.value, 1.0);
    expect_agrees(plane.total_down[0], 400.0, 8, 0.5, 1, "light above a small square");
  }
}

// A square's shadow lies towards (cos az, sin az) / tan el from the square, in X and Z.
TEST(Receivers, ShadowLiesWhereTheSunThrowsIt) {
  const SunPosition sun = sun_at(40.0, 150.0);
  for (const bool periodic : {true, false}) {
    MeshMaker maker;
    maker.level(0.8, 1.2, 0.6, 1.0, 1.5);
    RadiationModel model = black_model(maker.mesh(), {2.0, 2.0, periodic}, sun);
    model.planes = {{0.7, 100, 100}};
    const RadiationResult result = simulate(model, fixed_work(model, 4e6, 8));
    const glm::dvec3 to_sun = direction_to_sun(sun);
    const double below = 0.8 / to_sun.y;
    const glm::dvec2 moved(-to_sun.x * below, -to_sun.z * below);
    const PlaneResult& plane = result.planes[0];
    for (int z = 0; z < 100; ++z) {
      for (int x = 0; x < 100; ++x) {
        const glm::dvec2 lo = glm::dvec2(x, z) * 0.02 - moved;
        // Locates the cell on the square's level, with a margin of one cell on either side.
        const auto part = [&](double at, double from, double to) {
          double best = -1e9;
          for (int image = -2; image <= 2; ++image) {
            const double shifted = at + (periodic ? 2.0 * image : 0.0);
            best = std::max(best, std::min(shifted + 0.02 - from, to - shifted));
          }
          // Above 0.04 the cell lies wholly inside with margin, below -0.02 wholly outside.
          return best;
        };
        const double inside = std::min(part(lo.x, 0.8, 1.2), part(lo.y, 0.6, 1.0));
        const std::size_t cell = static_cast<std::size_t>(x) + 100 * static_cast<std::size_t>(z);
        if (inside > 0.04) {
          EXPECT_EQ(plane.reached[cell], 0U) << x << ' ' << z;
        }
        if (inside < -0.02) {
          EXPECT_EQ(plane.reached[cell], plane.crossing[cell]) << x << ' ' << z;
        }
      }
    }
    const Estimate ratio = plane.sunfleck_ratio;
    if (periodic) expect_agrees(ratio, 1.0 - 0.16 / 4.0, 8, 1e-4, 1, "sunfleck ratio");
  }
}

// A mound of soil, below the plane's height or above it, shades no plane.
TEST(Receivers, SoilElementsShadeNoPlane) {
  MeshMaker maker;
  maker.organ("soil", 0, 0);
  maker.level(0.2, 0.8, 0.2, 0.8, 0.5);
  RadiationModel model = black_model(maker.mesh(), {1.0, 1.0, true}, beijing_sun());
  model.planes = {{0.3, 5, 5}};
  const RadiationResult result = simulate(model, fixed_work(model, 1e5, 8));
  EXPECT_EQ(result.planes[0].reached, result.planes[0].crossing);
}

TEST(Receivers, RaysCountedOneByOneFillTheSameCounters) {
  for (const bool periodic : {true, false}) {
    for (const bool has_soil : {true, false}) {
      RadiationModel model = leafy({1.0, 1.5, periodic}, false);
      if (!has_soil) model.soil.reset();
      model.planes = {{0.25, 4, 4}};
      const Prepared prepared(model);
      CpuTracer tracer(prepared.bvh, tracer_scene(model));
      const shared::BeamBlock beam = make_beam_block(model, prepared.layout, 1e5, 3, 0);
      std::vector<std::uint32_t> at_once(prepared.layout.words());
      std::vector<std::uint32_t> one_by_one(at_once.size());
      ASSERT_EQ(tracer.count_beam(beam, at_once, {}), TraceOutcome::finished);
      const Surfaces surfaces(model);
      const PlaneReceivers planes(model, prepared.layout, surfaces);
      PlaneSums sums(planes, model), recorded_sums(planes, model);
      ASSERT_EQ(count_beam_landings(model, prepared.layout, planes, tracer, beam, one_by_one, sums, {}),
                TraceOutcome::finished);
      EXPECT_EQ(at_once, one_by_one) << periodic << has_soil;
      std::vector<std::uint32_t> in_bundles(at_once.size());
      std::vector<shared::Landing> recorded(std::size_t{beam.columns} * beam.rows);
      ASSERT_EQ(tracer.record_beam(beam, in_bundles, recorded, {}), TraceOutcome::finished);
      add_crossings(model, planes, beam, recorded, recorded_sums);
      EXPECT_EQ(at_once, in_bundles);
      EXPECT_EQ(sums.crossing, recorded_sums.crossing);
      EXPECT_EQ(sums.reached, recorded_sums.reached);
      for (std::size_t k = 0; k < sums.zone_landings.size(); ++k) {
        EXPECT_EQ(sums.zone_landings[k].upper, recorded_sums.zone_landings[k].upper);
        EXPECT_EQ(sums.zone_landings[k].lower, recorded_sums.zone_landings[k].lower);
      }
    }
  }
}

// The map's mean agrees with that of the same map in finer cells: cells are shares of the same plane.
TEST(Receivers, FinerCellsHoldTheSameFlux) {
  RadiationModel coarse = leafy({1.0, 1.5, true}, true);
  coarse.planes = {{0.5, 3, 2}};
  RadiationModel fine = coarse;
  fine.planes = {{0.5, 12, 8}};
  const ScatterWork work{.rays = 1e5, .packets = 4096, .replicates = 8};
  const PlaneResult a = simulate(coarse, fixed_scatter(coarse, work)).planes[0];
  const PlaneResult b = simulate(fine, fixed_scatter(fine, work)).planes[0];
  for (std::size_t cell = 0; cell < 6; ++cell) {
    std::uint64_t reached = 0;
    for (std::size_t z = 0; z < 4; ++z) {
      for (std::size_t x = 0; x < 4; ++x) reached += b.reached[cell % 3 * 4 + x + (cell / 3 * 4 + z) * 12];
    }
    EXPECT_EQ(a.reached[cell], reached);
  }
  EXPECT_EQ(sum_band(a, 2, 0), sum_band(b, 2, 0));
  EXPECT_EQ(sum_band(a, 2, 1), sum_band(b, 2, 1));
}

}  // namespace
}  // namespace sunfleck::test
