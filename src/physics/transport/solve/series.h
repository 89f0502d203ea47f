#pragma once
// The sums of a series of replicates with the same work.

#include "physics/transport/indirect/conversion.h"
#include "physics/transport/indirect/replicate_maker.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/solve/joint_sums.h"
#include "physics/transport/solve/run_sums.h"
#include "physics/transport/solve/solve.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace sunfleck {

struct Series {
  // `incidences` are [light]. The maker's lights must outlive the series.
  Series(const ReplicateMaker& maker, std::span<const Incidence> incidences, const SolveSettings& settings,
         const WantedSums& wanted);

  void add(const ReplicateSet& replicates);

  // The first light's sums; the numbers of replicates, rays and packets are those of all lights.
  [[nodiscard]] RunSums& front() const { return *sums.front(); }
  [[nodiscard]] std::size_t replicates() const { return front().replicates; }
  // Returns the number of rays and packets.
  [[nodiscard]] std::uint64_t traced() const { return replicates() * grid_rays + front().packets + front().sky_rays; }

  // Passes to `archive` everything that another series of such replicates needs to continue. The number of values depends only on
  // the lights, the settings and the wanted sums; the first integer is the number of replicates.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    for (const auto& of_light : self.sums) {
      std::conditional_t<std::is_const_v<Self>, const RunSums, RunSums>& light_sums = *of_light;
      RunSums::visit(light_sums, archive);
    }
    archive(self.joint);
  }

  Work work;                                   // of each replicate
  std::vector<double> ray_shares;              // as in ReplicateOrder
  std::vector<Conversion> conversions;         // [light]
  std::vector<std::unique_ptr<RunSums>> sums;  // [light]; they refer to the conversions, so that a series cannot be copied
  std::vector<JointSums> joint;
  std::vector<std::uint64_t> light_rays;  // [light], beam rays traced in each replicate
  std::uint64_t grid_rays = 0;            // of all lights together
};

}  // namespace sunfleck
