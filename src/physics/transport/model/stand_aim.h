#pragma once
// Light aimed at an isolated stand that is small compared with its plot. Rays spread evenly over such a plot would nearly all
// light bare ground; instead, those that can meet the stand and those that only light the plot are counted out separately.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"

#include <glm/vec3.hpp>
#include <optional>

namespace sunfleck {

struct StandAim {
  static constexpr unsigned least_bits = 10;

  glm::dvec3 lo_m{0.0}, hi_m{0.0};  // the box of all elements but soil, in the canopy's local frame
  glm::dvec3 centre_m{0.0};
  double radius_m = 0.0;  // of the sphere around that box
  double reach_m = 0.0;   // of the sphere about the same centre that holds the whole scene

  // Returns how many packets a unit of flux that leaves this point is divided into, relative to flux that leaves the stand. The
  // spread of the stand's light is least if that number grows with the standard deviation of a packet's contribution (Neyman
  // 1934, J. R. Stat. Soc. 97:558): here with the square root of its chance to meet the stand, which falls with the cube of the
  // distance for packets from level ground. 1 within the sphere, at least 2^-least_bits.
  [[nodiscard]] double packets_per_flux(const glm::dvec3& point_m) const;
};

// Returns nothing for an endless canopy, for a stand that fills much of its plot, and for a scene with [[plane]] receivers, whose
// maps need rays spread evenly.
[[nodiscard]] std::optional<StandAim> make_stand_aim(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck
