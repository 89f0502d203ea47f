#pragma once
// Draws small live plots in the panel. Uses Dear ImGui within a window.

#include "physics/transport/model/result.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// Draws sunfleck ratio and downward light against height, as shares of their values above the canopy, with error bands.
void draw_profile(const std::vector<LayerResult>& layers, std::size_t band, float width_px);

// Draws the fate of a band's light: a bar of its shares, and their figures.
void draw_balance(const BandResult& band, float width_px);

}  // namespace sunfleck
