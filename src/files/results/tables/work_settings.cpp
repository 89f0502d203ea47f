#include "files/results/tables/work_settings.h"

#include "files/results/tables/result_writer.h"
#include "files/results/tables/summary_parts.h"

#include <nlohmann/json.hpp>

namespace sunfleck {

void add_work_settings(nlohmann::ordered_json& settings, const Accuracy& accuracy, const std::optional<double>& grid_m,
                       const std::optional<int>& passes, const std::optional<std::uint64_t>& max_rays) {
  settings["direct_error"] = accuracy.direct;
  settings["indirect_error"] = accuracy.indirect;
  settings["confidence"] = accuracy.confidence;
  settings["of"] = error_target_name(accuracy.of);
  settings["grid_m"] = value_or_null(grid_m);
  settings["passes"] = value_or_null(passes);
  settings["max_rays"] = value_or_null(max_rays);
}

}  // namespace sunfleck
