#pragma once
// How the Vulkan tracer's work is cut.

#include "shared/layout.h"

#include <cstdint>

namespace sunfleck {

// What comes out does not depend on any of these.
struct VulkanChoices {
  std::uint32_t rays_per_dispatch = 0;            // at most; 0: as suits software or hardware
  std::uint32_t group_size = shared::group_size;  // threads a workgroup, at most 128
  double seconds_per_dispatch = 0.0;              // about, however fast the device is; 0: any
};

}  // namespace sunfleck
