#include "bench/stand.h"

#include "physics/canopy/maize.h"

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace sunfleck::bench {
namespace {

// Returns a field as square as the number of plants allows.
MaizeStand field(int plants) {
  MaizeStand stand;
  stand.per_row = static_cast<int>(std::sqrt(static_cast<double>(plants)));
  while (plants % stand.per_row != 0) --stand.per_row;
  stand.rows = plants / stand.per_row;
  return stand;
}

RadiationModel lit_maize(const MaizeStand& stand, Plots plots) {
  const Plot plot{stand.per_row * stand.spacing_in_row_m, stand.rows * stand.spacing_between_rows_m, plots == Plots::endless};
  RadiationModel model = black_model(make_maize(stand), plot, beijing_sun());
  for (SurfaceOptics& optics : model.optics) {
    optics.upper = optics.lower = {FaceOptics{0.12, optics.name == "leaf" ? 0.06 : 0.0}};
  }
  model.soil->reflectance = {0.15};
  return model;
}

}  // namespace

Stand::Stand(int plants, Plots plots) : model(lit_maize(field(plants), plots)), prepared(model) {}

const Stand& stand_of(int plants, Plots plots) {
  static std::map<std::pair<int, Plots>, std::unique_ptr<Stand>> made;
  auto& stand = made[{plants, plots}];
  if (!stand) {
    std::erase_if(made, [](const auto& other) { return other.second && other.second->triangles() > large; });
    auto& fresh = made[{plants, plots}];
    fresh = std::make_unique<Stand>(plants, plots);
    return *fresh;
  }
  return *stand;
}

}  // namespace sunfleck::bench
