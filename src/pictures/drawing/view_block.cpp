#include "pictures/drawing/view_block.h"

#include "base/check.h"

#include <algorithm>

namespace sunfleck {

shared::ViewBlock make_view_block(const Camera& camera, const PictureSize& size, glm::dvec3 origin_m) {
  EXPECT(std::min({size.width, size.height, size.samples}), >, 0);
  shared::ViewBlock view{};
  view.position = camera.position_m - origin_m;
  view.forward = camera.forward;
  view.width = static_cast<std::uint32_t>(size.width);
  view.height = static_cast<std::uint32_t>(size.height);
  view.samples = static_cast<std::uint32_t>(size.samples);
  switch (camera.kind) {
    case Projection::perspective:
      view.kind = shared::view_perspective;
      view.right = camera.right * (camera.tan_half_fov * camera.aspect);
      view.up = camera.up * camera.tan_half_fov;
      break;
    case Projection::orthographic:
      view.kind = shared::view_orthographic;
      view.right = camera.right * (camera.half_height_m * camera.aspect);
      view.up = camera.up * camera.half_height_m;
      break;
    case Projection::fisheye:
      view.kind = shared::view_fisheye;
      view.right = camera.right;
      view.up = camera.up;
      view.circle_centre = camera.circle_centre;
      view.per_radius = {static_cast<float>(camera.aspect / camera.circle_radius),
                         static_cast<float>(1.0 / camera.circle_radius)};
      break;
  }
  return view;
}

}  // namespace sunfleck
