#include "programs/validate/exchange_cases.h"

#include "programs/validate/case_scenes.h"
#include "programs/validate/known_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace sunfleck {
namespace {

using std::numbers::pi;

// Two surfaces whose upper faces see each other, one organ each.
struct Pair {
  const char* what;
  Mesh mesh;
  std::array<double, 2> area_m2;
  double factor;  // from the first to the second
};

Mesh facing_squares(double gap_m) {
  CaseMesh mesh;
  mesh.organ("first");
  mesh.level(0.0, 1.0, 0.0, 1.0, 0.5);
  mesh.organ("second");
  mesh.ceiling(0.0, 1.0, 0.0, 1.0, 0.5 + gap_m);
  return mesh.mesh();
}

Mesh floor_and_wall(double height_m) {
  CaseMesh mesh;
  mesh.organ("first");
  mesh.level(0.0, 1.0, 0.0, 1.0, 0.5);
  mesh.organ("second");
  mesh.quad({0.0, 0.5, 0.0}, {0.0, 0.5 + height_m, 0.0}, {0.0, 0.5 + height_m, 1.0}, {0.0, 0.5, 1.0});
  return mesh.mesh();
}

// Polygons of the discs' area. At the rim they differ by 1.2e-3 of the radius, which affects the factor only in second order.
Mesh facing_discs(double first_radius_m, double second_radius_m) {
  constexpr int corners = 64;
  CaseMesh mesh;
  mesh.organ("first");
  mesh.polygon({0.5, 0.5, 0.5}, {0.0, 1.0, 0.0}, pi * first_radius_m * first_radius_m, corners);
  mesh.organ("second");
  mesh.polygon({0.5, 1.5, 0.5}, {0.0, -1.0, 0.0}, pi * second_radius_m * second_radius_m, corners);
  return mesh.mesh();
}

// Returns the share of the light emitted by one surface of the pair that lands on the other.
Estimate view_factor(const CaseBench& bench, const Pair& pair, std::size_t from) {
  RadiationModel model = lamp_case(pair.mesh, {1.0, 1.0, false});
  model.optics.at(from).emission_w_m2 = {1.0};
  const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 16384));
  return absorbed_by_organ(model, result, 1 - from, 0).scaled(model.plot.area_m2() / pair.area_m2[from]);
}

constexpr PlateStack par{{0.12, 0.06}, {0.12, 0.06}, 0.15};
constexpr PlateStack nir{{0.45, 0.45}, {0.45, 0.45}, 0.20};
constexpr PlateStack two_faced{{0.30, 0.10}, {0.05, 0.55}, 0.40};
const std::vector<std::pair<const char*, PlateStack>> stacks = {{"PAR", par}, {"NIR", nir}, {"faces unlike", two_faced}};
constexpr double plate_step_m = 0.4;

// Builds plates of the plot's size over soil, the top one first, one organ each; `turned` reverses the order of the corners.
RadiationModel plates_over_soil(std::size_t count, bool turned) {
  CaseMesh mesh;
  for (std::size_t k = 0; k < count; ++k) {
    mesh.organ("leaf", static_cast<int>(k + 1));
    const double y_m = plate_step_m * static_cast<double>(count - k);
    if (turned) mesh.ceiling(0.0, 1.0, 0.0, 1.0, y_m);
    if (!turned) mesh.level(0.0, 1.0, 0.0, 1.0, y_m);
  }
  RadiationModel model = black_case(mesh.mesh(), {1.0, 1.0, true}, beijing_sun());
  set_case_bands(model, stacks.size());
  for (std::size_t b = 0; b < stacks.size(); ++b) {
    const PlateStack& stack = stacks[b].second;
    model.soil->reflectance[b] = stack.soil_reflectance;
    for (SurfaceOptics& optics : model.optics) {
      (turned ? optics.lower : optics.upper)[b] = stack.top;
      (turned ? optics.upper : optics.lower)[b] = stack.bottom;
    }
  }
  return model;
}

// Returns the plane halfway between a plate and the next one below it, or the soil.
std::size_t plane_below(const RadiationModel& model, std::size_t count, std::size_t plate) {
  const double between = static_cast<double>(count - plate) - 0.5;  // in steps from the ground
  return static_cast<std::size_t>(between / static_cast<double>(count) * model.layers);
}

