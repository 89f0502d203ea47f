#include "files/results/exports/record_entries.h"

#include "base/file.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

namespace sunfleck {

std::vector<RecordEntry> record_entries(const RunRecord& record, const RadiationModel& model) {
  const glm::dvec2 size_m = along_level_axes(model.plot.axes, {model.plot.size_x_m, model.plot.size_z_m});
  std::vector<RecordEntry> entries = {{"title", printable(record.title)},
                                      {"sunfleck", printable(record.version)},
                                      {"commit", printable(record.commit)},
                                      {"scene_file", printable(record.scene_file)},
                                      {"scene_digest", printable(record.scene_digest)},
                                      {"seed", fmt::to_string(record.seed)},
                                      {"complete", record.complete ? "true" : "false"},
                                      {"direct_error", fmt::to_string(record.accuracy.direct)},
                                      {"indirect_error", fmt::to_string(record.accuracy.indirect)},
                                      {"confidence", fmt::to_string(record.accuracy.confidence)},
                                      {"of", error_target_name(record.accuracy.of)},
                                      {"plot_size_m", fmt::format("{} {}", size_m.x, size_m.y)},
                                      {"periodic", model.plot.periodic ? "true" : "false"},
                                      {"axes", fmt::format("{}; m", axes_text(model.plot.axes))}};
  if (record.grid_m) entries.push_back({"grid_m", fmt::to_string(*record.grid_m)});
  if (record.passes) entries.push_back({"passes", fmt::to_string(*record.passes)});
  if (record.max_rays) entries.push_back({"max_rays", fmt::to_string(*record.max_rays)});
  return entries;
}

}  // namespace sunfleck
