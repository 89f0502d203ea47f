#pragma once
// The area that the sun may shine on although the replicates of a run do not show it.

#include "physics/transport/model/exposure.h"
#include "physics/transport/solve/run_sums.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

class UnseenAreas {
 public:
  // At most `landings` rays are expected on what no ray met, in one replicate. The sums must outlive the object.
  UnseenAreas(const RunSums& sums, double landings) : sums_(sums), landings_(landings) {}

  // Return the largest unseen area of each organ, of the leaves of each plant, of those in each layer, and of all leaves, by
  // unseen_sunlit_m2: of all parts that the beam can hit where the spread of the group's sunlit share says little, or else of those
  // nearer to edge-on than all parts of the group that rays met. A landing there would count for more area than any that the spread
  // knows of.
  [[nodiscard]] std::vector<double> of_organs_m2() const;
  [[nodiscard]] std::vector<double> of_plants_m2() const;
  [[nodiscard]] std::vector<double> of_layers_m2() const;
  [[nodiscard]] double of_leaves_m2() const;

 private:
  template <class Sunlit, class GroupsOf, class AreasOf>
  [[nodiscard]] std::vector<double> of_groups_m2(std::size_t groups, const Sunlit& sunlit, const GroupsOf& groups_of,
                                                 const AreasOf& areas_of) const;
  template <class Sunlit, class GroupsOf>
  [[nodiscard]] std::vector<double> of_groups_m2(std::size_t groups, const Sunlit& sunlit, const GroupsOf& groups_of) const;

  const RunSums& sums_;
  double landings_;
};

}  // namespace sunfleck
