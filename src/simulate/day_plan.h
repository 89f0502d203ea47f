#pragma once
// Which steps a day has: what the options of `day` ask for, laid over the scene's place and weather.

#include "io/day_course.h"
#include "io/moment_light.h"
#include "io/scene_reader.h"
#include "simulate/requests.h"

#include <vector>

namespace sunfleck {

inline constexpr std::size_t most_day_steps = 10000;

struct DayPlan {
  DayCourse course;
  std::vector<MomentLight> lights;  // [step], at its middle; night steps without bands
  int from_min = 0, to_min = 0;     // local clock, minutes since midnight
};

// The scene's own date, and sunrise to sunset of all dates rounded outwards to whole steps, where the options leave them open.
// Throws Error (input) for times and dates that do not exist or are out of order, too many steps, a scene without a course of
// its light, and weather that has nothing for a step.
[[nodiscard]] DayPlan plan_day(const DayRequest& request, const Scene& scene);

[[nodiscard]] std::string clock_text(int minutes);  // HH:MM

}  // namespace sunfleck
