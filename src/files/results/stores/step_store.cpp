#include "files/results/stores/step_store.h"

#include "base/archive.h"
#include "base/each_number.h"
#include "base/error.h"
#include "base/file.h"
#include "base/sealed_file.h"
#include "files/results/tables/day_fields.h"
#include "files/results/tables/plane_day.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <utility>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view step_mark = "SUNSTEP9";
constexpr const char* steps_folder = "steps";
constexpr const char* settings_file = "settings.json";
constexpr const char* state_file = "block_state.bin";
constexpr const char* finished_key = "finished";
constexpr const char* format_key = "format";
constexpr int step_format = 12;  // of the steps, and of the tables that a finished day has

struct StepSizes {
  std::size_t fields = 0, maps = 0;  // numbers of values
};

// Writes or reads a step; its light has the sizes of the model. A reader that expects no fields skips them.
template <class Archive, class Step>
void visit(const Archive& archive, Step& step, const StepSizes& sizes) {
  std::vector<double> light;
  EachNumber([&](double number) { light.push_back(number); })(step.light);
  archive["light"].packed(light, light.size());
  if constexpr (Archive::reads) {
    auto next = light.begin();
    EachNumber([&](double& number) { number = *next++; })(step.light);
  }
  archive["shares_packets"].value(step.light.shares_packets);
  if (!Archive::reads || sizes.fields > 0) archive["fields"].packed(step.fields, sizes.fields);
  archive["maps"].packed(step.maps, sizes.maps);
  archive["next_rays"].value(step.next_work.rays);
  archive["next_packets"].value(step.next_work.packets);
  archive["rays"].value(step.rays);
  archive["packets"].value(step.packets);
  archive["lost_rays"].value(step.lost_rays);
  archive["direct_error"].value(step.direct_error);
  archive["indirect_error"].value(step.indirect_error);
  archive["sensor_error"].value(step.sensor_error);
  archive["reached_bound"].value(step.reached_bound);
  archive["seconds"].value(step.seconds);
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw_failure(printable(file.string()), error.message(), "remove it, or choose another folder with -o");
}

// Returns whether a file holds a step or the state of a block, which a finished day no longer has.
bool is_unfinished(const std::string& name) {
  return name.starts_with("step_") || name == state_file;
}

// Removes finished steps, the state of a block, and temporary files.
void remove_steps(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool aside = is_left_aside(name, settings_file) || is_left_aside(name, state_file);
    if (is_unfinished(name) || aside) files.push_back(entry.path());
  }
  for (const fs::path& file : files) remove_file(file);
}

}  // namespace

void remove_day_steps(const fs::path& result_folder) {
  const fs::path folder = result_folder / steps_folder;
  remove_steps(folder);
  remove_file(folder / settings_file);
  std::error_code not_empty;
  fs::remove(folder, not_empty);
}

bool holds_unfinished_day(const fs::path& result_folder) {
  std::error_code error;
  const fs::directory_iterator steps(result_folder / steps_folder, error);
  return std::any_of(begin(steps), end(steps),
                     [](const auto& entry) { return is_unfinished(entry.path().filename().string()); });
}

std::optional<ordered_json> noted_day_settings(const fs::path& result_folder) {
  std::error_code error;
  const fs::path file = result_folder / steps_folder / settings_file;
  if (!fs::exists(file, error)) return std::nullopt;
  return parse_settings(read_file(file));
}

StepStore::StepStore(const fs::path& result_folder, const RadiationModel& model, const ordered_json& settings,
                     StepFields fields)
    : folder_(result_folder / steps_folder),
      settings_(settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace)),
      dark_(no_light(model)),
      fields_(fields),
      field_values_(model.bands.size() * day_columns(model).size() * model.canopy.size()),
      map_values_(plane_map_values(model)) {}

StepStore::Found StepStore::find() const {
  std::optional<ordered_json> found = noted_day_settings(folder_.parent_path());
  if (!found) return Found::nothing;
  const fs::path file = folder_ / settings_file;
  ordered_json& noted = *found;
  if (!noted.is_object() || !noted.contains(finished_key)) {
    throw_input(printable(file.string()), "it is damaged", "omit --resume to start the day again");
  }
  if (!noted.contains(format_key) || noted[format_key] != step_format) {
    throw_input(printable(file.string()), "another version of the program stored that day, in another format",
                "omit --resume to start the day again");
  }
  const bool finished = noted[finished_key] == true;
  noted.erase(finished_key);
  noted.erase(format_key);
  expect_same_settings(ordered_json::parse(settings_), noted, "that day", folder_.parent_path());
  return finished ? Found::finished : Found::begun;
}

void StepStore::begin() {
  make_folder(folder_);
  remove_steps(folder_);
  write_settings(false);
}

void StepStore::finish() {
  write_settings(true);
  remove_steps(folder_);
}

std::future<void> StepStore::begin_write(std::size_t step, const StoredStep& stored) const {
  json content = {{"settings", settings_}, {"step", step}};
  visit(StoreWriter(content), stored, StepSizes{});
  // If no thread can be started, the file is written when the result of the future is requested: with a copy of `write`, since
  // std::async has moved what it was given by then.
  const auto write = [file = file_of(step), content = std::make_shared<const json>(std::move(content))] {
    write_file(file, [&](std::ostream& out) { seal(out, step_mark, *content); });
  };
  return std::async(std::launch::async | std::launch::deferred, write);
}

std::optional<StoredStep> StepStore::read(std::size_t step, StepFields fields) const {
  std::error_code error;
  if (!fs::is_regular_file(file_of(step), error)) return std::nullopt;
  const std::optional<json> content = unsealed(step_mark, read_file(file_of(step)));
  if (!content) return std::nullopt;
  try {
    if (content->at("settings") != settings_ || content->at("step") != step) return std::nullopt;
    StoredStep stored;
    stored.light = dark_;
    visit(StoreReader(*content), stored, StepSizes{fields == StepFields::kept ? field_values_ : 0, map_values_});
    return stored;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const std::runtime_error&) {  // an array cannot be unpacked
    return std::nullopt;
  }
}

RunStore StepStore::block_store(const ordered_json& settings) const {
  ordered_json all = ordered_json::parse(settings_);
  all.update(settings);
  return {folder_, all, state_file};
}

fs::path StepStore::scratch_file(std::string_view file) const {
  return folder_ / fmt::format("step_{}.tmp", file);
}

fs::path StepStore::file_of(std::size_t step) const {
  return folder_ / fmt::format("step_{:05}.bin", step);
}

void StepStore::write_settings(bool finished) const {
  ordered_json settings = ordered_json::parse(settings_);
  settings[finished_key] = finished;
  settings[format_key] = step_format;
  write_file(folder_ / settings_file, settings.dump(2) + "\n");
}

}  // namespace sunfleck
