#pragma once
// Where rays and packets landed, as places from which light leaves again.

#include "physics/transport/indirect/indirect_scene.h"

#include <span>

namespace sunfleck {

// Returns the place of a landing, without random bits. Of a ray that left or was lost it has only the surface and the level.
[[nodiscard]] EmissionPoint place_of(const IndirectScene& scene, const shared::Landing& landing);

// Asks for the memory that place_of reads.
void prefetch_place_of(const IndirectScene& scene, const shared::Landing& landing);

// Sets places[k] to the place of landings[k]. The threads of the run share the work.
void find_places(const IndirectScene& scene, std::span<const shared::Landing> landings, std::span<EmissionPoint> places);

}  // namespace sunfleck
