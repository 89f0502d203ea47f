#pragma once
// Sums over several lights of one simulation, such as the steps of a date. The lights share packets, so that their errors are
// correlated: the error of a sum follows from the spread of its value between replicates. So does the error of a sum over organs.

#include "physics/transport/model/lights.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/statistics.h"
#include "physics/transport/solve/run_sums.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace sunfleck {

class JointSums {
 public:
  // Each organ has a group, or there are none. `like` are the sums of any of the lights.
  JointSums(LightSum sum, std::span<const std::size_t> group_of_organ, const RunSums& like);

  // Adds the replicate that was added last to the sums of all lights.
  void add(std::span<const std::unique_ptr<RunSums>> lights);

  // Returns the half-widths. Where all replicates agree, they are the sums of those of the lights, [light].
  [[nodiscard]] JointErrors errors(double t_quantile, std::span<const RadiationResult> lights) const;

  // Passes to `archive` everything that other sums of the same lights need to continue.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.means_.bands, self.means_.organs, self.means_.plants, self.means_.groups, self.means_.planes);
  }

 private:
  // A value for each figure, in the order of JointErrors; those of the bands are [band * terms + term].
  template <class Value>
  struct Figures {
    std::vector<Value> bands, organs, plants, groups, planes;
  };

  template <class AddLight>
  [[nodiscard]] Figures<double> weighted(const AddLight& add_light) const;
  [[nodiscard]] Figures<double> last_values(std::span<const std::unique_ptr<RunSums>> lights) const;
  [[nodiscard]] Figures<double> half_widths(std::span<const RadiationResult> lights) const;
  // Sums what the organs of each group have, per area of organ, to what the group has per area of ground.
  [[nodiscard]] std::vector<double> grouped(const std::vector<double>& organs) const;

  LightSum sum_;
  std::vector<std::size_t> group_of_organ_;
  std::size_t groups_ = 0, bands_;
  std::vector<double> organ_area_index_;  // [organ], area per area of ground
  Figures<ReplicateMean> means_;
};

}  // namespace sunfleck
