#pragma once
// The folder with the results of `run`: tables, exports, plots, pictures and the summary.

#include "base/folder_lock.h"
#include "files/formats/measured/measured_reader.h"
#include "files/results/tables/profile_table.h"
#include "simulate/interrupt.h"
#include "simulate/requests.h"
#include "simulate/simulated_scene.h"
#include "simulate/unwritten_files.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

inline constexpr const char* summary_file = "summary.json";

// Returns the summary in a folder; nothing if there is none, or if the file is not a JSON object.
[[nodiscard]] std::optional<nlohmann::json> summary_in(const std::filesystem::path& folder);
// Returns the command whose result that is: "run" or "day".
[[nodiscard]] nlohmann::json command_of(const nlohmann::json& summary);

// Returns the words that ResultRequest::images may hold: file stems, profile, planes, all and none.
[[nodiscard]] std::vector<std::string> image_words();

// Returns the folder for the results of a scene.
[[nodiscard]] std::filesystem::path result_folder(const ResultRequest& request, const std::filesystem::path& scene);

// Says what to do with the files of an earlier run, so that the folder never holds parts of two runs.
enum class OldResults { remove_all, keep_checkpoint };

// The two kinds of results that a folder may hold, never together.
enum class ResultOf { run, day };

// Returns the command whose result the folder holds, quoted, if it is another than this; nothing for one that has only begun.
[[nodiscard]] std::optional<std::string> other_result_in(const std::filesystem::path& folder, ResultOf result);

// Refuses a folder in which a result would replace a file that the scene was read from, or unfinished work of the other kind, which
// --resume could continue. Throws Error (input).
void check_folder(const std::filesystem::path& folder, const Scene& scene, ResultOf result);

// Says that a finished run or day (`work`) lacks a file; returns nothing if its folder has it.
[[nodiscard]] std::optional<std::string> lack_of(const std::filesystem::path& folder, std::string_view work,
                                                 const std::string& file);
inline constexpr const char* cure_of_lack = "leave --resume out to compute it again";

// Creates, locks and test-writes the folder before any ray is traced, so that no result is lost at the end, and warns if a
// result of the other kind is replaced. Throws Error (failure).
void prepare_folder(const std::filesystem::path& folder, FolderLock& lock, ResultOf result,
                    OldResults old = OldResults::remove_all);

// Prepares the folder of a day that resumes its earlier work there: keeps its steps, marks the summary as incomplete, and
// removes files that were left half-written.
void reopen_folder(const std::filesystem::path& folder);

// Curves drawn beside a run's own profile.
struct ProfileOverlays {
  std::optional<MeasuredProfile> measured;
  std::vector<ProfileTable> results;
};
// Reads the overlays, before any work starts. Throws Error (input).
[[nodiscard]] ProfileOverlays read_overlays(const ResultRequest& request, const RadiationModel& model);

// Throws Error (input) for pictures that the scene cannot provide, and warns of planes if it has none.
void check_pictures(const ResultRequest& request, const RadiationModel& model);

// Returns whether exports or pictures show the light of single triangles, which the simulation must then estimate.
[[nodiscard]] bool shows_triangles(const ResultRequest& request);

// What drawing needs in addition to the result.
struct DrawingHooks {
  ProfileOverlays overlays;
  StopQuestion stop = interrupted;  // leaves the remaining pictures out
};

// Writes everything into the prepared folder, the summary last. Completes the record, which begins as the result's own, with
// the unwritten files and the time taken. Returns the files that could not be written; the others are complete.
[[nodiscard]] UnwrittenFiles write_whole_result(const std::filesystem::path& folder, const ResultRequest& request,
                                                const SimulatedScene& simulated, RunRecord& record,
                                                const DrawingHooks& hooks = {});

}  // namespace sunfleck
