#pragma once
// How the Vulkan tracer divides its work.

#include "shared/rounds.h"

#include <cstdint>

namespace sunfleck {

enum class RoundsAt { best, device, host };

// None of these affects the results.
struct VulkanChoices {
  std::uint32_t rays_per_dispatch = 0;            // at most; 0: a default for software or hardware
  std::uint32_t group_size = shared::group_size;  // threads per workgroup, at most 128
  double seconds_per_dispatch = 0.0;              // approximate, adapts to the device; 0: no target
  // Where the rounds of indirect passes are made. Software Vulkan is slower at everything but tracing than the host is on the
  // same cores.
  RoundsAt rounds_at = RoundsAt::best;
  shared::RoundChoices rounds{};  // if there are no copies: a default
  // Rounds of the first pass that a device makes before the host looks, unless dispatches have a target of time or do not hold
  // all packets of a round; 0: a default; 1: each round of every pass in parts. Later passes take as many as the one before
  // needed, from 2 to 32.
  std::uint32_t rounds_at_once = 0;
  // Passes whose rounds a device makes side by side, at most, if it makes several rounds before the host looks; 0: a default.
  std::uint32_t lanes = 0;
};

}  // namespace sunfleck
