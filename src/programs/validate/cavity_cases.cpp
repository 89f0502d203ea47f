#include "programs/validate/cavity_cases.h"

#include "programs/validate/known/cavity_scenes.h"

#include <fmt/format.h>

#include <array>

namespace sunfleck {

// In a closed box whose walls all emit E and reflect rho, every surface receives E / (1 - rho), including both sides of leaves
// with rho + tau = 1.
void furnace_cases(CaseBench& bench) {
  const RadiationModel model = furnace(furnished_box(3));
  const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 4096));
  // Some of the light leaving a point within the packets' offset from a wall (2^-17 of the extent) slips out past the wall.
  constexpr double slipped = 2e-5;
  double absorbed_by_leaves = 0.0;
  for (std::size_t b = 0; b < furnace_reflectances.size(); ++b) {
    const double even = 1.0 / (1.0 - furnace_reflectances[b]);
    const auto share = [&](std::size_t organ) { return result.organs[organ].indirect[b].scaled(1.0 / even); };
    const Ask ask{.largest_error = 0.01, .tolerance = slipped * even};
    bench.compare(fmt::format("walls reflect {:g}, light on the floor", furnace_reflectances[b]), share(0), 1.0, ask);
    bench.compare(fmt::format("walls reflect {:g}, light on a wall", furnace_reflectances[b]), share(3), 1.0, ask);
    bench.compare(fmt::format("walls reflect {:g}, light on both sides of leaves", furnace_reflectances[b]),
                  share(box_walls).scaled(0.5), 1.0, ask);
    absorbed_by_leaves += result.organs[box_walls].absorbed[b].value;
  }
  bench.equal("absorbed by leaves that absorb nothing", absorbed_by_leaves, 0.0, 1e-12);
}

void cavity_cases(CaseBench& bench) {
  constexpr std::array inside = {0.2, 0.5, 0.8};
  for (const double elevation : {60.0, 15.0}) {
    const Bowl bowl = bowl_under(sun_at(elevation, 40.0), 96, inside);
    const RadiationResult result = bench.simulate(bowl.model, case_work(bowl.model, 5e5, 8192));
    for (std::size_t b = 0; b < inside.size(); ++b) {
      bench.compare(fmt::format("bowl that reflects {:g}, sun {:g} degrees high", inside[b], elevation),
                    result.bands[b].reflected.scaled(bowl.model.plot.area_m2() / bowl.opening_m2),
                    bowl.escaping_share(inside[b]), {.largest_error = 2e-3, .tolerance = 2e-5});
    }
  }
}

}  // namespace sunfleck
