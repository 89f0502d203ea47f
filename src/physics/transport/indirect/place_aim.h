#pragma once
// How light is aimed at an isolated stand, place by place.

#include "physics/transport/indirect/indirect_scene.h"

namespace sunfleck {

class PlaceAim {
 public:
  // The scene must outlive the object.
  PlaceAim(const IndirectScene& scene, const shared::StandSphere& stand) : scene_(scene), stand_(stand) {}

  // Returns shared::aimed_part of a place; all of 2^32 on all elements but soil.
  [[nodiscard]] std::uint64_t part(const EmissionPoint& place) const;

 private:
  const IndirectScene& scene_;
  shared::StandSphere stand_;
};

}  // namespace sunfleck
