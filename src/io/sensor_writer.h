#pragma once
// sensors.csv: what the points of a scene's sensors read.

#include "io/result_writer.h"

#include <string>

namespace sunfleck {

// A row for each point in the order of the scene: sensor (its name), point (from 0 on within its sensor), x, y, z (m, scene's
// axes), and by band direct, sky and scattered, each with its half-width. The result has readings of all the model's sensors.
[[nodiscard]] std::string sensors_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);

}  // namespace sunfleck
