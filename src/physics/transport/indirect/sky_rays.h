#pragma once
// Rays of sky light, one for each equal share of the sky's flux: from a plane above an endless canopy, or from a disc around
// an isolated stand. Where light is aimed at a stand (StandAim), half of the rays start in a small disc around it and the other
// half in the ring around that disc; the rays of a disc and those of a ring then carry different shares.
//
// The skies of several lights share their rays: directions are drawn from the mean of all skies, and each sky's flux is divided
// among the rays in proportion to its radiance over the mean radiance.

#include "base/random.h"
#include "physics/light/sky.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/model/stand_aim.h"
#include "shared/layout.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sunfleck {

class SkyRays {
 public:
  // At least one light must have a sky. `aim` may be null.
  SkyRays(Lights lights, const CounterLayout& layout, const StandAim* aim);

  [[nodiscard]] std::size_t lights() const { return ground_m2_.size(); }

  // Returns the area of level ground on which the horizontal sky irradiance of a light gives its flux of all rays of a
  // replicate; 0 for a light without a sky.
  [[nodiscard]] double ground_m2(std::size_t light) const { return ground_m2_[light]; }

  // Returns about `count` rays in parallel beams. One direction is drawn in each of equal shares of the sky's flux; the origins
  // of a beam's rays lie one in each cell of a grid over the plot, or over the disc that faces the beam. Rays from the ring
  // come last.
  [[nodiscard]] std::vector<shared::Packet> draw(std::size_t count, RandomStream& random) const;

  // Returns the share of the mean sky's flux that the first k of `rays` drawn rays carry together: exactly 1 for all.
  [[nodiscard]] double share_of_first(std::size_t k, std::size_t rays) const;
  // Returns whether all lights with a sky have the same, so that each ray carries the mean sky's share of every light.
  [[nodiscard]] bool alike() const { return weights_.empty(); }
  // Returns the radiance of each light's sky over that of the mean sky in a ray's direction of travel, [light]; 0 without a
  // sky. The skies must not be alike.
  [[nodiscard]] std::span<const float> weights(const glm::vec3& direction) const;
  // Returns the largest share of a light that one ray carries, times the number of rays.
  [[nodiscard]] double largest_weight(std::size_t light) const;

 private:
  [[nodiscard]] glm::dvec3 origin_above(double u, double v) const;
  [[nodiscard]] glm::dvec3 origin_around(const glm::dvec3& to_sky, double u, double v) const;
  [[nodiscard]] bool aimed() const { return inner_share_ < 1.0; }

  SkyRays(Lights lights, const CounterLayout& layout, const StandAim* aim, const std::vector<Sky>& skies);
  void weigh(std::span<const Sky> skies, const std::vector<std::size_t>& lit, std::size_t lights);

  Sky sky_;
  std::vector<float> weights_;       // [cell of the sky][light]; empty if all skies are alike
  std::vector<double> most_weight_;  // [light]
  bool periodic_;
  glm::dvec2 period_m_{0.0};
  double top_y_m_ = 0.0;
  glm::dvec3 centre_m_{0.0};  // of the sphere around an isolated stand with its plot and receivers
  double radius_m_ = 0.0;
  double inner_share_ = 1.0;       // of the disc's area, the small disc around the stand
  std::vector<double> ground_m2_;  // [light]
};

// Shares of the lights' sky flux that a sequence of drawn rays carries, ray by ray.
class SkyShares {
 public:
  // Both arguments must outlive the object.
  SkyShares(const SkyRays& sky, std::span<const shared::Packet> rays);

  // Returns the share of each light's flux that the rays up to the next one carry together, [light]: exactly 1 after the last
  // ray.
  [[nodiscard]] std::span<const double> next();

 private:
  // Adds the weights of a ray; rays are added one after the other.
  void add(std::size_t ray, std::vector<double>& sums);

  const SkyRays& sky_;
  std::span<const shared::Packet> rays_;
  std::size_t taken_ = 0;
  std::vector<double> shares_;         // [light]
  std::vector<double> totals_, sums_;  // [light], of weights; empty if all skies are alike
  std::span<const float> weights_;     // [light], of the last ray, and of all rays of its beam
};

}  // namespace sunfleck
