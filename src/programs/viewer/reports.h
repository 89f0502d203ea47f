#pragma once
// Builds the fields of the events that a window writes.

#include "programs/viewer/live_light.h"
#include "programs/viewer/live_picture.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace sunfleck {

// Returns the fields of a result that has reached its bounds, in W m-2 of ground for one band; null where an error is unknown.
[[nodiscard]] nlohmann::json converged_fields(const LightNews& news, std::size_t band);

// Returns the fields of the organ that is picked, and of the triangle if that is; the frame has an organ.
[[nodiscard]] nlohmann::json picked_fields(const LivePictureFrame& frame);

// Returns the times from input to screen over all frames: median, 99th percentile and maximum, ms. Needs at least one frame.
[[nodiscard]] nlohmann::json frame_fields(std::vector<double> seconds);

}  // namespace sunfleck
