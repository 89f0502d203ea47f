#pragma once
// The independent tracer follows paths from the light to their ends, and from sensors backwards, with weights in double
// precision and Russian roulette. It shares no code with the program except the description of scene and sky.

#include "long/differential_figures.h"
#include "physics/transport/model/model.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck::test::differential {

struct TracerWork {
  std::size_t batches = 64;
  // Number of rays along each side of the grid from which the beam, or the sky's light, starts: cells * cells rays per batch.
  std::size_t cells = 96;
  std::size_t sensor_paths = 512;
  std::uint64_t seed = 1;
};

// Returns the value of each figure and its standard error, from the spread between batches. It does not depend on the number of
// threads.
[[nodiscard]] std::vector<Stated> trace_figures(const RadiationModel& model, const std::vector<Figure>& figures,
                                                const TracerWork& work);

}  // namespace sunfleck::test::differential
