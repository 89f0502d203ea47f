#include "programs/validate/beam_cases.h"

#include "programs/validate/known/beam_scenes.h"
#include "programs/validate/known/case_scenes.h"
#include "programs/validate/known/known_formulas.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

constexpr Plot unit_plot{1.0, 1.0, true};

// The irradiance of a single triangle is |n . s| / sin h of the horizontal irradiance, on the side that faces the sun.
void triangle_under_the_sun(CaseBench& bench) {
  struct Row {
    double elevation_deg, azimuth_deg, irradiance, rays;  // a sun nearly parallel to the triangle hits it rarely
  };
  constexpr std::array rows = {Row{90.0, 0.0, 0.83481207, 1e6},     Row{53.0176, 120.569, 0.42046146, 1e6},
                               Row{30.0, 120.569, 0.11818550, 4e6}, Row{15.0, 120.569, 1.21861230, 1e6},
                               Row{5.0, 120.569, 5.45415590, 1e6},  Row{20.0, 270.0, 2.16270157, 1e6}};
  std::uint64_t on_dark_side = 0;
  for (const Row& row : rows) {
    const SunPosition sun = sun_at(row.elevation_deg, row.azimuth_deg);
    const RadiationModel model = triangle_under(sun);
    const RadiationResult result = bench.simulate(model, case_work(model, row.rays));
    bench.compare(fmt::format("triangle, sun {:g} degrees high in {:g}", row.elevation_deg, row.azimuth_deg),
                  result.organs[0].direct[0], row.irradiance, {.largest_error = 0.003 * row.irradiance});
    const double facing = glm::dot(unit_normal(model.canopy.corners[0]), direction_to_sun(sun));
    on_dark_side += facing > 0.0 ? result.elements[0].lower : result.elements[0].upper;
  }
  bench.equal("triangle, rays on the side away from the sun", static_cast<double>(on_dark_side), 0.0, 0.0);
}

// The shadows of horizontal plates are as large as the plates, those of tilted ones area * |n . s| / sin h.
void plates_under_the_sun(CaseBench& bench) {
  const RadiationModel one = level_plate_case();
  const RadiationResult of_one = bench.simulate(one, case_work(one, 4e5));
  bench.compare("sunlit soil beside a level plate's shadow", of_one.bands[0].absorbed_soil, 0.88, {.largest_error = 2e-4});
  bench.compare("sunlit share of that plate", of_one.sunlit_leaf_fraction, 1.0, {.largest_error = 2e-3});

  const RadiationModel model = tilted_plate_case();
  const RadiationResult result = bench.simulate(model, case_work(model, 4e5));
  bench.compare("shadow of a tilted plate", result.bands[0].absorbed_vegetation, 0.0605517934, {.largest_error = 2e-4});

  const RadiationModel both = two_plates_case();
  const RadiationResult of_both = bench.simulate(both, case_work(both, 4e5));
  bench.compare("sunlit share of a plate below a plate", of_both.organs[1].sunlit_fraction, 0.47011006,
                {.largest_error = 2e-3});
  bench.compare("sunlit share of the plate above", of_both.organs[0].sunlit_fraction, 1.0, {.largest_error = 2e-3});
  bench.compare("sunlit soil below both", of_both.bands[0].absorbed_soil, 0.76948351, {.largest_error = 2e-4});
}

void blinds(CaseBench& bench) {
  struct Row {
    double tilt_deg, elevation_deg, azimuth_deg;
  };
  for (const Row& row : {Row{30.0, 40.0, 90.0}, Row{1.0, 2.0, 90.0}}) {
    for (const double beyond : {0.0, 0.9}) {
      const RadiationModel model = blind_under(sun_at(row.elevation_deg, row.azimuth_deg), row.tilt_deg, beyond);
      const RadiationResult result = bench.simulate(model, case_work(model, 4e5));
      const double expected = passed_by_blind(0.8, row.tilt_deg * degree, row.elevation_deg * degree, 1.0);
      bench.compare(fmt::format("blind tilted by {:g}, sun {:g} degrees high{}", row.tilt_deg, row.elevation_deg,
                                beyond > 0.0 ? ", strips longer than the plot" : ""),
                    result.bands[0].absorbed_soil, expected, {.largest_error = 3e-4});
    }
  }
  const RadiationModel closed = blind_under(sun_at(40.0, 270.0), 30.0, 0.0);
  const RadiationResult result = bench.simulate(closed, case_work(closed, 4e5));
  bench.equal("closed blind, quanta on soil", static_cast<double>(result.bands[0].ledger.absorbed_soil), 0.0, 0.0);
}

