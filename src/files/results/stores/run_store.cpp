#include "files/results/stores/run_store.h"

#include "base/error.h"
#include "base/file.h"
#include "base/packed_array.h"
#include "base/sealed_file.h"

#include <cstdint>
#include <stdexcept>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view state_mark = "SUNRUNS1";

[[noreturn]] void throw_damaged(const fs::path& file) {
  throw_input(printable(file.string()), "it is damaged", "omit --resume to start the run again");
}

// Reads a state. Throws std::runtime_error or json::exception if the content is not a valid state.
SolveState state_of(const json& from, const SolveState& blank) {
  SolveState state;
  state.work = {from.at("rays").get<double>(), from.at("packets").get<double>()};
  state.next_check = whole<std::size_t>(from.at("next_check"));
  state.good_checks = whole<std::size_t>(from.at("good_checks"));
  state.sums.integers = unpack<std::int64_t>(from.at("integers"), blank.sums.integers.size());
  state.sums.reals = unpack<double>(from.at("reals"), blank.sums.reals.size());
  if (!is_state_of(state, blank)) throw std::runtime_error("no run was ever in that state");
  return state;
}

}  // namespace

RunStore::RunStore(const fs::path& result_folder, const ordered_json& settings)
    : folder_(result_folder),
      file_(result_folder / run_state_file),
      settings_(settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace)) {}

std::optional<SolveState> RunStore::read(const SolveState& blank) const {
  std::error_code error;
  if (!fs::exists(file_, error)) return std::nullopt;
  const std::optional<json> content = unsealed(state_mark, read_file(file_));
  if (!content || !content->is_object() || !content->contains("settings") || !content->at("settings").is_string()) {
    throw_damaged(file_);
  }
  const ordered_json noted = parse_settings(content->at("settings").get<std::string>());
  if (!noted.is_object()) throw_damaged(file_);
  expect_same_settings(ordered_json::parse(settings_), noted, "that run", folder_);
  try {
    return state_of(*content, blank);
  } catch (const json::exception&) {
    throw_damaged(file_);
  } catch (const std::runtime_error&) {
    throw_damaged(file_);
  }
}

void RunStore::write(const SolveState& state) const {
  const json content = {
      {"settings", settings_},          {"rays", state.work.rays},          {"packets", state.work.packets},
      {"next_check", state.next_check}, {"good_checks", state.good_checks}, {"integers", pack(state.sums.integers)},
      {"reals", pack(state.sums.reals)}};
  write_file(file_, sealed(state_mark, content));
}

void RunStore::remove() const {
  std::error_code error;
  fs::remove(file_, error);
  if (error) throw_failure(printable(file_.string()), error.message(), "remove it; the run is finished");
}

}  // namespace sunfleck
