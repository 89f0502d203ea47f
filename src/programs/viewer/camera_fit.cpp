#include "programs/viewer/camera_fit.h"

#include <algorithm>
#include <utility>

namespace sunfleck {
namespace {

// Returns the camera with the aspect ratio of another picture.
Camera with_aspect(Camera camera, double aspect) {
  if (camera.kind == Projection::fisheye) return fisheye_view(camera.position_m, aspect);
  camera.aspect = aspect;
  return camera;
}

}  // namespace

void CameraFit::place(ViewerState& state, const Session& session, const PictureFrame& frame) {
  state.options.width = std::max(64, static_cast<int>(frame.width_px));
  state.options.height = std::max(64, static_cast<int>(frame.height_px));
  if (!state.camera_as_given) {
    state.hand.camera = with_aspect(state.hand.camera, static_cast<double>(state.options.width) / state.options.height);
    return;
  }
  const Placed now{state.options.view, state.options.width, state.options.height};
  if (std::exchange(placed_, now) == now) return;
  const Camera camera = picture_camera(session.light.geometry(), session.simulation.layout(), state.options);
  state.hand = in_hand(camera, 0.5 * (frame.lo_m + frame.hi_m));
}

PictureRequest picture_to_save(const ViewerState& state, const Session& session) {
  PictureRequest request{state.hand.camera, state.options, state.picture, std::nullopt, false};
  request.options.width = state.save_width;
  request.options.height = state.save_height;
  request.camera = state.camera_as_given
                       ? picture_camera(session.light.geometry(), session.simulation.layout(), request.options)
                       : with_aspect(request.camera, static_cast<double>(state.save_width) / state.save_height);
  return request;
}

}  // namespace sunfleck
