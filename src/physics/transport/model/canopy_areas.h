#pragma once
// The areas of a model by organ and layer, in total and for elements that the beam can hit, and the largest absorptances of
// what light can reach.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/exposure.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/plant_areas.h"
#include "physics/transport/model/surfaces.h"

#include <vector>

namespace sunfleck {

struct CanopyAreas {
  CanopyAreas(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces);

  std::vector<bool> foliage;                  // [element]
  std::vector<double> per_m2;                 // [element], 1 / its area, or 0 without area
  std::vector<double> organ_m2;               // [organ]
  std::vector<double> organ_facing_m2;        // [organ], of elements that the beam can hit
  std::vector<double> organ_open_m2;          // [organ], of elements that light can reach
  std::vector<double> layer_foliage_m2;       // [layer]
  std::vector<double> layer_facing_m2;        // [layer], of foliage that the beam can hit
  std::vector<double> layer_open_foliage_m2;  // [layer], of foliage that light can reach
  // [layer], holds vegetation, or structures or lamps, that light can reach
  std::vector<bool> layer_holds_vegetation, layer_holds_structure;
  std::vector<bool> on_structures;  // [optics], of structures and lamps, which share no optics with vegetation
  double foliage_m2 = 0.0, facing_m2 = 0.0, open_foliage_m2 = 0.0;
  double vegetation_m2 = 0.0;                                        // that light can reach
  bool beam_meets_vegetation = false, beam_meets_structure = false;  // the beam can hit some of it
  std::vector<double> organ_absorptance;                             // [organ * bands + band], the largest of its faces
  // [band], the largest of all such surfaces
  std::vector<double> vegetation_absorptance, structure_absorptance, soil_absorptance;
  PlantAreas plants;

  // Returns whether the beam can hit anything but soil.
  [[nodiscard]] bool beam_meets_canopy() const { return beam_meets_vegetation || beam_meets_structure; }

 private:
  CanopyAreas(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, const BeamExposure& exposure);
};

}  // namespace sunfleck
