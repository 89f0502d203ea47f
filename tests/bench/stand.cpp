#include "bench/stand.h"

#include "physics/canopy/maize.h"

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <span>
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

void set_optics(RadiationModel& model) {
  for (SurfaceOptics& optics : model.optics) {
    optics.upper = optics.lower = {FaceOptics{0.12, optics.name == "leaf" ? 0.06 : 0.0}};
  }
  model.soil->reflectance = {0.15};
}

RadiationModel lit_maize(const MaizeStand& stand, Plots plots) {
  const Plot plot{stand.per_row * stand.spacing_in_row_m, stand.rows * stand.spacing_between_rows_m, plots == Plots::endless};
  RadiationModel model = black_model(make_maize(stand), plot, beijing_sun());
  set_optics(model);
  return model;
}

RadiationModel maize_copies(Copies copies) {
  constexpr int per_side = 8;
  constexpr double spacing_m = 0.6;
  PlacedMesh part{make_maize({1, 1, spacing_m, spacing_m, 1}), {}, {}, copies == Copies::shared};
  test::Random random(1);
  for (int k = 0; k < per_side * per_side; ++k) {
    Placement placement;
    const int row = k / per_side;
    placement.position_m = {spacing_m * row, 0.0, spacing_m * (k % per_side)};
    placement.heading_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
    part.placements.push_back(placement);
  }
  const Plot plot{per_side * spacing_m, per_side * spacing_m, true};
  RadiationModel model = black_model(part.mesh, plot, beijing_sun());
  model.canopy = assemble_canopy(std::span(&part, 1), plot);
  set_optics(model);
  return model;
}

}  // namespace

Stand::Stand(int plants, Plots plots) : model(lit_maize(field(plants), plots)), prepared(model) {}

const Stand& stand_of_copies(Copies copies) {
  static std::map<Copies, std::unique_ptr<Stand>> made;
  auto& stand = made[copies];
  if (!stand) stand = std::make_unique<Stand>(maize_copies(copies));
  return *stand;
}

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
