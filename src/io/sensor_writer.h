#pragma once
// sensors.csv: the readings of the scene's sensor points.

#include "io/result_writer.h"

#include <string>

namespace sunfleck {

// Returns one row per point in the order of the scene: sensor (its name), point (from 0 within its sensor), x, y, z (m, in the
// scene's axes), and for each band direct, sky and scattered, each with its half-width. The result must have readings of all
// sensors of the model.
[[nodiscard]] std::string sensors_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);

}  // namespace sunfleck
