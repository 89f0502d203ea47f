#pragma once
// Converts a camera to the form the tracers use.

#include "pictures/drawing/camera.h"
#include "shared/layout.h"
#include "shared/view_layout.h"

#include <glm/vec3.hpp>

namespace sunfleck {

struct PictureSize {
  int width = 0;
  int height = 0;
  int samples = 1;  // per pixel
};

// Returns the camera's part of the block, for a scene whose local frame begins at `origin_m`. `elements` and `ground` are left
// 0 for the caller to fill in.
[[nodiscard]] shared::ViewBlock make_view_block(const Camera& camera, const PictureSize& size, glm::dvec3 origin_m);

}  // namespace sunfleck
