#include "programs/validate/exchange_cases.h"

#include "programs/validate/known/case_scenes.h"
#include "programs/validate/known/exchange_scenes.h"
#include "programs/validate/known/known_formulas.h"

#include <fmt/format.h>

#include <array>

namespace sunfleck {
namespace {

// Returns the share of the light emitted by one surface of the pair that lands on the other.
Estimate view_factor(const CaseBench& bench, const FacingPair& pair, std::size_t from) {
  RadiationModel model = lamp_model(pair.mesh, {1.0, 1.0, false});
  model.optics.at(from).emission_w_m2 = {1.0};
  const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 16384));
  return absorbed_by_organ(model, result, 1 - from, 0).scaled(model.plot.area_m2() / pair.area_m2[from]);
}

constexpr std::array stacks = {par_plates, nir_plates, two_faced_plates};
constexpr std::array<const char*, 3> stack_names = {"PAR", "NIR", "faces unlike"};

// Returns the plane halfway between a plate and the next one below it, or the soil.
std::size_t plane_below(const RadiationModel& model, std::size_t count, std::size_t plate) {
  const double between = static_cast<double>(count - plate) - 0.5;  // in steps from the ground
  return static_cast<std::size_t>(between / static_cast<double>(count) * model.layers);
}

void compare_plates(CaseBench& bench, std::size_t count) {
  constexpr Ask ask{.largest_error = 2e-4};
  const RadiationModel model = plates_over_soil(count, stacks);
  const RadiationResult result = bench.simulate(model, case_work(model, 1e5, 8192));
  for (std::size_t b = 0; b < (count == 1 ? 2 : stacks.size()); ++b) {
    const char* const name = stack_names[b];
    const PlateStack& stack = stacks[b];
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
  const RadiationModel model = plates_over_soil(2, stacks, SkyFace::lower);
  const RadiationResult result = bench.simulate(model, case_work(model, 1e5, 8192));
  for (std::size_t b = 1; b < stacks.size(); ++b) {
    const char* const name = stack_names[b];
    const PlateStack& stack = stacks[b];
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
    MeshMaker mesh;
    mesh.organ("strip");
    mesh.quad({0.1, 0.5, 0.0}, {0.1, 1.5, 0.0}, {0.1, 1.5, 1.0}, {0.1, 0.5, 1.0});
    RadiationModel model = lamp_model(mesh.mesh(), {row.gap_m, 1.0, true});
    model.optics[0].emission_w_m2 = {row.gap_m};  // so that 1 W m-2 of ground is emitted
    const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 16384));
    const BandResult& band = result.bands[0];
    bench.compare(fmt::format("strips {:g} apart, from one to the next", row.gap_m), band.absorbed_vegetation, row.factor,
                  {.largest_error = 1e-3});
    bench.compare(fmt::format("strips {:g} apart, upwards", row.gap_m), band.reflected, 0.5 * (1.0 - row.factor),
                  {.largest_error = 1e-3});
  }
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

void view_factor_cases(CaseBench& bench) {
  for (const FacingPair& pair : facing_pairs()) {
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
  constexpr std::array rows = {PlatePair{0.5, 0.5}, PlatePair{0.12, 0.15}};
  const RadiationModel model = lamp_below_plate(1.0, rows);
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
