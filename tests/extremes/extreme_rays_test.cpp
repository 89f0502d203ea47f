// Tests rays where arithmetic has no leeway: along edges, through corners, in the planes of boxes, past needles, through
// thousands of periods. Coordinates are multiples of powers of two, so the rays are exactly there.
#include "extremes/tracers.h"
#include "physics/transport/model/beam_block.h"
#include "shared/beam.h"
#include "support/comparison.h"
#include "support/leaf_scenes.h"

#include <fmt/format.h>

#include <array>

namespace sunfleck::test {
namespace {

class ExtremeRays : public EveryTracer {};

// Returns a square of 1 m in cells x cells squares, perpendicular to an axis at `place`.
Mesh gridded_square(int axis, int cells, double place) {
  MeshMaker maker;
  const double step = 1.0 / cells;
  for (int k = 0; k < cells * cells; ++k) {
    const int row = k / cells;
    const double u = step * (k % cells);
    const double v = step * row;
    const auto at = [&](double a, double b) {
      glm::dvec3 point(place);
      point[(axis + 1) % 3] = a;
      point[(axis + 2) % 3] = b;
      return point;
    };
    maker.quad(at(u, v), at(u + step, v), at(u + step, v + step), at(u, v + step));
  }
  return maker.mesh();
}

shared::Packet ray(const glm::vec3& origin, const glm::vec3& direction) {
  return {origin, shared::no_element, direction, 0};
}

bool on_element(const shared::Landing& landing) {
  return landing.surface < shared::landed_on_ground;
}

// Aims at every corner, edge and middle of the cells, from both sides: nothing slips through.
TEST_F(ExtremeRays, MeetTheGridTheyAreAlignedWith) {
  constexpr int cells = 16;
  constexpr int places = 2 * cells + 1;
  for (int axis = 0; axis < 3; ++axis) {
    const RadiationModel model = black_model(gridded_square(axis, cells, 0.5), unit_stand, sun_at(90, 0));
    std::vector<shared::Packet> packets;
    for (int k = 0; k < places * places; ++k) {
      const int row = k / places;
      for (const float side : {0.25F, -0.25F}) {
        glm::vec3 origin(0.5F + side);
        origin[(axis + 1) % 3] = static_cast<float>(k % places) / (2.0F * cells);
        origin[(axis + 2) % 3] = static_cast<float>(row) / (2.0F * cells);
        glm::vec3 direction(0.0F);
        direction[axis] = -side;
        packets.push_back(ray(origin, direction));
      }
    }
    for (const shared::Landing& landing : follow(model, packets)) EXPECT_TRUE(on_element(landing)) << "axis " << axis;
  }
}

// The same holds for soil made of triangles in an endless plot, even on the borders where the period ends.
TEST_F(ExtremeRays, ZenithSunOverGriddedSoil) {
  // With 10 cells, corners are rounded to the plot's grid, in the same way for neighbours.
  for (const int cells : {16, 10}) {
    const RadiationModel model = black_model(gridded_square(1, cells, 0.0), unit_plot, sun_at(90, 0));
    std::vector<shared::Packet> packets;
    const int places = 2 * cells + 1;
    for (int k = 0; k < places * places; ++k) {
      const int row = k / places;
      const float x = static_cast<float>(k % places) / (2.0F * static_cast<float>(cells));
      const float z = static_cast<float>(row) / (2.0F * static_cast<float>(cells));
      for (const float zero : {0.0F, -0.0F}) packets.push_back(ray({x, 0.75F, z}, {zero, -1.0F, zero}));
    }
    for (const shared::Landing& landing : follow(model, packets)) EXPECT_TRUE(on_element(landing)) << cells;
    const RadiationResult result = run(model, fixed_work(model, 5e4, 8));
    EXPECT_EQ(result.bands[0].ledger.absorbed_vegetation, result.bands[0].ledger.incident);
  }
}

// A roof has its ridge along x, and a wall stands beyond it. A ray that starts on the roof and runs exactly along the ridge, an
// eave or a diagonal lies in triangles that cannot stop it. It lands on the wall, or, from the diagonal, on the corner of the
// other slope, which it meets at the ridge's end.
TEST_F(ExtremeRays, LeaveAlongAnEdge) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.quad({0.125, 0.5, 0.25}, {0.125, 0.75, 0.5}, {0.5, 0.75, 0.5}, {0.5, 0.5, 0.25});
  maker.quad({0.125, 0.5, 0.75}, {0.5, 0.5, 0.75}, {0.5, 0.75, 0.5}, {0.125, 0.75, 0.5});
  maker.organ("leaf", 1, 2);
  maker.quad({0.75, 0.0, 0.0}, {0.75, 0.0, 1.0}, {0.75, 1.0, 1.0}, {0.75, 1.0, 0.0});
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const RadiationModel model = black_model(maker.mesh(), plot, sun_at(45, 90));
    std::vector<shared::Packet> packets;
    for (const std::uint32_t element : {0U, 1U, 2U, 3U}) {
      packets.push_back({{0.25F, 0.75F, 0.5F}, element, {1.0F, 0.0F, 0.0F}, 0});       // the ridge
      packets.push_back({{0.25F, 0.5F, 0.25F}, element, {1.0F, 0.0F, 0.0F}, 0});       // an eave
      packets.push_back({{0.25F, 0.5F, 0.75F}, element, {0.5F, -0.0F, 0.0F}, 0});      // the other eave
      packets.push_back({{0.125F, 0.5F, 0.25F}, element, {0.375F, 0.25F, 0.25F}, 0});  // diagonals, from their first corner
      packets.push_back({{0.125F, 0.5F, 0.75F}, element, {0.375F, 0.25F, -0.25F}, 0});
    }
    const std::vector<shared::Landing> landings = follow(model, packets);
    for (std::size_t k = 0; k < landings.size(); ++k) {
      const std::uint32_t landed_on = k % 5 < 3 ? 2 : (k % 5 == 3 ? 1 : 0);  // number of a pair of triangles
      EXPECT_EQ(landings[k].surface / 4, landed_on) << "packet " << k;
    }
  }
}

