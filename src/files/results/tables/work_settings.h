#pragma once
// Writes the settings that fix or limit the work of a run to JSON.

#include "physics/transport/model/accuracy.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace sunfleck {

// Adds the error bounds and the limits of the work to a JSON object, under the same keys and in the same order in summaries,
// checkpoints and stored steps. An empty value becomes null.
void add_work_settings(nlohmann::ordered_json& settings, const Accuracy& accuracy, const std::optional<double>& grid_m,
                       const std::optional<int>& passes, const std::optional<std::uint64_t>& max_rays);

}  // namespace sunfleck
