#pragma once
// How light is aimed at an isolated stand, place by place.

#include "physics/transport/indirect/indirect_scene.h"

namespace sunfleck {

class PlaceAim {
 public:
  // Both must outlive the object.
  PlaceAim(const IndirectScene& scene, const StandAim& aim) : scene_(scene), aim_(aim) {}

  // Returns StandAim::packets_per_flux of a place; 1 on all elements but soil.
  [[nodiscard]] double packets_per_flux(const EmissionPoint& place) const;

 private:
  const IndirectScene& scene_;
  const StandAim& aim_;
};

}  // namespace sunfleck
