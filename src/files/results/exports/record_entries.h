#pragma once
// The record of a run as it stands in exported files.

#include "files/results/tables/result_writer.h"
#include "physics/transport/model/model.h"

#include <string>
#include <vector>

namespace sunfleck {

// One entry of a run's record as text.
struct RecordEntry {
  std::string key;
  std::string value;  // valid UTF-8, one line
};

// Returns the entries of a run's record: its settings, but neither the device nor the run time.
[[nodiscard]] std::vector<RecordEntry> record_entries(const RunRecord& record, const RadiationModel& model);

}  // namespace sunfleck