// An upright leaf reaches through the ground, and a level one lies below. The ground stops light from above, including light that
// starts as far below it as a packet from a leaf that lies in it; light that starts lower meets the level leaf or leaves
// downwards.
TEST_F(ExtremeRays, BelowAnIsolatedPlotMeetNoGround) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.quad({0.5, -0.5, 0.25}, {0.5, -0.5, 0.75}, {0.5, 0.5, 0.75}, {0.5, 0.5, 0.25});
  maker.organ("leaf", 1, 2);
  maker.level(0.0, 0.25, 0.0, 1.0, -0.375);
  const glm::vec3 down{0.0F, -1.0F, 0.0F};
  const glm::vec3 towards_level{-1.0F, -0.75F, 0.0F};
  const RadiationModel model = black_model(maker.mesh(), unit_stand, sun_at(45, 90));
  const shared::GroundMap ground = make_packet_block(model, Prepared(model).layout).ground;
  const std::vector<shared::Landing> landings =
      follow(model, {ray({0.75F, 0.25F, 0.5F}, down), ray({0.75F, ground.y - ground.depth, 0.5F}, down),
                     ray({0.75F, ground.y - 4.0F * ground.depth, 0.5F}, down), ray({0.75F, -0.25F, 0.5F}, down),
                     ray({0.49F, -0.125F, 0.5F}, towards_level), ray({0.75F, -0.25F, 0.5F}, -down)});
  EXPECT_EQ(landings[0].surface, shared::landed_on_ground);
  EXPECT_EQ(landings[1].surface, shared::landed_on_ground);
  EXPECT_EQ(landings[2].surface, shared::left_downwards);
  EXPECT_EQ(landings[3].surface, shared::left_downwards);
  EXPECT_EQ(landings[4].surface / 4, 1U);
  EXPECT_EQ(landings[5].surface, shared::left_upwards);
}

// A leaf below an isolated plot, lit from the side: none of what it scatters comes to the soil, and what it sends downwards is
// transmitted.
TEST_F(ExtremeRays, ALeafBelowAnIsolatedPlotLightsNoSoil) {
  MeshMaker maker;
  maker.quad({0.25, -0.875, 0.875}, {0.75, -0.875, 0.875}, {0.75, -0.25, 0.875}, {0.25, -0.25, 0.875});
  const RadiationModel model = leaf_model(maker.mesh(), unit_stand, sun_at(45, 270), std::array{nir_band});
  const RadiationResult result = run(model, fixed_scatter(model, {.rays = 8e4, .packets = 2000, .replicates = 8}));
  const FluxLedger& ledger = result.bands[0].ledger;
  EXPECT_GT(ledger.absorbed_vegetation, 0);
  EXPECT_GT(ledger.transmitted, 0);
  std::int64_t on_soil = 0;
  for (const std::int64_t quanta : result.cell_indirect) on_soil += quanta;
  EXPECT_EQ(on_soil, 0);
}

