#pragma once
// Plans the steps of a day: combines the options of `day` with the scene's place and weather.

#include "files/results/tables/day_course.h"
#include "files/scene/moment_light.h"
#include "files/scene/scene_reader.h"
#include "simulate/requests.h"

#include <string>
#include <vector>

namespace sunfleck {

inline constexpr std::size_t most_day_steps = 60000;  // more than a year of ten-minute steps

// Consecutive steps of one date that are simulated together, first ... end - 1. A block of one step may be dark; no other is,
// and no step of a block is unlit.
struct DayBlock {
  std::size_t first = 0, end = 0;

  [[nodiscard]] std::size_t size() const { return end - first; }
};

struct DayPlan {
  DayCourse course;
  std::vector<MomentLight> lights;  // [step], at its middle; unlit steps have no bands
  int from_min = 0, to_min = 0;     // local clock, minutes since midnight
  std::vector<DayBlock> blocks;     // of all lit steps; empty before plan_blocks (simulate/day_blocks.h)
};

// Plans the steps. Options that are not given default to the scene's own date, and to sunrise and sunset of all dates, rounded
// outwards to whole steps. Throws Error (input) for times and dates that do not exist or are out of order, too many steps, a
// scene whose light has no course over the day, and weather that does not cover a step.
[[nodiscard]] DayPlan plan_day(const DayRequest& request, const Scene& scene);

// Returns a warning, or none, about measured light that is left out because it came while the sun was below the horizon at the
// middle of a step, if that is more than half a percent of it.
[[nodiscard]] std::vector<std::string> plan_warnings(const DayPlan& plan, const Scene& scene);

// Returns HH:MM.
[[nodiscard]] std::string clock_text(int minutes);

}  // namespace sunfleck
