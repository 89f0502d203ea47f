#pragma once
// The views that fit a box with its axes.

#include "pictures/drawing/camera.h"

namespace sunfleck {

[[nodiscard]] inline Camera three_quarter_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect,
                                               Axes axes = Axes::south_up_west) {
  return three_quarter_view(box_with_axes(lo_m, hi_m, axes), aspect);
}
[[nodiscard]] inline Camera top_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect, Axes axes = Axes::south_up_west) {
  return top_view(box_with_axes(lo_m, hi_m, axes), aspect);
}
[[nodiscard]] inline Camera side_view(glm::dvec3 lo_m, glm::dvec3 hi_m, double aspect, Axes axes = Axes::south_up_west) {
  return side_view(box_with_axes(lo_m, hi_m, axes), aspect);
}

}  // namespace sunfleck
