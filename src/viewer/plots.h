#pragma once
// Small live plots in the panel. Dear ImGui; within a window of it.

#include "transport/result.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// Sunfleck ratio and downward light against height, both as shares of what is above the canopy, with bands of their errors.
void draw_profile(const std::vector<LayerResult>& layers, std::size_t band, float width_px);

// Where a band's light goes: a bar of its shares, and their figures.
void draw_balance(const BandResult& band, float width_px);

}  // namespace sunfleck
