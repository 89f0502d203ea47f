#pragma once
// The folder that `run` fills: tables, exports, plots and pictures.

#include "app/losses.h"
#include "app/options.h"
#include "app/pictures.h"
#include "io/folder_lock.h"
#include "io/measured_reader.h"
#include "io/profile_table.h"
#include "io/result_writer.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace sunfleck {

// Where a run's results go.
[[nodiscard]] std::filesystem::path result_folder(const RunOptions& options);

// What an earlier run left: all goes, so that the folder never holds pieces of two; or the state that is gone on from stays.
enum class EarlierRun { goes, goes_on };

// Made, locked, and tried, before rays are traced: nothing of that shall be lost for want of a folder. Throws Error (failure).
void prepare_folder(const std::filesystem::path& folder, FolderLock& lock, EarlierRun earlier = EarlierRun::goes);

// The same for a day that goes on with what it left there.
void reopen_folder(const std::filesystem::path& folder);

// What is drawn beside a run's own profile, read before any work starts. Throws Error (input).
struct Companions {
  std::optional<MeasuredProfile> measured;
  std::vector<ProfileTable> results;
};
[[nodiscard]] Companions read_companions(const RunOptions& options, const RadiationModel& model);

// Throws Error (input) for pictures that the scene cannot give.
void check_pictures(const RunOptions& options, const RadiationModel& model);

// Everything but the summary. What cannot be written is among the losses, and the rest goes on. False if interrupted before
// all pictures were drawn.
[[nodiscard]] bool write_results(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
                                 const Drawing& drawing, const Companions& companions, Losses& losses);

// For a folder whose `work`, run or day, is finished: says so, or prints its summary where --json asks for it. Returns the exit
// status.
[[nodiscard]] int tell_finished(const std::filesystem::path& folder, const RunOptions& options, std::string_view work);

// The summary into its file, and to the user what was asked for; that too where the file is lost.
void publish(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
             const RadiationModel& model, const RadiationResult& result, Losses& losses);

}  // namespace sunfleck
