#pragma once
// Draws the panel at the left of the window, with all settings and figures. Uses Dear ImGui within a frame.

#include "programs/viewer/state.h"

namespace sunfleck {

// Width at a scale of 1, in desktop units.
inline constexpr float panel_width = 350.0F;

// Draws the panel and applies the user's input to `state`.
[[nodiscard]] PanelOrders draw_panel(ViewerState& state, float width_px, float height_px);

// Draws the light of what is picked in a box of fixed size at the left of the picture, through which clicks reach the picture.
void draw_selected(const ViewerState& state, float left_px, float height_px);

// Draws the message at the foot of the picture, which reports an error or a finished action. The picture begins at `left_px`
// and is `width_px` wide.
void draw_message(const ViewerState& state, float left_px, float width_px, float height_px);

}  // namespace sunfleck
