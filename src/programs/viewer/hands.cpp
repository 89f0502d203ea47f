#include "programs/viewer/hands.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace sunfleck {
namespace {

constexpr double turn_rad_per_height = 3.0;
constexpr double zoom_per_notch = 0.88;
constexpr float click_slack_px = 4.0F;
// Time without motion after which the camera is at rest.
constexpr double rest_s = 0.15;
constexpr double extents_per_second = 0.6;

// Returns 1 towards `forth`, -1 towards `back`, 0 if neither or both keys are held.
double pull(char forth, char back) {
  return (ImGui::IsKeyDown(forth) ? 1.0 : 0.0) - (ImGui::IsKeyDown(back) ? 1.0 : 0.0);
}

}  // namespace

bool Hands::busy(double now_s) const {
  return (pressed_on_picture_ && dragged_) || now_s - last_motion_s_ < rest_s;
}

bool Hands::drag(ViewerState& state, const PictureFrame& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  // In the frame of the press, the mouse position still jumps from elsewhere.
  if (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2)) return false;
  if (!pressed_on_picture_ || (io.MouseDelta.x == 0.0F && io.MouseDelta.y == 0.0F)) return false;
  const ImVec2 from_press = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F);
  const bool shifts = io.MouseDown[ImGuiMouseButton_Right] || io.MouseDown[ImGuiMouseButton_Middle] || io.KeyShift;
  if (!shifts && std::hypot(from_press.x, from_press.y) < click_slack_px && !dragged_) return false;
  dragged_ = true;
  const glm::dvec2 by(io.MouseDelta.x / frame.height_px, io.MouseDelta.y / frame.height_px);
  if (shifts) {
    pan(state.hand, {-by.x, by.y}, 0.0);
  } else {
    orbit(state.hand, -turn_rad_per_height * by.x, turn_rad_per_height * by.y);
  }
  return true;
}

bool Hands::fly_by_keys(ViewerState& state, const PictureFrame& frame) const {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyCtrl) return false;
  const glm::dvec3 by(pull('D', 'A'), pull('E', 'Q'), pull('W', 'S'));
  if (by == glm::dvec3(0.0)) return false;
  const double metres = extents_per_second * glm::length(frame.hi_m - frame.lo_m) * std::min(0.1, double{io.DeltaTime});
  fly(state.hand, metres * by);
  return true;
}

std::optional<glm::ivec2> Hands::steer(ViewerState& state, const PictureFrame& frame, double now_s) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over = !io.WantCaptureMouse && io.MousePos.x >= frame.left_px;
  for (const int mouse_button : {ImGuiMouseButton_Left, ImGuiMouseButton_Right, ImGuiMouseButton_Middle}) {
    if (over && ImGui::IsMouseClicked(mouse_button)) {
      pressed_on_picture_ = true;
      dragged_ = mouse_button != ImGuiMouseButton_Left;
    }
  }
  bool moved = drag(state, frame);
  if (over && io.MouseWheel != 0.0F) {
    zoom(state.hand, std::pow(zoom_per_notch, io.MouseWheel));
    moved = true;
  }
  moved = fly_by_keys(state, frame) || moved;
  if (moved) {
    state.camera_as_given = false;
    last_motion_s_ = now_s;
  }
  const bool any_down = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2];
  if (!pressed_on_picture_ || any_down) return std::nullopt;
  pressed_on_picture_ = false;
  if (std::exchange(dragged_, false)) return std::nullopt;
  return glm::ivec2(static_cast<int>(io.MousePos.x - frame.left_px), static_cast<int>(io.MousePos.y));
}

}  // namespace sunfleck
