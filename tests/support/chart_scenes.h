#pragma once
// A plot for charts, and images of scenes in which there is nothing.

#include "physics/canopy/plot.h"
#include "pictures/drawing/chart.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sunfleck::test {

inline constexpr Plot chart_plot{1.8, 2.4, true};
inline constexpr double chart_height_m = 2.2;

// The depth of a sample that shows nothing.
inline constexpr float endless_m = std::numeric_limits<float>::infinity();

inline SurfaceImage empty_scene(int width, int height, int samples = 1) {
  const std::size_t count = static_cast<std::size_t>(width) * height * samples;
  return {width, height, samples, std::vector<std::uint32_t>(count, SurfaceImage::nothing),
          std::vector<float>(count, endless_m)};
}

}  // namespace sunfleck::test
