#include "files/results/stores/step_store.h"

#include "base/error.h"
#include "base/file.h"
#include "base/packed_array.h"
#include "base/sealed_file.h"
#include "files/results/tables/day_fields.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view step_mark = "SUNSTEP1";
constexpr const char* steps_folder = "steps";
constexpr const char* settings_file = "settings.json";
constexpr const char* finished_key = "finished";

// Visits every number of a step's light, in the order of the file.
template <class Light, class Visit>
void for_each_number(Light& light, const Visit& visit) {
  const auto visit_estimate = [&](auto& estimate) {
    visit(estimate.value);
    visit(estimate.half_width);
  };
  for (auto& band : light.bands) {
    for (auto* term : {&band.incident, &band.absorbed_vegetation, &band.absorbed_soil, &band.reflected, &band.transmitted}) {
      visit_estimate(*term);
    }
    visit(band.unshot);
  }
  for (auto& organ : light.organ_absorbed) visit_estimate(organ);
  visit_estimate(light.sunlit_leaf_fraction);
}

std::vector<double> numbers_of(const StepLight& light) {
  std::vector<double> numbers;
  for_each_number(light, [&](double number) { numbers.push_back(number); });
  return numbers;
}

StepLight read_light(const json& packed, std::size_t bands, std::size_t organs) {
  StepLight light{std::vector<StepBand>(bands), std::vector<Estimate>(organs * bands), {}};
  const std::vector<double> numbers = unpack<double>(packed, numbers_of(light).size());
  std::size_t next = 0;
  for_each_number(light, [&](double& number) { number = numbers[next++]; });
  return light;
}

json error_json(const std::optional<double>& error) {
  return error ? json(*error) : json(nullptr);
}

std::optional<double> error_of(const json& value) {
  return value.is_null() ? std::nullopt : std::optional<double>(value.get<double>());
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw_failure(printable(file.string()), error.message(), "remove it, or choose another folder with -o");
}

// Removes finished steps and temporary files.
void remove_steps(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("step_", 0) == 0 || is_left_aside(name, settings_file)) files.push_back(entry.path());
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

StepStore::StepStore(const fs::path& result_folder, const RadiationModel& model, const ordered_json& settings)
    : folder_(result_folder / steps_folder),
      settings_(settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace)),
      bands_(model.bands.size()),
      organs_(model.canopy.organs.size()),
      field_values_(model.bands.size() * day_columns(model).size() * model.canopy.size()) {}

StepStore::Found StepStore::find() const {
  std::error_code error;
  const fs::path file = folder_ / settings_file;
  if (!fs::exists(file, error)) return Found::nothing;
  ordered_json noted = parse_settings(read_file(file));
  if (!noted.is_object() || !noted.contains(finished_key)) {
    throw_input(printable(file.string()), "it is damaged", "omit --resume to start the day again");
  }
  const bool finished = noted[finished_key] == true;
  noted.erase(finished_key);
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

void StepStore::write(std::size_t step, const StoredStep& stored) const {
  begin_write(step, stored).get();
}

std::future<void> StepStore::begin_write(std::size_t step, const StoredStep& stored) const {
  const json content = {{"settings", settings_},
                        {"step", step},
                        {"light", pack(numbers_of(stored.light))},
                        {"fields", pack(stored.fields)},
                        {"next_rays", stored.next_work.rays},
                        {"next_packets", stored.next_work.packets},
                        {"rays", stored.rays},
                        {"packets", stored.packets},
                        {"lost_rays", stored.lost_rays},
                        {"direct_error", error_json(stored.direct_error)},
                        {"indirect_error", error_json(stored.indirect_error)},
                        {"reached_bound", stored.reached_bound},
                        {"seconds", stored.seconds}};
  // If no thread can be started, the file is written when the result of the future is requested.
  return std::async(std::launch::async | std::launch::deferred,
                    [file = file_of(step), bytes = sealed(step_mark, content)] { write_file(file, bytes); });
}

std::optional<StoredStep> StepStore::read(std::size_t step) const {
  std::error_code error;
  if (!fs::is_regular_file(file_of(step), error)) return std::nullopt;
  const std::optional<json> content = unsealed(step_mark, read_file(file_of(step)));
  if (!content) return std::nullopt;
  try {
    const json& from = *content;
    if (from.at("settings") != settings_ || from.at("step") != step) return std::nullopt;
    StoredStep stored;
    stored.light = read_light(from.at("light"), bands_, organs_);
    stored.fields = unpack<float>(from.at("fields"), field_values_);
    stored.next_work = {from.at("next_rays").get<double>(), from.at("next_packets").get<double>()};
    stored.rays = whole<std::uint64_t>(from.at("rays"));
    stored.packets = whole<std::uint64_t>(from.at("packets"));
    stored.lost_rays = whole<std::uint64_t>(from.at("lost_rays"));
    stored.direct_error = error_of(from.at("direct_error"));
    stored.indirect_error = error_of(from.at("indirect_error"));
    stored.reached_bound = from.at("reached_bound").get<bool>();
    stored.seconds = from.at("seconds").get<double>();
    return stored;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const std::runtime_error&) {  // an array cannot be unpacked
    return std::nullopt;
  }
}

fs::path StepStore::scratch_file() const {
  return folder_ / "step_fields.tmp";
}

fs::path StepStore::file_of(std::size_t step) const {
  return folder_ / fmt::format("step_{:05}.bin", step);
}

void StepStore::write_settings(bool finished) const {
  ordered_json settings = ordered_json::parse(settings_);
  settings[finished_key] = finished;
  write_file(folder_ / settings_file, settings.dump(2) + "\n");
}

}  // namespace sunfleck
