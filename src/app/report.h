#pragma once
// What a run says on standard output when it is done.

#include "io/result_writer.h"

#include <string>

namespace sunfleck {

// A short table of the balance, for people.
[[nodiscard]] std::string balance_report(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);

}  // namespace sunfleck
