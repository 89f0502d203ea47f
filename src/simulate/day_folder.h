#pragma once
// The folder with the results of a day: its tables, netCDF files and plots, all made from the stored steps. Only the steps of one
// date are in memory at a time, and of netCDF files with values of triangles or cells only one step.

#include "files/results/stores/step_store.h"
#include "files/results/tables/day_course.h"
#include "files/results/tables/result_writer.h"
#include "simulate/requests.h"
#include "simulate/unwritten_files.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace sunfleck {

// The finished steps of a day.
struct FinishedSteps {
  const RunRecord& record;
  const RadiationModel& model;
  const DayCourse& course;
  const StepStore& store;
  std::size_t steps = 0;  // their number, from the first
};

struct WrittenDay {
  std::vector<DateSums> sums;  // [date], of bands only
  UnwrittenFiles unwritten;    // the files that could not be written; the others are complete
};

// Returns whether the steps of a day must have the light of every triangle: for day.nc, which a single date has unless the exports
// say none, and several dates have only if it is asked for.
[[nodiscard]] StepFields wanted_fields(const ResultRequest& request, const DayCourse& course);

// Writes everything but the summary into the folder. Throws Error (failure) if a stored step is missing or damaged.
[[nodiscard]] WrittenDay write_day_files(const std::filesystem::path& folder, const ResultRequest& request,
                                         const FinishedSteps& day);

// Returns whether a day writes a file of this name, other than the summary and those of planes.
[[nodiscard]] bool is_file_of_days(const std::filesystem::path& name);

}  // namespace sunfleck
