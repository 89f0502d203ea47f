#include "physics/transport/model/canopy_areas.h"

#include "physics/transport/model/layer_shares.h"

#include <algorithm>

namespace sunfleck {
namespace {

// What the beam can hit does not depend on the ground that a ray represents.
constexpr double any_ground_m2 = 1.0;

}  // namespace

CanopyAreas::CanopyAreas(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces)
    : CanopyAreas(model, layout, surfaces, BeamExposure(model, layout, any_ground_m2)) {}

CanopyAreas::CanopyAreas(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces,
                         const BeamExposure& exposure)
    : foliage(model.canopy.size()),
      per_m2(model.canopy.size()),
      organ_m2(model.canopy.organs.size()),
      organ_facing_m2(organ_m2),
      organ_open_m2(organ_m2),
      layer_foliage_m2(static_cast<std::size_t>(layout.layers.count)),
      layer_facing_m2(layer_foliage_m2),
      layer_open_foliage_m2(layer_foliage_m2),
      layer_holds_vegetation(layer_foliage_m2.size()),
      layer_holds_structure(layer_foliage_m2.size()),
      on_structures(model.optics.size()),
      organ_absorptance(organ_m2.size() * model.bands.size()),
      vegetation_absorptance(model.bands.size()),
      structure_absorptance(model.bands.size()),
      soil_absorptance(model.bands.size()),
      plants(model, surfaces, exposure) {
  const Canopy& canopy = model.canopy;
  const std::size_t bands = model.bands.size();
  const std::vector<bool> hidden = hidden_elements(model, layout);
  for (std::size_t b = 0; model.soil && b < bands; ++b) soil_absorptance[b] = 1.0 - model.soil->reflectance[b];
  LayerShares shares(layout);
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const Triangle& corners = canopy.corners[e];
    const double area = area_m2(corners);
    if (area > 0.0) per_m2[e] = 1.0 / area;
    const std::size_t organ = canopy.organ_of[e];
    organ_m2[organ] += area;
    if (exposure.can_hit(e)) organ_facing_m2[organ] += area;
    if (!hidden[e]) organ_open_m2[organ] += area;
    const Role role = surfaces.at(e).role;
    const bool soil = role == Role::soil;
    const bool plant = is_vegetation(role);
    foliage[e] = role == Role::leaf;
    if (plant && !hidden[e]) vegetation_m2 += area;
    if (!soil && !plant) on_structures[canopy.optics_of[e]] = true;
    beam_meets_vegetation = beam_meets_vegetation || (plant && exposure.can_hit(e));
    beam_meets_structure = beam_meets_structure || (!plant && !soil && exposure.can_hit(e));
    std::vector<double>& of_role = soil ? soil_absorptance : plant ? vegetation_absorptance : structure_absorptance;
    for (std::size_t b = 0; b < bands && !hidden[e] && area > 0.0; ++b) {
      const SurfaceOptics& optics = model.optics[canopy.optics_of[e]];
      const double absorptance = std::max(optics.upper[b].absorptance(), optics.lower[b].absorptance());
      for (double* largest : {&organ_absorptance[organ * bands + b], &of_role[b]}) {
        *largest = std::max(*largest, absorptance);
      }
    }
    if (!soil && !hidden[e] && area > 0.0) {
      const std::size_t first = first_layer(layout, corners);
      const std::size_t end = layout.end_layer(e, first);
      for (std::size_t k = first; k < end; ++k) (plant ? layer_holds_vegetation : layer_holds_structure)[k] = true;
    }
    if (!foliage[e]) continue;
    foliage_m2 += area;
    add_area_by_layer(layout.layers, corners, layer_foliage_m2);
    if (!hidden[e]) {
      open_foliage_m2 += area;
      shares.visit(e, corners, [&](std::size_t k, double share) { layer_open_foliage_m2[k] += share * area; });
    }
    if (!exposure.can_hit(e)) continue;
    facing_m2 += area;
    add_area_by_layer(layout.layers, corners, layer_facing_m2);
  }
}

}  // namespace sunfleck
