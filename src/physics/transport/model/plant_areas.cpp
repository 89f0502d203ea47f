#include "physics/transport/model/plant_areas.h"

#include <algorithm>
#include <map>

namespace sunfleck {

namespace {

struct Span {
  float lo = std::numeric_limits<float>::infinity();
  float hi = -std::numeric_limits<float>::infinity();
};

// Returns the places of the plants with vegetation in the list of sites, by their numbers.
std::map<std::uint32_t, std::uint32_t> list_sites(const RadiationModel& model, const Surfaces& surfaces,
                                                  std::vector<PlantSite>& sites) {
  std::map<std::uint32_t, std::uint32_t> place_of;
  for (const Surface& surface : surfaces.of) {
    if (is_vegetation(surface.role)) place_of.emplace(model.canopy.organs[surface.organ].plant, PlantAreas::no_plant);
  }
  for (const PlantSite& site : model.canopy.plants) {
    const auto found = place_of.find(site.plant);
    if (found == place_of.end()) continue;
    found->second = static_cast<std::uint32_t>(sites.size());
    sites.push_back(site);
  }
  return place_of;
}

}  // namespace

PlantAreas::PlantAreas(const RadiationModel& model, const Surfaces& surfaces, const BeamExposure& exposure) {
  const Canopy& canopy = model.canopy;
  const std::size_t bands = model.bands.size();
  const std::map<std::uint32_t, std::uint32_t> place_of = list_sites(model, surfaces, sites);
  for (const Surface& surface : surfaces.of) {
    const auto found = place_of.find(canopy.organs[surface.organ].plant);
    of_surface.push_back(is_vegetation(surface.role) && found != place_of.end() ? found->second : no_plant);
  }
  for (auto* areas_m2 : {&vegetation_m2, &leaf_m2, &facing_leaf_m2, &height_m}) areas_m2->resize(sites.size());
  beam_meets.resize(sites.size());
  largest_absorptance.resize(sites.size() * bands);
  std::vector<Span> heights(sites.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const std::uint32_t plant = of_surface[surfaces.number_of[e]];
    if (plant == no_plant) continue;
    const double area = area_m2(canopy.corners[e]);
    vegetation_m2[plant] += area;
    if (surfaces.at(e).role == Role::leaf) {
      leaf_m2[plant] += area;
      if (exposure.can_hit(e)) facing_leaf_m2[plant] += area;
    }
    if (exposure.can_hit(e)) beam_meets[plant] = true;
    for (const glm::vec3& corner : canopy.corners[e]) {
      heights[plant].lo = std::min(heights[plant].lo, corner.y);
      heights[plant].hi = std::max(heights[plant].hi, corner.y);
    }
    const SurfaceOptics& optics = model.optics[canopy.optics_of[e]];
    for (std::size_t b = 0; b < bands && area > 0.0; ++b) {
      double& largest = largest_absorptance[plant * bands + b];
      largest = std::max({largest, optics.upper[b].absorptance(), optics.lower[b].absorptance()});
    }
  }
  for (std::size_t p = 0; p < sites.size(); ++p) height_m[p] = double{heights[p].hi} - double{heights[p].lo};
}

std::size_t count_plants(const RadiationModel& model) {
  std::vector<PlantSite> sites;
  static_cast<void>(list_sites(model, Surfaces(model), sites));
  return sites.size();
}

}  // namespace sunfleck
