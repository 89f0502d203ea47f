#pragma once
// The fields of the events that a window tells.

#include "viewer/live_light.h"
#include "viewer/live_picture.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace sunfleck {

// Of a result that has reached its bounds, W m-2 of ground of one band; null where an error is not known.
[[nodiscard]] nlohmann::json converged_fields(const LightNews& news, std::size_t band);

[[nodiscard]] nlohmann::json picked_fields(const PickedElement& picked);

// From input to screen: median, 99 % and worst of all frames, ms; at least one frame.
[[nodiscard]] nlohmann::json frame_fields(std::vector<double> seconds);

}  // namespace sunfleck
