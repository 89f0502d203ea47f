#pragma once
// The panel at the window's left: everything that can be set, and figures beside it. Dear ImGui; within a frame.

#include "viewer/state.h"

namespace sunfleck {

// Of a scale of 1, as the desktop counts.
inline constexpr float panel_width = 350.0F;

// Draws the panel and takes what its user does into `state`.
[[nodiscard]] PanelOrders draw_panel(ViewerState& state, float width_px, float height_px);

// At the foot of the picture: what went wrong, or was done. The picture begins at `left_px` and is `width_px` wide.
void draw_message(const ViewerState& state, float left_px, float width_px, float height_px);

}  // namespace sunfleck
