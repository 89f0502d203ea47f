#include "files/results/tables/organ_kinds.h"

#include "physics/transport/model/surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace sunfleck {
namespace {

// The three absorbing terms of the flux balance.
enum class Group { vegetation, structure, soil };

Group group_of(Role role) {
  if (role == Role::soil) return Group::soil;
  return is_vegetation(role) ? Group::vegetation : Group::structure;
}

const Estimate& absorbed_by(const BandResult& band, Group group) {
  if (group == Group::soil) return band.absorbed_soil;
  return group == Group::vegetation ? band.absorbed_vegetation : band.absorbed_structure;
}

// A sum over organs whose errors are taken as independent, W m-2 of ground.
struct OrganSum {
  double value = 0.0, squares = 0.0, unshot = 0.0;

  void add(const Estimate& absorbed, double area_index, double unshot_share) {
    const double flux = absorbed.value * area_index;
    const double half_width = absorbed.half_width * area_index;
    const double its_unshot = std::min(half_width, flux * unshot_share);
    value += flux;
    squares += (half_width - its_unshot) * (half_width - its_unshot);
    unshot += its_unshot;
  }
};

// What the kinds absorb in one band.
class BandOfKinds {
 public:
  BandOfKinds(const RadiationModel& model, const OrganKinds& kinds, const RadiationResult& result, std::size_t band)
      : kinds_(kinds), band_(result.bands[band]), of_kind_(kinds.of.size()), of_group_(3) {
    const double share = band_.ledger.unshot_share();
    for (std::size_t o = 0; o < result.organs.size(); ++o) {
      const OrganResult& organ = result.organs[o];
      const std::size_t kind = kinds.number_of[o];
      const double area_index = organ.area_m2 / model.plot.area_m2();
      of_kind_[kind].add(organ.absorbed[band], area_index, share);
      of_group_[static_cast<std::size_t>(group_of(kinds.of[kind].role))].add(organ.absorbed[band], area_index, share);
    }
  }

  [[nodiscard]] KindFlux absorbed(std::size_t kind) const {
    const Group group = group_of(kinds_.of[kind].role);
    const Estimate& whole = absorbed_by(band_, group);
    const auto in_group = [&](const OrganKind& other) { return group_of(other.role) == group; };
    if (std::count_if(kinds_.of.begin(), kinds_.of.end(), in_group) == 1)
      return {whole, std::min(whole.half_width, band_.unshot)};
    const OrganSum& sum = of_kind_[kind];
    const double squares = of_group_[static_cast<std::size_t>(group)].squares;
    const double of_whole = std::max(0.0, whole.half_width - band_.unshot);
    const double raised = squares > 0.0 ? std::max(1.0, of_whole / std::sqrt(squares)) : 1.0;
    return {{sum.value, raised * std::sqrt(sum.squares) + sum.unshot}, sum.unshot};
  }

 private:
  const OrganKinds& kinds_;
  const BandResult& band_;
  std::vector<OrganSum> of_kind_;   // [kind]
  std::vector<OrganSum> of_group_;  // [group]
};

std::vector<double> organ_areas_m2(const Canopy& canopy) {
  std::vector<double> areas(canopy.organs.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) areas[canopy.organ_of[e]] += area_m2(canopy.corners[e]);
  return areas;
}

}  // namespace

OrganKinds::OrganKinds(const RadiationModel& model)
    : organ_roles(sunfleck::organ_roles(model)), organ_m2(organ_areas_m2(model.canopy)) {
  const std::vector<Role>& roles = organ_roles;
  const std::vector<Organ>& organs = model.canopy.organs;
  std::vector<std::size_t> order(organs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return roles[a] < roles[b]; });
  number_of.resize(organs.size());
  std::map<std::pair<Role, std::string>, std::size_t> numbers;
  for (const std::size_t o : order) {
    const std::string name = roles[o] == Role::soil ? std::string(role_name(Role::soil)) : organs[o].name;
    const auto [at, is_new] = numbers.try_emplace({roles[o], name}, of.size());
    if (is_new) of.push_back({name, roles[o]});
    ++of[at->second].organs;
    of[at->second].area_m2 += organ_m2[o];
    number_of[o] = at->second;
  }
  if (!model.soil) return;
  if (of.empty() || of.back().role != Role::soil) of.push_back({std::string(role_name(Role::soil)), Role::soil});
  if (!(of.back().area_m2 > 0.0)) of.back().area_m2 = model.plot.area_m2();
}

std::vector<KindFlux> absorbed_by_kinds(const RadiationModel& model, const RadiationResult& result) {
  const OrganKinds kinds(model);
  const std::size_t bands = result.bands.size();
  std::vector<KindFlux> absorbed(kinds.of.size() * bands);
  for (std::size_t b = 0; b < bands; ++b) {
    const BandOfKinds band(model, kinds, result, b);
    for (std::size_t k = 0; k < kinds.of.size(); ++k) absorbed[k * bands + b] = band.absorbed(k);
  }
  return absorbed;
}

}  // namespace sunfleck
