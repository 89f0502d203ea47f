#pragma once
// Stores the finished steps of a day in the folder `steps` of the result folder. The tables and fields are made from them, so
// an interrupted day resumes where it stopped.
//
// While a block of steps is being simulated, its state is kept too, so that no more than a few replicates are lost.
//
// settings.json holds the settings of the steps, the format and whether the day is finished; the steps of a finished day are
// removed. step_00007.bin is step 7, counted from 0, in the format of base/sealed_file.h, with long arrays as
// base/packed_array.h describes.

#include "files/results/stores/run_store.h"
#include "files/results/tables/day_course.h"
#include "files/results/tables/element_fields.h"

#include <cstdint>
#include <filesystem>
#include <future>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

struct StoredStep {
  StepLight light;
  std::vector<float> fields;  // [(band * columns + column) * elements + element], W m-2; empty unless wanted
  std::vector<float> maps;    // of all planes, as plane_maps returns them
  Work next_work;             // initial work of the next step
  std::uint64_t rays = 0, packets = 0, lost_rays = 0;
  std::optional<double> direct_error, indirect_error, sensor_error;  // relative, as compared with the bounds
  bool reached_bound = true;
  double seconds = 0.0;
};

// Removes what a day left in `steps`; other files there are kept. Throws Error (failure).
void remove_day_steps(const std::filesystem::path& result_folder);

// Returns whether the folder holds steps of a day that is not finished.
[[nodiscard]] bool holds_unfinished_day(const std::filesystem::path& result_folder);

// Returns the settings that an earlier day noted in the folder, as parse_settings does; nothing if there are none.
[[nodiscard]] std::optional<nlohmann::ordered_json> noted_day_settings(const std::filesystem::path& result_folder);

// Says whether steps have the light of every triangle, which takes most of their space.
enum class StepFields { none, kept };

class StepStore {
 public:
  // `settings` is a JSON object of plain values.
  StepStore(const std::filesystem::path& result_folder, const RadiationModel& model, const nlohmann::ordered_json& settings,
            StepFields fields);

  enum class Found { nothing, begun, finished };
  // Returns the state that an earlier day left. Throws Error (input) if another version of the program left it in another
  // format, or, naming the first difference, if its settings differ.
  [[nodiscard]] Found find() const;

  // Removes what an earlier day left and records the settings. Throws Error (failure).
  void begin();
  // Records that the tables are written and removes the steps.
  void finish();

  // Writes a step in another thread, which also waits for the disk; the data are copied before this returns. The future throws
  // Error (failure) if that fails.
  [[nodiscard]] std::future<void> begin_write(std::size_t step, const StoredStep& stored) const;
  // Returns nothing if the step is missing, was made with other settings, or its file is damaged. The fields of triangles may be
  // left out to save time.
  [[nodiscard]] std::optional<StoredStep> read(std::size_t step) const { return read(step, fields_); }
  [[nodiscard]] std::optional<StoredStep> read(std::size_t step, StepFields fields) const;

  // Returns the store of the state of the block that is being simulated; `settings` are those of the block, besides those of the
  // day.
  [[nodiscard]] RunStore block_store(const nlohmann::ordered_json& settings) const;

  // Returns the path at which a large file can be written before it is renamed to `file`; `begin` and `finish` remove any
  // file left there.
  [[nodiscard]] std::filesystem::path scratch_file(std::string_view file) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(std::size_t step) const;
  void write_settings(bool finished) const;

  std::filesystem::path folder_;
  std::string settings_;  // JSON
  StepLight dark_;        // has the sizes of the model
  StepFields fields_;
  std::size_t field_values_, map_values_;
};

}  // namespace sunfleck
