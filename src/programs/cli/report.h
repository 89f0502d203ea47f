#pragma once
// Makes the report of a finished run for standard output.

#include "files/results/tables/result_writer.h"

#include <string>

namespace sunfleck {

// Returns a short table of the balance, for people to read.
[[nodiscard]] std::string balance_report(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);

}  // namespace sunfleck
