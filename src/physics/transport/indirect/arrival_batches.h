#pragma once
// Rays and packets are booked in batches, of which all that is read several times stays in a processor's own cache.

#include "base/in_blocks.h"
#include "physics/transport/indirect/arrivals.h"
#include "physics/transport/indirect/landing_places.h"
#include "physics/transport/indirect/pass_arrays.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace sunfleck {

inline constexpr std::size_t most_in_batch = 8192;
inline constexpr std::size_t least_batch = 256;
inline constexpr std::size_t most_carried_in_batch = std::size_t{1} << 17U;
// Rays whose arrivals a thread finds at a time.
inline constexpr std::size_t arrivals_per_block = 512;

// Calls take(first, arrivals) for batches of `count` rays that carry `width` columns. There is room for what arrivals carry in
// arrays.carried.
template <class Take>
void for_each_batch(std::size_t count, std::size_t width, PassArrays& arrays, const Take& take) {
  const std::size_t most = std::clamp(most_carried_in_batch / width, least_batch, most_in_batch);
  for (std::size_t first = 0; first < count; first += most) {
    arrays.arrivals.resize(std::min(most, count - first));
    arrays.carried.resize(arrays.arrivals.size() * width);
    take(first, std::span(arrays.arrivals));
  }
}

// Sets each arrival to find(k), of the ray with landing k. The threads of the run share the work.
template <class Find>
void find_arrivals(const IndirectScene& scene, std::span<const shared::Landing> landings, std::span<Arrival> arrivals,
                   const Find& find) {
  each_in_blocks(
      arrivals.size(), arrivals_per_block, [&](std::size_t k) { prefetch_place_of(scene, landings[k]); },
      [&](std::size_t k) { arrivals[k] = find(k); });
}

}  // namespace sunfleck
