#pragma once
// The plants of a model and their areas. A plant is its leaves, stems and fruits; pots and lamps with its number are no part of
// it, and plants without vegetation are not listed.

#include "physics/transport/model/exposure.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/surfaces.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sunfleck {

struct PlantAreas {
  static constexpr std::uint32_t no_plant = std::numeric_limits<std::uint32_t>::max();

  PlantAreas(const RadiationModel& model, const Surfaces& surfaces, const BeamExposure& exposure);

  [[nodiscard]] std::size_t size() const { return sites.size(); }

  std::vector<PlantSite> sites;             // [plant], ascending by number
  std::vector<std::uint32_t> of_surface;    // [surface], index into the plants, or no_plant
  std::vector<double> vegetation_m2;        // [plant], one-sided
  std::vector<double> leaf_m2;              // [plant], one-sided
  std::vector<double> facing_leaf_m2;       // [plant], of leaves that the beam can hit
  std::vector<double> height_m;             // [plant], from its lowest to its highest point
  std::vector<bool> beam_meets;             // [plant], the beam can hit some of it
  std::vector<double> largest_absorptance;  // [plant * bands + band], of faces with an area
};

// Returns how many plants have vegetation.
[[nodiscard]] std::size_t count_plants(const RadiationModel& model);

}  // namespace sunfleck
