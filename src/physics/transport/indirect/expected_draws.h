#pragma once
// How many packets are drawn from each candidate on average: as many as its part of the flux that waits.

#include "physics/transport/indirect/candidates.h"
#include "physics/transport/indirect/indirect_scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sunfleck {

class ExpectedDraws {
 public:
  // A first round of all flux in `start`, [column], has about `packets` packets; each column that has any counts alike. The scene and
  // the light must outlive the object.
  ExpectedDraws(const IndirectScene& scene, const LightFromAbove& light, double packets, const std::vector<double>& start);

  // Sets the parts of the flux of some candidates, relative to `start`: the sums over their columns.
  void set_parts(const Candidates& candidates, std::size_t first, std::size_t count, std::vector<double>& parts);

  // Turns the parts of all candidates into numbers of packets.
  void scale(const Candidates& candidates, std::vector<double>& parts);

 private:
  double aim(const Candidates& candidates, std::vector<double>& expected, double before);
  [[nodiscard]] double packets_per_flux(const EmissionPoint& place) const;

  const IndirectScene& scene_;
  const LightFromAbove& light_;
  double packets_per_part_ = 0.0;
  std::vector<double> start_or_infinity_;  // [column], infinity for none
  std::vector<std::span<const std::int64_t>> rows_;
  bool first_round_ = true;
  double aimed_draws_ = 1.0;  // factor that makes up for what `aim` takes from the first round
};

}  // namespace sunfleck
