#pragma once
// Simulates a day in memory, without a folder.

#include "files/results/tables/day_course.h"
#include "files/results/tables/plane_day.h"
#include "files/results/tables/result_writer.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/solve/solve.h"
#include "simulate/day_plan.h"
#include "simulate/requests.h"

#include <string>
#include <vector>

namespace sunfleck {

struct InMemoryDay {
  Scene scene;
  DayPlan plan;
  RunRecord record;
  std::vector<StepLight> lights;  // [step]; fewer than the plan has if stopped
  // W m-2, [step][(band * columns + column) * elements + element], as of day_fields, and [step], as of plane_maps; empty in
  // unlit steps, and in all of them unless work.triangle_light
  std::vector<std::vector<float>> fields, maps;
  bool triangle_light = false;
  PlaneMapSums plane_sums;  // of the finished steps
  std::string summary;      // summary.json
};

// Simulates a scene that was read for a day; the result equals that of the command `day` with these requests, bit for bit.
// Keeps the light of every triangle and the maps of every step if work.triangle_light. `work.max_seconds` and
// monitor.interrupted stop the day and discard the unfinished step. The monitor's report covers the whole day. Throws Error as
// `day` does.
[[nodiscard]] InMemoryDay simulate_in_memory(Scene scene, const DayRequest& request, const WorkRequest& work,
                                             const DeviceRequest& device, const Monitor& monitor);

// Returns whether the light of every triangle is kept unless the user decides otherwise: for a single date, if it takes at most
// a quarter of the free memory.
[[nodiscard]] bool keeps_triangles(const DayRequest& request, const Scene& scene);

}  // namespace sunfleck
