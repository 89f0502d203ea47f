#include "physics/transport/solve/unseen_areas.h"

#include "physics/transport/model/layer_shares.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sunfleck {

// `sunlit(group)` is the group's share, groups_of(e, give) calls give(group) for the groups of an element, and areas_of(e, give)
// calls give(group, area_m2).
template <class Sunlit, class GroupsOf, class AreasOf>
std::vector<double> UnseenAreas::of_groups_m2(std::size_t groups, const Sunlit& sunlit, const GroupsOf& groups_of,
                                              const AreasOf& areas_of) const {
  std::vector<double> unseen_m2(groups);
  if (!sums_.conversion.model.has_beam()) return unseen_m2;
  const BeamExposure& exposure = sums_.conversion.exposure;
  std::vector<float> met(groups);  // the largest area of a landing
  for (std::size_t e = 0; e < sums_.elements.size(); ++e) {
    if (sums_.elements[e].both() == 0) continue;
    groups_of(e, [&](std::size_t group) { met[group] = std::max(met[group], exposure.lit_m2_per_landing(e)); });
  }
  std::vector<std::vector<FacingArea>> parts(groups);
  for (std::size_t e = 0; e < sums_.elements.size(); ++e) {
    if (!exposure.can_hit(e)) continue;
    const float of_landing_m2 = exposure.lit_m2_per_landing(e);
    const bool is_met = sums_.elements[e].both() > 0;
    const auto is_unseen = [&](std::size_t group) {
      return sunlit(group).says_little() || (!is_met && of_landing_m2 > met[group]);
    };
    bool any = false;
    groups_of(e, [&](std::size_t group) { any = any || is_unseen(group); });
    if (!any) continue;
    areas_of(e, [&](std::size_t group, double part_m2) {
      if (is_unseen(group)) parts[group].push_back({part_m2, of_landing_m2});
    });
  }
  for (std::size_t group = 0; group < groups; ++group) {
    unseen_m2[group] = unseen_sunlit_m2(std::move(parts[group]), landings_);
  }
  return unseen_m2;
}

// Each element belongs to a group as a whole.
template <class Sunlit, class GroupsOf>
std::vector<double> UnseenAreas::of_groups_m2(std::size_t groups, const Sunlit& sunlit, const GroupsOf& groups_of) const {
  return of_groups_m2(groups, sunlit, groups_of, [&](std::size_t e, const auto& give) {
    groups_of(e, [&](std::size_t group) { give(group, area_m2(sums_.conversion.model.canopy.corners[e])); });
  });
}

std::vector<double> UnseenAreas::of_organs_m2() const {
  const auto sunlit = [&](std::size_t organ) -> const ReplicateMean& { return sums_.organs[organ].sunlit; };
  const auto groups_of = [&](std::size_t e, const auto& give) { give(sums_.conversion.model.canopy.organ_of[e]); };
  return of_groups_m2(sums_.organs.size(), sunlit, groups_of);
}

std::vector<double> UnseenAreas::of_plants_m2() const {
  const CanopyAreas& areas = sums_.conversion.areas;
  const auto sunlit = [&](std::size_t plant) -> const ReplicateMean& { return sums_.plants[plant].sunlit; };
  const auto groups_of = [&](std::size_t e, const auto& give) {
    const std::uint32_t plant = areas.plants.of_surface[sums_.conversion.surfaces.number_of[e]];
    if (areas.foliage[e] && plant != PlantAreas::no_plant) give(plant);
  };
  return of_groups_m2(sums_.plants.size(), sunlit, groups_of);
}

std::vector<double> UnseenAreas::of_layers_m2() const {
  const Conversion& conversion = sums_.conversion;
  const auto sunlit = [&](std::size_t layer) -> const ReplicateMean& { return sums_.layers[layer].sunlit; };
  const auto groups_of = [&](std::size_t e, const auto& give) {
    const std::size_t first = first_layer(conversion.layout, conversion.model.canopy.corners[e]);
    for (std::size_t k = first; conversion.areas.foliage[e] && k < conversion.layout.end_layer(e, first); ++k) give(k);
  };
  LayerShares shares(conversion.layout);
  const auto areas_of = [&](std::size_t e, const auto& give) {
    const Triangle corners = conversion.model.canopy.corners[e];
    shares.visit(e, corners, [&](std::size_t k, double share) { give(k, share * area_m2(corners)); });
  };
  return of_groups_m2(conversion.areas.layer_foliage_m2.size(), sunlit, groups_of, areas_of);
}

double UnseenAreas::of_leaves_m2() const {
  const auto sunlit = [&](std::size_t) -> const ReplicateMean& { return sums_.sunlit; };
  const auto groups_of = [&](std::size_t e, const auto& give) {
    if (sums_.conversion.areas.foliage[e]) give(0);
  };
  return of_groups_m2(1, sunlit, groups_of).front();
}

}  // namespace sunfleck
