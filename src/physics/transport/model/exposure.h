#pragma once
// Decides which elements the direct beam can hit, and which element area one landing represents.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// A part of an element that the beam can hit.
struct FacingArea {
  double area_m2 = 0.0;
  double lit_m2_per_landing = 0.0;  // in one replicate
};

class BeamExposure {
 public:
  // `ground_per_ray_m2` is the level ground that each beam ray of a replicate represents.
  BeamExposure(const RadiationModel& model, const CounterLayout& layout, double ground_per_ray_m2);

  // Returns the area of the element that one landing represents in one replicate: the beam's cross-section divided by the
  // cosine of the angle between beam and normal. Returns 0 for an element that the beam cannot hit: without a beam,
  // edge-on to it, a copy of an earlier element, or below the soil. Such an element is neither sunlit nor shaded.
  [[nodiscard]] float lit_m2_per_landing(std::size_t element) const { return lit_m2_per_landing_[element]; }
  [[nodiscard]] bool can_hit(std::size_t element) const { return lit_m2_per_landing_[element] > 0.0F; }

 private:
  std::vector<float> lit_m2_per_landing_;  // [element]
};

// Returns the largest area of `parts` that may be sunlit although no ray landed there, m2: an area in which at most
// `landings` landings are expected, filled first with the parts that receive the fewest per area.
[[nodiscard]] double unseen_sunlit_m2(std::vector<FacingArea> parts, double landings);

// Marks the elements that no light can reach: copies of earlier ones and, in an endless canopy, elements below the soil.
// [element]
[[nodiscard]] std::vector<bool> hidden_elements(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck
