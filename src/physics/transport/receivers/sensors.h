#pragma once
// Readings of sensors: rays are followed backwards, from the measuring points to the sources of light. They take no part in
// the flux ledger.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/tracer.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sunfleck {

// A bound on the error of every sensor.
struct SensorBound {
  // Relative half-width of the total, for a sensor of several points of their mean.
  double relative = 0.01;
  std::vector<double> least_w_m2;    // [band], the least total that a half-width is compared with
  std::function<bool()> time_is_up;  // asked between replicates; may be empty
  // Receives the largest error so far, and the number of rays to the sky and of scattered paths; may be empty.
  std::function<void(double relative_error, std::uint64_t rays)> report;
};

struct SensorSettings {
  // Rays for sky light and for scattered light each, from every point in every replicate; up to 2^20.
  std::uint32_t rays = 1024;
  int replicates = 8;  // at least 8
  std::uint64_t seed = 1;
  double confidence = 0.95;
  std::optional<SensorBound> bound;  // with it, each sensor is given more replicates until it holds
};

struct SensorReadings {
  std::vector<std::vector<SensorResult>> points;  // [sensor][point]
  std::vector<SensorResult> means;                // [sensor], over its points
  SensorSummary summary;                          // without `seconds`; no error without a bound
  StopReason stop = StopReason::work_done;        // bound_reached, time_spent or replicates_spent with a bound
};

// Returns the readings of the model's sensors; nothing if stopped. All are unbiased. Half-widths come from the spread between
// replicates or, where none of them saw light or all agree, from what a single ray contributes. Those of totals and of means
// come from the spread of the sum, or of the mean, between replicates.
// - direct: one ray to the sun. Exact, half-width 0.
// - sky: rays to directions drawn from the sky; for a sky of single lights one ray to each, which is exact. A uniform sky of
//   horizontal irradiance 1 reads 1 on a level plane, 1/2 on an upright one and 2 on a sphere if nothing stands in its way.
// - scattered: light that has left a surface, lamps included.
// A point below the soil plane counts as on it. A point of cosine response measures just in front of itself, so that it may
// lie on a leaf. A ray ended by the guard on crossed periods, and a path of more than 10,000 bounces, contribute no more
// light. The result is the same for any number of threads and on every tracer that lands rays alike.
[[nodiscard]] std::optional<SensorReadings> measure_sensors(const RadiationModel& model, const CounterLayout& layout,
                                                            Tracer& tracer, const SensorSettings& settings,
                                                            const StopQuestion& stop);

}  // namespace sunfleck
