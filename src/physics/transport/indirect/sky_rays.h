#pragma once
// Rays of sky light, one for each equal share of the sky's flux: from a plane above an endless canopy, or from a disc around
// an isolated stand. Where light is aimed at a stand (StandAim), half of the rays start in a small disc around it and the other half in
// the ring around that disc; the rays of a disc and those of a ring then carry different shares.

#include "base/random.h"
#include "physics/light/sky.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/stand_aim.h"
#include "shared/layout.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

class SkyRays {
 public:
  // The model must have a sky. `aim` may be null.
  SkyRays(const RadiationModel& model, const CounterLayout& layout, const StandAim* aim);

  // Returns the area of level ground on which the horizontal sky irradiance gives the flux of all rays of a replicate.
  [[nodiscard]] double ground_m2() const { return ground_m2_; }

  // Returns about `count` rays in parallel beams. One direction is drawn in each of equal shares of the sky's flux; the origins of a
  // beam's rays lie one in each cell of a grid over the plot, or over the disc that faces the beam. Rays from the ring come last.
  [[nodiscard]] std::vector<shared::Packet> draw(std::size_t count, RandomStream& random) const;

  // Returns the share of the sky's flux that the first k of `rays` drawn rays carry together: exactly 1 for all.
  [[nodiscard]] double share_of_first(std::size_t k, std::size_t rays) const;
  // Returns the largest share that one ray carries, times the number of rays.
  [[nodiscard]] double largest_weight() const;

 private:
  [[nodiscard]] glm::dvec3 origin_above(double u, double v) const;
  [[nodiscard]] glm::dvec3 origin_around(const glm::dvec3& to_sky, double u, double v) const;
  [[nodiscard]] bool aimed() const { return inner_share_ < 1.0; }

  Sky sky_;
  bool periodic_;
  glm::dvec2 period_m_{0.0};
  double top_y_m_ = 0.0;
  glm::dvec3 centre_m_{0.0};  // of the sphere around an isolated stand with its plot and receivers
  double radius_m_ = 0.0;
  double inner_share_ = 1.0;  // of the disc's area, the small disc around the stand
  double ground_m2_ = 0.0;
};

}  // namespace sunfleck
