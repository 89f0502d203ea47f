#pragma once
// A day that is simulated in memory, without a folder.

#include "app/day_plan.h"
#include "app/options.h"
#include "io/day_course.h"
#include "io/result_writer.h"
#include "io/scene_reader.h"
#include "transport/solve.h"

#include <string>
#include <vector>

namespace sunfleck {

struct KeptDay {
  Scene scene;
  DayPlan plan;
  RunRecord record;
  std::vector<StepLight> lights;           // [step]; fewer than the plan has if stopped
  std::vector<std::vector<float>> fields;  // [step][(band * columns + column) * elements + element], W m-2; empty by night
  std::string summary;                     // summary.json
};

// A scene that was read for a day, its planes and sensors left out, as `day` does; what it computes is what `day` computes with
// these options, bit for bit. Of the options those count that say when, how exact, with which seed, device and threads.
// `max_seconds` and monitor.interrupted stop it between steps: the step that is not whole is left out. The monitor's report is
// of the whole day. Throws Error as `day` does.
[[nodiscard]] KeptDay simulate_day(Scene scene, const DayOptions& options, const Monitor& monitor);

}  // namespace sunfleck
