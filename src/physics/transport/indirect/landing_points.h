#pragma once
// The points from which the packets of the first round start: where beam rays landed.
//
// Each point is the landing of a beam ray of one light, taken in a systematic sample of its rays. Where several lights share the
// packets, rays from the point towards the other suns tell which of them shine there too. With n_i samples of beam i for each
// area of level ground, light i lands at the point with n_i |n . s_i| V_i / sin h_i samples per area, n being the normal, s_i
// the direction to the sun, h_i its elevation, and V_i 1 where it shines and 0 elsewhere. The point then stands for the flux
// E_k |n . s_k| V_k / sin h_k of each light k divided by the sum of these densities over all lights (the balance heuristic,
// Veach and Guibas 1995, SIGGRAPH, eq. 14), so that each light is estimated from all points on which it shines.

#include "base/random.h"
#include "physics/transport/indirect/indirect_scene.h"
#include "physics/transport/indirect/pass_arrays.h"
#include "shared/rounds.h"

namespace sunfleck {

// Samples about `most` landings into arrays.points, the same number for each light with a beam; of several parts of a beam the
// first one gets half. Where there are fewer rays, all of them are taken. Returns false if stopped.
[[nodiscard]] bool sample_landings(const IndirectScene& scene, const LightFromAbove& light, double most, RandomStream& random,
                                   const StopQuestion& stop, PassArrays& arrays);

// Returns a systematic sample of at most `most` rays of a part of a beam, but of one at least.
[[nodiscard]] shared::BeamSample sample_of(const BeamPart& part, double most, RandomStream& random);

}  // namespace sunfleck
