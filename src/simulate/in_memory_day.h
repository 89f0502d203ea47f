#pragma once
// A day that is simulated in memory, without a folder.

#include "io/day_course.h"
#include "io/result_writer.h"
#include "io/scene_reader.h"
#include "simulate/day_plan.h"
#include "simulate/requests.h"
#include "transport/solve.h"

#include <string>
#include <vector>

namespace sunfleck {

struct InMemoryDay {
  Scene scene;
  DayPlan plan;
  RunRecord record;
  std::vector<StepLight> lights;           // [step]; fewer than the plan has if stopped
  std::vector<std::vector<float>> fields;  // [step][(band * columns + column) * elements + element], W m-2; empty by night
  std::string summary;                     // summary.json
};

// Simulates a scene that was read for a day, without its planes and sensors; the result is that of the command `day` with these
// requests, bit for bit. `work.max_seconds` and monitor.interrupted stop the day: the step that is not whole is left out. The
// monitor's report is of the whole day. Throws Error as `day` does.
[[nodiscard]] InMemoryDay simulate_in_memory(Scene scene, const DayRequest& request, const WorkRequest& work,
                                             const DeviceRequest& device, const Monitor& monitor);

}  // namespace sunfleck
