#pragma once
// The folder that `run` fills: tables, exports, plots, pictures and the summary.

#include "io/folder_lock.h"
#include "io/measured_reader.h"
#include "io/profile_table.h"
#include "simulate/requests.h"
#include "simulate/simulated_scene.h"
#include "simulate/unwritten_files.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace sunfleck {

inline constexpr const char* summary_file = "summary.json";

// Returns where the results of a scene go.
[[nodiscard]] std::filesystem::path result_folder(const ResultRequest& request, const std::filesystem::path& scene);

// What to do with the files of an earlier run, so that the folder never holds pieces of two.
enum class OldResults { remove_all, keep_checkpoint };

// Creates, locks and test-writes the folder before any ray is traced, so that no result is lost at the end. Throws Error
// (failure).
void prepare_folder(const std::filesystem::path& folder, FolderLock& lock, OldResults old = OldResults::remove_all);

// The same for a day that resumes what it left there.
void reopen_folder(const std::filesystem::path& folder);

// What is drawn beside a run's own profile.
struct ProfileOverlays {
  std::optional<MeasuredProfile> measured;
  std::vector<ProfileTable> results;
};
// Reads them, before any work starts. Throws Error (input).
[[nodiscard]] ProfileOverlays read_overlays(const ResultRequest& request, const RadiationModel& model);

// Throws Error (input) for pictures that the scene cannot give.
void check_pictures(const ResultRequest& request, const RadiationModel& model);

// Returns whether an export shows errors of single triangles, which the simulation must then keep.
[[nodiscard]] bool needs_triangle_errors(const std::vector<std::string>& exports);

// Writes everything into the prepared folder, the summary last, and completes the record, which begins as the result's own,
// with what was not written and how long it took. Returns the files that could not be written; the others are there.
[[nodiscard]] UnwrittenFiles write_whole_result(const std::filesystem::path& folder, const ResultRequest& request,
                                                const SimulatedScene& simulated, RunRecord& record,
                                                const ProfileOverlays& overlays = {});

}  // namespace sunfleck
