#pragma once
// The lights of one simulation. They share its packets: a packet's way through the canopy does not depend on the light it
// carries.

#include "physics/transport/model/model.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sunfleck {

// Models that differ in nothing but the sun, the sky and the flux of the bands, at least one. [light]
using Lights = std::span<const RadiationModel>;

// Packets carry quanta for each light in each band. Returns the number of that column, [waveband][light].
[[nodiscard]] constexpr std::size_t column_of(std::size_t band, std::size_t light, std::size_t lights) {
  return band * lights + light;
}

// A light and its weight in a sum.
struct LightShare {
  std::size_t light = 0;
  double weight = 1.0;
};
// A sum of lights, such as that of the steps of a date.
using LightSum = std::vector<LightShare>;

// The sums whose errors a simulation tells.
struct WantedSums {
  std::vector<LightSum> of_lights;
  // Groups of organs, such as all leaves, in each of these sums. [organ], index of the group; empty without groups
  std::vector<std::size_t> group_of_organ;
};

// Returns which lights have at least this share of the brightest one's flux on level ground, all bands together. [light]
[[nodiscard]] std::vector<bool> bright_lights(Lights lights, double least_share);

[[nodiscard]] bool any_beam(Lights lights);
[[nodiscard]] bool any_sky(Lights lights);

}  // namespace sunfleck
