#pragma once
// PLANE.png: the facula maps of a receiver, for the beam and for all light, and the sizes of its sunflecks.

#include "transport/model.h"
#include "transport/result.h"

#include <cstddef>
#include <string>

namespace sunfleck {

// Returns a gnuplot script for draw_plot. North is up and west is left.
[[nodiscard]] std::string plane_plot(const std::string& title, const RadiationModel& model, const RadiationResult& result,
                                     std::size_t plane, std::size_t band);

}  // namespace sunfleck
