#include "files/results/stores/run_store.h"

#include "base/archive.h"
#include "base/error.h"
#include "base/file.h"
#include "base/sealed_file.h"

#include <ostream>
#include <stdexcept>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view state_mark = "SUNRUNSA";

// Returns whether the file begins with the letters of a run's state and the digit of another version.
bool is_of_another_version(std::string_view bytes) {
  const std::size_t digit = state_mark.size() - 1;
  return bytes.size() > digit && bytes.substr(0, digit) == state_mark.substr(0, digit) && bytes[digit] != state_mark[digit] &&
         bytes[digit] >= '0' && bytes[digit] <= '9';
}

[[noreturn]] void throw_damaged(const fs::path& file) {
  throw_input(printable(file.string()), "it is damaged", "omit --resume to start the run again");
}

// Writes or reads a state of that shape.
template <class Archive, class State>
void visit(const Archive& archive, State& state, const StateShape& shape) {
  archive["rays"].value(state.work.rays);
  archive["packets"].value(state.work.packets);
  archive["ray_shares"].value(state.ray_shares, 0.0, 1.0);
  archive["next_check"].value(state.next_check);
  archive["integers"].packed(state.sums.integers, shape.integers);
  archive["reals"].packed(state.sums.reals, shape.reals);
}

}  // namespace

RunStore::RunStore(const fs::path& result_folder, const ordered_json& settings, const fs::path& file)
    : folder_(result_folder),
      file_(result_folder / file),
      settings_(settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace)) {}

bool RunStore::exists() const {
  std::error_code error;
  return fs::exists(file_, error);
}

std::optional<SolveState> RunStore::read(const StateShape& shape) const {
  if (!exists()) return std::nullopt;
  const std::string bytes = read_file(file_);
  if (is_of_another_version(bytes)) {
    throw_input(printable(file_.string()), "another version of the program wrote it, in another format",
                "omit --resume to start the run again");
  }
  const std::optional<json> content = unsealed(state_mark, bytes);
  if (!content || !content->is_object() || !content->contains("settings") || !content->at("settings").is_string()) {
    throw_damaged(file_);
  }
  const ordered_json noted = parse_settings(content->at("settings").get<std::string>());
  if (!noted.is_object()) throw_damaged(file_);
  expect_same_settings(ordered_json::parse(settings_), noted, "that run", folder_);
  try {
    SolveState state;
    visit(StoreReader(*content), state, shape);
    if (is_state_of(state, shape)) return state;
  } catch (const json::exception&) {  // the content is that of no state
  } catch (const std::runtime_error&) {
  }
  throw_damaged(file_);
}

void RunStore::write(const SolveStateView& state) const {
  json content = {{"settings", settings_}};
  visit(StoreWriter(content), state, StateShape());
  write_file(file_, [&](std::ostream& out) { seal(out, state_mark, content); });
}

void RunStore::remove() const {
  std::error_code error;
  fs::remove(file_, error);
  if (error) throw_failure(printable(file_.string()), error.message(), "remove it; the run is finished");
}

}  // namespace sunfleck