// Level needles and slivers side by side, each with its own exact width: they shade their areas.
TEST_F(ExtremeRays, NeedlesShadeTheirArea) {
  constexpr int count = 256;
  for (const double width_m : {0x1p-10, 0x1p-14}) {
    MeshMaker maker;
    for (int k = 0; k < count; ++k) {
      const double x = (k + 0.25) / count;
      maker.triangle({x, 0.5, 0.03125}, {x, 0.5, 0.96875}, {x + width_m, 0.5, 0.03125});
    }
    const double area = count * 0.5 * width_m * 0.9375;
    for (const double elevation : {90.0, 45.0, 1.0}) {
      const RadiationModel model = black_model(maker.mesh(), unit_plot, sun_at(elevation, 33.0));
      const RadiationResult result = run(model, fixed_work(model, 1e5, 16));
      expect_agrees(result.bands[0].absorbed_vegetation, area, 16, 3e-3, 6, fmt::format("needles {} m wide", width_m).c_str());
    }
  }
}

// For each period a ray's height is rounded once, by less than half a unit in its last place. The ray does not drift sideways:
// it enters exactly at the border.
TEST(ExtremeWrap, AHundredThousandPeriodsCostAHundredThousandRoundings) {
  const shared::vec2 period(0.015625F, 0.015625F);
  const shared::vec2 overlap(period.x * 0x1p-19F, period.y * 0x1p-19F);
  for (const double elevation : {0.1, 0.5}) {
    for (const double azimuth : {90.0, 77.0}) {
      const glm::dvec3 to_sun = direction_to_sun(sun_at(elevation, azimuth));
      constexpr float top_y = 3.0F;
      shared::Ray ray = shared::make_ray({0.0F, top_y, 0.0078125F}, glm::vec3(-to_sun));
      double t = 0.0;
      std::uint32_t crossings = 0;
      for (; crossings < 100'000; ++crossings) {
        const shared::Crossing crossing = shared::next_crossing(ray, period, overlap);
        t += crossing.t;
        ray.origin = shared::enter_next_period(ray, crossing, period);
        ASSERT_TRUE(ray.origin.x == 0.0F || ray.origin.x == period.x || ray.origin.z == 0.0F || ray.origin.z == period.y);
        if (ray.origin.y < 0.5F) break;
      }
      const double exact_y = top_y + t * double{ray.direction.y};
      constexpr double half_unit = 0x1p-23;  // for numbers from 2 to 4; each product is rounded far more finely
      EXPECT_LE(std::abs(ray.origin.y - exact_y), crossings * half_unit) << crossings;
      EXPECT_GT(crossings, 10'000U);
    }
  }
}

// An upright strip stands across the sun's way in a plot of 1 cm, below a level strip that covers a tenth of it: rays start 0.2
// m up and cross 11,000 periods. The upright strip takes height / (period * tan elevation) of the light that passes the level
// one. The heights at which rays pass it are rounded to 2^-26 m, a part of its height, and the sun's elevation is rounded with
// them (see README.md).
TEST_F(ExtremeRays, StripAfterTenThousandPeriods) {
  constexpr double period_m = 0.01;
  for (const double elevation : {0.1, 1.0}) {
    const double fall_m = period_m * std::tan(radians(elevation));
    MeshMaker maker;
    maker.organ("leaf", 1, 1);
    maker.level(0.0, period_m, 0.002, 0.003, 0.2);
    maker.organ("leaf", 1, 2);
    const double height_m = 0.5 * fall_m;
    maker.quad({0.005, 0.0, 0.0}, {0.005, 0.0, period_m}, {0.005, height_m, period_m}, {0.005, height_m, 0.0});
    for (const double azimuth : {0.0, 180.0}) {
      const RadiationModel model = black_model(maker.mesh(), {period_m, period_m, true}, sun_at(elevation, azimuth));
      const RadiationResult result = simulate(model, fixed_work(model, 8e3, 16));
      EXPECT_EQ(result.lost_rays, 0U);
      const Estimate strip = share_of_beam(model, result, 1);
      const double rounded = 0x1p-26 / height_m + 0.2 / fall_m * 0x1p-24;
      EXPECT_NEAR(strip.value, 0.45, 0.45 * rounded + table_quantile(4, 16) * standard_error(strip, 16)) << elevation;
      expect_agrees(share_of_beam(model, result, 0), 0.1, 16, 2e-3, 4, "level strip");
    }
  }
}

// The limit on periods counts the rays that it ends: a sun this low over an empty plot of a hair's width needs more than a
// million periods.
TEST_F(ExtremeRays, ARayWithoutEndIsCountedAsLost) {
  MeshMaker maker;
  maker.level(4e-4, 5e-4, 4e-4, 5e-4, 1.0);
  const RadiationModel model = black_model(maker.mesh(), {1e-3, 1e-3, true}, sun_at(0.01, 45.0));
  const std::vector<shared::Packet> packets{ray({2e-4F, 0.999F, 1e-4F}, -glm::vec3(direction_to_sun(*model.sun)))};
  for (const shared::Landing& landing : follow(model, packets)) EXPECT_EQ(landing.surface, shared::lost_on_its_way);
}

}  // namespace
}  // namespace sunfleck::test
