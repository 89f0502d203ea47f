#pragma once
// Fits the camera of a window to the size of its picture, and to that of a file.

#include "programs/viewer/hands.h"
#include "programs/viewer/live_picture.h"
#include "programs/viewer/session.h"
#include "programs/viewer/state.h"

#include <optional>

namespace sunfleck {

class CameraFit {
 public:
  // Places the camera that the user has not moved as `render` would for a picture of the window's size, once for each view and
  // size. A camera that was moved stays where it is, and gets the window's aspect ratio. Sets the size of state.options.
  void place(ViewerState& state, const Session& session, const PictureFrame& frame);

  // Has an unmoved camera placed anew.
  void forget() { placed_.reset(); }

 private:
  // The view and size for which an unmoved camera was placed.
  struct Placed {
    ViewKind view;
    int width, height;
    friend bool operator==(const Placed&, const Placed&) = default;
  };

  std::optional<Placed> placed_;
};

// Returns the request for a file of state.save_width x state.save_height pixels, for which an unmoved camera is placed anew.
[[nodiscard]] PictureRequest picture_to_save(const ViewerState& state, const Session& session);

}  // namespace sunfleck
