#include "simulate/checkpoint.h"

#include "base/error.h"
#include "base/file.h"
#include "base/sealed_file.h"
#include "base/version.h"
#include "files/results/exports/exports.h"
#include "files/results/tables/work_settings.h"
#include "simulate/result_folder.h"

#include <fmt/format.h>

#include <utility>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

// Returns everything on which the bytes of the tables depend, as in summary.json.
ordered_json run_settings(const Scene& scene, const SolveSettings& settings) {
  ordered_json noted = {{"command", "run"}, {"sunfleck", version()}, {"scene_digest", scene.digest}, {"seed", settings.seed}};
  add_work_settings(noted, settings.accuracy, settings.grid_m, settings.passes, settings.max_rays);
  return noted;
}

// Returns the settings, extended by whether sums of single triangles are kept.
ordered_json state_settings(ordered_json settings, ElementErrors element_errors) {
  settings["of_triangles"] = element_errors != ElementErrors::skip;
  return settings;
}

}  // namespace

Checkpoint::Checkpoint(fs::path folder, std::vector<std::string> exports, const Scene& scene, const SolveSettings& settings)
    : folder_(std::move(folder)),
      exports_(std::move(exports)),
      settings_(run_settings(scene, settings)),
      store_(folder_, state_settings(settings_, settings.element_errors)) {}

Checkpoint::Found Checkpoint::find(const RadiationModel& model, const SolveSettings& settings) {
  if (is_finished()) return Found::finished;
  found_ = store_.read(state_shape({&model, 1}, make_counter_layout(model), settings, {}));
  return found_ ? Found::begun : Found::nothing;
}

// The summary of a finished run contains its settings; a file that is not a summary of this program is ignored.
bool Checkpoint::is_finished() const {
  const std::optional<json> found = summary_in(folder_);
  if (!found || found->value("complete", json()) != true) return false;
  const json& summary = *found;
  const json none;
  const json settings = summary.value("settings", json::object());
  ordered_json noted;
  for (const auto& [key, value] : settings_.items()) {
    const json& place = settings.is_object() && settings.contains(key) ? settings : summary;
    noted[key] = key == "command" ? command_of(summary) : place.value(key, none);
  }
  expect_same_settings(settings_, noted, "that finished run", folder_);
  for (const ExportKind kind : export_kinds) {
    const auto lack = holds(exports_, export_name(kind)) ? lack_of(folder_, "run", export_file(kind)) : std::nullopt;
    if (lack) throw_input(fmt::format("--export {}", export_name(kind)), *lack, cure_of_lack);
  }
  return true;
}

std::string Checkpoint::resume_line() const {
  if (found_) return fmt::format("resuming after {} replicates", found_->replicates());
  return fmt::format("{}: nothing to resume, the run starts from the beginning", printable(folder_.string()));
}

void Checkpoint::finish() const {
  store_.remove();
}

}  // namespace sunfleck
