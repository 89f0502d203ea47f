#pragma once
// Builds random scenes of many kinds, small enough to be traced twice within seconds. Their seeds are fixed.

#include "support/models.h"

#include <span>

namespace sunfleck::test::differential {

struct SceneKind {
  const char* name;
  int scenes;  // of this kind
  RadiationModel (*make)(Random& random, int scene);
};

// Returns all kinds.
[[nodiscard]] std::span<const SceneKind> scene_kinds();

// Returns scene number `scene` of a kind, counted from 0.
[[nodiscard]] RadiationModel make_scene(const SceneKind& kind, int scene);

}  // namespace sunfleck::test::differential