void compare_plates(CaseBench& bench, std::size_t count) {
  constexpr Ask ask{.largest_error = 2e-4};
  const RadiationModel model = plates_over_soil(count, false);
  const RadiationResult result = bench.simulate(model, case_work(model, 1e5, 8192));
  for (std::size_t b = 0; b < (count == 1 ? 2 : stacks.size()); ++b) {
    const char* const name = stacks[b].first;
    const PlateStack& stack = stacks[b].second;
    const PlateLight light = light_on_plates(count, stack);
    const auto row = [&](const std::string& what) {
      return fmt::format("{} plate{}, {}, {}", count, count > 1 ? "s" : "", name, what);
    };
    bench.compare(row("reflected"), result.bands[b].reflected, light.reflected, ask);
    bench.compare(row("absorbed by soil"), result.bands[b].absorbed_soil, (1.0 - stack.soil_reflectance) * light.on_soil, ask);
    for (std::size_t k = 0; k < count; ++k) {
      bench.compare(row(fmt::format("absorbed by plate {}", k + 1)), result.organs[k].absorbed[b],
                    absorbed_by_plate(light, stack, k), ask);
      const LayerResult& plane = result.layers[plane_below(model, count, k)];
      if (k + 1 == count) bench.compare(row(fmt::format("from below on plate {}", k + 1)), plane.up[b], light.up[k], ask);
      if (k + 1 < count)
        bench.compare(row(fmt::format("from above on plate {}", k + 2)), plane.down[b], light.down[k + 1], ask);
    }
  }
}

void compare_turned_plates(CaseBench& bench) {
  constexpr Ask ask{.largest_error = 2e-4};
  const RadiationModel model = plates_over_soil(2, true);
  const RadiationResult result = bench.simulate(model, case_work(model, 1e5, 8192));
  for (std::size_t b = 1; b < stacks.size(); ++b) {
    const auto& [name, stack] = stacks[b];
    const PlateLight light = light_on_plates(2, stack);
    bench.compare(fmt::format("2 plates turned over, {}, reflected", name), result.bands[b].reflected, light.reflected, ask);
    bench.compare(fmt::format("2 plates turned over, {}, absorbed by soil", name), result.bands[b].absorbed_soil,
                  (1.0 - stack.soil_reflectance) * light.on_soil, ask);
  }
}

// Vertical endless strips along Z, one per period: each sees the back of its neighbours, which are its own copies.
void strips_that_face_their_copies(CaseBench& bench) {
  struct Row {
    double gap_m, factor;  // sqrt(1 + g^2) - g for strips of width 1 (Hottel's crossed strings)
  };
  for (const Row& row : {Row{1.0, 0.41421356}, Row{0.25, 0.78077641}}) {
    CaseMesh mesh;
    mesh.organ("strip");
    mesh.quad({0.1, 0.5, 0.0}, {0.1, 1.5, 0.0}, {0.1, 1.5, 1.0}, {0.1, 0.5, 1.0});
    RadiationModel model = lamp_case(mesh.mesh(), {row.gap_m, 1.0, true});
    model.optics[0].emission_w_m2 = {row.gap_m};  // so that 1 W m-2 of ground is emitted
    const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 16384));
    const BandResult& band = result.bands[0];
    bench.compare(fmt::format("strips {:g} apart, from one to the next", row.gap_m), band.absorbed_vegetation, row.factor,
                  {.largest_error = 1e-3});
    bench.compare(fmt::format("strips {:g} apart, upwards", row.gap_m), band.reflected, 0.5 * (1.0 - row.factor),
                  {.largest_error = 1e-3});
  }
}

// Builds leaning strips that scatter, one every half metre.
RadiationModel leaning_strips(int strips) {
  constexpr double pitch_m = 0.5;
  CaseMesh mesh;
  for (int k = 0; k < strips; ++k) {
    const double x_m = (k + 0.3) * pitch_m;
    mesh.quad({x_m, 0.2, 0.0}, {x_m + 0.1, 1.0, 0.0}, {x_m + 0.1, 1.0, 1.0}, {x_m, 0.2, 1.0});
  }
  return leaf_case(mesh.mesh(), {strips * pitch_m, 1.0, true}, beijing_sun(), std::array{nir_band});
}

