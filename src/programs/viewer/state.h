#pragma once
// The state of a window: its content and the user's settings.

#include "pictures/charts/picture.h"
#include "pictures/drawing/camera_motion.h"
#include "programs/viewer/light_request.h"
#include "programs/viewer/live_light.h"
#include "programs/viewer/live_picture.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace sunfleck {

struct ViewerState {
  // Set by the user.
  LightRequest light;
  HandCamera hand;
  // True as long as nobody has moved the camera since the view was chosen; it then keeps fitting the window.
  bool camera_as_given = true;
  PictureOptions options;
  Picture picture;
  std::optional<Pick> picked;
  bool own_size = false;  // save pictures in the size below, not in the window's
  int save_width = 1600, save_height = 1200;
  bool panel = true;
  bool playing = false;
  double play_step_min = 10.0;
  bool own_range = false;
  double range_top_w_m2 = 500.0;

  // Shown to the user.
  LightNews news;
  std::shared_ptr<const LivePictureFrame> frame;
  std::string message;  // one line
  bool message_is_problem = false;
  std::string title, device, plot_text;
  std::vector<std::string> bands;
  std::vector<std::string> optics_names;
  double frame_ms = 0.0;
  bool fixed_beam = false;  // as has_fixed_beam of the scene

  // Positions of the panel's controls, px: left, top, right, bottom.
  std::map<std::string, std::array<float, 4>> controls;

  [[nodiscard]] std::size_t band() const;  // number of the band shown
};

// Returns true if the frame describes what is picked, which it does a moment after the click.
[[nodiscard]] bool is_picked_shown(const ViewerState& state);

// One-time requests from the panel.
struct PanelOrders {
  std::optional<ViewKind> view;
  bool fit = false;
  bool copy_camera = false;
  bool save_picture = false;
  bool save_result = false;
  bool reset_light = false;
};

}  // namespace sunfleck
