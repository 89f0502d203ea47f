#pragma once
// The light of sensors over replicates: at one point, or the mean over several points.

#include "physics/transport/model/result.h"
#include "physics/transport/model/statistics.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sunfleck {

// Light that does not vary between replicates.
struct ExactLight {
  std::vector<double> direct_w_m2;  // [band]
  std::optional<double> sky;        // for a sky of horizontal irradiance 1; empty if its light is sampled
};

// Sampled light: that of a replicate, or what a single event, such as one more ray that arrives, adds to a replicate.
struct SampledLight {
  double sky = 0.0;               // for a sky of horizontal irradiance 1
  std::vector<double> scattered;  // [band], W m-2
};

class SensorTally {
 public:
  // `sky_w_m2` is the sky's horizontal irradiance, [band].
  SensorTally(ExactLight exact, std::vector<double> sky_w_m2);

  // Adds a replicate.
  void add(const SampledLight& light);

  [[nodiscard]] std::size_t replicates() const { return total_.front().count(); }

  // Returns `event`, except for parts on which the replicates differ: those are 0, since their spread tells the error.
  [[nodiscard]] SampledLight unseen(SampledLight event) const;

  // Returns the mean over the replicates, at least two. Half-widths come from the spread between them and from events that may
  // have escaped them all (`unseen_events` of physics/transport/model/statistics.h); `unseen` is what one of those would add.
  [[nodiscard]] SensorResult result(const SampledLight& unseen, double confidence) const;

 private:
  ExactLight exact_;
  std::vector<double> sky_w_m2_;
  ReplicateMean sky_;
  std::vector<ReplicateMean> scattered_, total_;  // [band]
};

}  // namespace sunfleck
