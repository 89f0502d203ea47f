#pragma once
// Handles mouse and keyboard over the picture, which move the camera and pick elements. Uses Dear ImGui within a frame.

#include "programs/viewer/state.h"

#include <glm/vec2.hpp>
#include <optional>

namespace sunfleck {

// The picture's place in the window, and the extent of the scene.
struct PictureFrame {
  float left_px = 0.0F, width_px = 0.0F, height_px = 0.0F;
  glm::dvec3 lo_m{0.0}, hi_m{0.0};
};

class Hands {
 public:
  // Moves state.hand according to the input since the last frame. Returns the pixel of the picture that was clicked, if any.
  [[nodiscard]] std::optional<glm::ivec2> steer(ViewerState& state, const PictureFrame& frame, double now_s);

  // Returns true if the camera is expected to keep moving: a button is held, or the camera moved a moment ago.
  [[nodiscard]] bool busy(double now_s) const;

 private:
  bool drag(ViewerState& state, const PictureFrame& frame);
  bool fly_by_keys(ViewerState& state, const PictureFrame& frame) const;

  bool pressed_on_picture_ = false;
  bool dragged_ = false;
  double last_motion_s_ = -1.0;
};

}  // namespace sunfleck
