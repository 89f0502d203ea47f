#pragma once
// The finished steps of a day on disk, folder `steps` of the result folder: what its tables and fields are made from, so that
// a day that was cut short goes on where it stopped.
//
// settings.json says what the steps were computed with and whether the day is finished; its steps are gone then.
// step_00007.bin is step 7, from 0, as in io/sealed_file.h; long arrays are byte strings, little-endian and deflated (zlib).

#include "io/day_course.h"
#include "io/element_fields.h"

#include <cstdint>
#include <filesystem>
#include <future>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct StoredStep {
  StepLight light;
  std::vector<float> fields;  // [(band * columns + column) * elements + element], W m-2
  Work next_work;             // what the step after it begins with
  std::uint64_t rays = 0, packets = 0, lost_rays = 0;
  std::optional<double> direct_error, indirect_error;  // relative, as compared with the bounds
  bool reached_bound = true;
  double seconds = 0.0;
};

// Those of triangles.csv; sky columns where the scene has a sky, lit or not.
[[nodiscard]] std::vector<LightColumn> day_columns(const RadiationModel& model);
[[nodiscard]] std::vector<float> day_fields(const RadiationModel& model, const RadiationResult& result);

// Removes what a day left in `steps`, other files there stay. Throws Error (failure).
void remove_day_steps(const std::filesystem::path& result_folder);

class StepStore {
 public:
  // `settings`: a JSON object of plain values.
  StepStore(const std::filesystem::path& result_folder, const RadiationModel& model, const nlohmann::ordered_json& settings);

  enum class Found { nothing, begun, finished };
  // What an earlier day left. Throws Error (input), naming the first difference, if its settings were others.
  [[nodiscard]] Found find() const;

  void begin();   // removes what an earlier day left and notes the settings. Throws Error (failure)
  void finish();  // notes that the tables are written and removes the steps

  void write(std::size_t step, const StoredStep& stored) const;
  // The same while the caller goes on: what is to be written is copied before this returns, and the disk is waited for in
  // another thread. The future throws what `write` would throw.
  [[nodiscard]] std::future<void> begin_write(std::size_t step, const StoredStep& stored) const;
  // Empty if the step is not there, was made with other settings, or its file is damaged.
  [[nodiscard]] std::optional<StoredStep> read(std::size_t step) const;

  // Where a large file can be written before it is renamed; `begin` and `finish` remove what was left there.
  [[nodiscard]] std::filesystem::path scratch_file() const;

 private:
  [[nodiscard]] std::filesystem::path file_of(std::size_t step) const;
  void write_settings(bool finished) const;

  std::filesystem::path folder_;
  std::string settings_;  // JSON
  std::size_t bands_, organs_, field_values_;
};

}  // namespace sunfleck