void checkerboards(CaseBench& bench) {
  for (const auto& [elevation, azimuth] : {std::pair(60.0, 33.0), std::pair(5.0, 200.0)}) {
    const RadiationModel model = checkerboards_under(sun_at(elevation, azimuth));
    const RadiationResult result = bench.simulate(model, case_work(model, 8e5));
    for (std::size_t layer = 0; layer < 3; ++layer) {
      const OrganResult& board = result.organs[layer];
      bench.compare(fmt::format("checkerboard {} of 3, sun {:g} degrees high", layer + 1, elevation),
                    board.direct[0].scaled(board.area_m2 / model.plot.area_m2()), std::ldexp(0.5, -static_cast<int>(layer)),
                    {.largest_error = 3e-4});
    }
    bench.compare(fmt::format("soil below 3 checkerboards, sun {:g} degrees high", elevation), result.bands[0].absorbed_soil,
                  0.125, {.largest_error = 3e-4});
  }
}

// High strips along Z over a narrow plot and others near the ground, with the sun in the south: the share of the lower ones
// that is shaded by the upper ones' copies some 170 periods away.
void far_shadow(CaseBench& bench) {
  constexpr double period_m = 0.1, width_m = 0.05, top_m = 3.0, low_m = 0.01, elevation_deg = 10.0;
  MeshMaker mesh;
  mesh.organ("leaf", 1, 1);
  mesh.level(0.0, width_m, 0.0, 0.3, top_m);
  mesh.organ("leaf", 1, 2);
  mesh.level(0.0, width_m, 0.0, 0.3, low_m);
  const RadiationModel model = black_model(mesh.mesh(), {period_m, 0.3, true}, sun_at(elevation_deg, 180.0));
  const RadiationResult result = bench.simulate(model, case_work(model, 4e5));
  const double tangent = std::tan(elevation_deg * degree);
  const double shift_m = (top_m - low_m) / tangent;
  const double lit = 1.0 - overlap_after_shift(width_m, width_m, period_m, -shift_m) / width_m;
  // Each period rounds a height of up to 3 m to half a unit in its last place.
  const double rounding = shift_m / period_m * std::ldexp(1.0, -23) / tangent / width_m;
  bench.compare("shadow 170 periods from its strip", result.organs[1].sunlit_fraction, lit,
                {.largest_error = 2e-3, .tolerance = rounding});
}

// Builds a strip that casts its shadow across the plot's corner, and the same strip in the plot's middle.
void across_the_corner(CaseBench& bench) {
  for (const bool at_corner : {true, false}) {
    const double middle = at_corner ? 0.0 : 0.5;
    MeshMaker mesh;
    mesh.level(middle - 0.3, middle + 0.2, middle - 0.15, middle + 0.3, 0.7);
    const RadiationModel model = black_model(mesh.mesh(), unit_plot, sun_at(20.0, 215.0));
    const RadiationResult result = bench.simulate(model, case_work(model, 4e5));
    bench.compare(at_corner ? "plate across the plot's corner" : "plate in the plot's middle",
                  result.bands[0].absorbed_vegetation, 0.225, {.largest_error = 2e-4});
  }
}

}  // namespace

void beam_cases(CaseBench& bench) {
  triangle_under_the_sun(bench);
  plates_under_the_sun(bench);
}

void wrap_cases(CaseBench& bench) {
  blinds(bench);
  checkerboards(bench);
  far_shadow(bench);
  across_the_corner(bench);
}

}  // namespace sunfleck
