#pragma once
// Light aimed at an isolated stand that is small compared with its plot. Rays spread evenly over such a plot would nearly all
// light bare ground; instead, those that can meet the stand and those that only light the plot are counted out separately.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "shared/aim.h"

#include <glm/vec3.hpp>
#include <optional>

namespace sunfleck {

struct StandAim {
  glm::dvec3 lo_m{0.0}, hi_m{0.0};  // the box of all elements but soil, in the canopy's local frame
  glm::dvec3 centre_m{0.0};
  double radius_m = 0.0;  // of the sphere around that box
  double reach_m = 0.0;   // of the sphere about the same centre that holds the whole scene

  // Returns the sphere around the box as packets are aimed at it (shared::aimed_part).
  [[nodiscard]] shared::StandSphere sphere() const { return {glm::vec3(centre_m), static_cast<float>(radius_m)}; }
};

// Returns nothing for an endless canopy, for a stand that fills much of its plot, and for a scene with [[plane]] receivers, whose
// maps need rays spread evenly.
[[nodiscard]] std::optional<StandAim> make_stand_aim(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck
