#pragma once
// PLANE.png: a receiver's facula map, of the beam and of all light, and how large its flecks are.

#include "transport/model.h"
#include "transport/result.h"

#include <cstddef>
#include <string>

namespace sunfleck {

// A gnuplot script, for draw_plot. North is up, west is left.
[[nodiscard]] std::string plane_plot(const std::string& title, const RadiationModel& model, const RadiationResult& result,
                                     std::size_t plane, std::size_t band);

}  // namespace sunfleck