// A strip meets its own copy in the next period just as it meets a second strip there, so a plot of one strip predicts a plot
// of two.
void one_strip_and_two(CaseBench& bench) {
  const RadiationModel one = leaning_strips(1);
  const RadiationModel two = leaning_strips(2);
  SolveSettings other_seed = case_work(two, 5e5, 8192);
  other_seed.seed = 2;
  const RadiationResult of_two = bench.simulate(two, other_seed);
  const RadiationResult of_one = bench.simulate(one, case_work(one, 5e5, 8192));
  const BandResult& a = of_one.bands[0];
  const BandResult& b = of_two.bands[0];
  bench.compare("one strip in the plot as two, absorbed", a.absorbed_vegetation, b.absorbed_vegetation,
                {.largest_error = 1e-3});
  bench.compare("one strip in the plot as two, soil", a.absorbed_soil, b.absorbed_soil, {.largest_error = 1e-3});
  bench.compare("one strip in the plot as two, reflected", a.reflected, b.reflected, {.largest_error = 1e-3});
}

}  // namespace

// Closed forms as in Howell's catalogue of configuration factors (C-11 parallel squares, C-14 perpendicular, C-41 discs).
void view_factor_cases(CaseBench& bench) {
  const std::vector<Pair> pairs = {
      {"parallel squares, gap 1", facing_squares(1.0), {1.0, 1.0}, 0.19982490},
      {"parallel squares, gap 0.5", facing_squares(0.5), {1.0, 1.0}, 0.41525328},
      {"perpendicular squares", floor_and_wall(1.0), {1.0, 1.0}, 0.20004378},
      {"floor and wall of height 2", floor_and_wall(2.0), {1.0, 2.0}, 0.23285260},
      {"equal discs", facing_discs(1.0, 1.0), {pi, pi}, 0.38196601},
      {"disc below one of twice its radius", facing_discs(1.0, 2.0), {pi, 4.0 * pi}, 0.76393202},
  };
  for (const Pair& pair : pairs) {
    bench.compare(pair.what, view_factor(bench, pair, 0), pair.factor, {.largest_error = 1e-3});
    if (pair.area_m2[0] == pair.area_m2[1]) continue;
    bench.compare(fmt::format("{}, the other way", pair.what), view_factor(bench, pair, 1),
                  pair.factor * pair.area_m2[0] / pair.area_m2[1], {.largest_error = 1e-3});
  }
}

void endless_strip_cases(CaseBench& bench) {
  strips_that_face_their_copies(bench);
  one_strip_and_two(bench);
}

// Plates of the plot's size act as infinite plates. The path of every packet is certain, so no chance is involved.
void parallel_plate_cases(CaseBench& bench) {
  struct Row {
    double lamp, other;  // reflectances; the lamp's plate emits 1
  };
  constexpr std::array rows = {Row{0.5, 0.5}, Row{0.12, 0.15}};
  CaseMesh mesh;
  mesh.organ("lamp");
  mesh.level(0.0, 1.0, 0.0, 1.0, 0.5);
  mesh.organ("other");
  mesh.ceiling(0.0, 1.0, 0.0, 1.0, 1.5);
  RadiationModel model = lamp_case(mesh.mesh(), {1.0, 1.0, true}, rows.size());
  model.optics[0].emission_w_m2 = {1.0, 1.0};
  for (std::size_t b = 0; b < rows.size(); ++b) {
    model.optics[0].upper[b].reflectance = rows[b].lamp;
    model.optics[1].upper[b].reflectance = rows[b].other;
  }
  const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 2048));
  for (std::size_t b = 0; b < rows.size(); ++b) {
    const double from_lamp = 1.0 / (1.0 - rows[b].lamp * rows[b].other);
    const std::string what = fmt::format("reflectances {:g} and {:g}, absorbed by the ", rows[b].lamp, rows[b].other);
    bench.equal(what + "lamp", result.organs[0].absorbed[b].value, (1.0 - rows[b].lamp) * rows[b].other * from_lamp);
    bench.equal(what + "other", result.organs[1].absorbed[b].value, (1.0 - rows[b].other) * from_lamp);
  }
}

// Distinguishes reflectance from transmittance: light that a plate transmits returns from the soil, light that it reflects does
// not.
void plate_over_soil_cases(CaseBench& bench) {
  compare_plates(bench, 1);
  compare_plates(bench, 2);
  compare_turned_plates(bench);
}

}  // namespace sunfleck
