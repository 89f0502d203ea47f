#pragma once
// The course of days, step by step: when each step is, what light it found, and the sums over a date.

#include "light/sun.h"
#include "transport/model.h"
#include "transport/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// A step stands for all of [start, start + length_s) with the light of its middle.
struct DayStep {
  UtcTime start, middle;
  double length_s = 0.0;
  std::size_t date = 0;  // number of its date, from 0
  SunPosition sun;       // at the middle

  // The sun at or below the horizon: nothing is simulated, every figure is zero.
  [[nodiscard]] bool night() const { return !(sun.elevation_rad > 0.0); }
};

// Dates of the same local hours each.
struct DayCourse {
  int offset_minutes = 0;  // local time minus UTC
  std::vector<DayStep> steps;
  std::vector<std::string> dates;  // [date], YYYY-MM-DD, local
};

// 2002-08-08T05:00:00+08:00
[[nodiscard]] std::string local_time_text(const UtcTime& time, int offset_minutes);

// W m-2 of ground.
struct StepBand {
  Estimate incident, absorbed_vegetation, absorbed_soil, reflected, transmitted;
  double unshot = 0.0;  // contained in the half-widths, as in BandResult
};

struct StepLight {
  std::vector<StepBand> bands;           // [band]
  std::vector<Estimate> organ_absorbed;  // [organ * bands + band], W m-2 of the organ's one-sided area
  Estimate sunlit_leaf_fraction;
};

// The incident flux of a periodic plot is what comes in, without error; that of an isolated one is counted by rays, and its
// half-width is at most the sum of those of where it went, whatever their correlation.
[[nodiscard]] StepLight step_light(const RadiationModel& model, const RadiationResult& result);
[[nodiscard]] StepLight night_light(const RadiationModel& model);

// Sums over the steps of a date, J m-2. The steps' random errors are independent, since each has its own random numbers, and
// add up as squares; what the half-widths hold of unshot flux may err the same way in all steps, and adds up as it is.
struct DateSums {
  std::size_t steps = 0;
  std::vector<StepBand> bands;
  std::vector<Estimate> organ_absorbed;  // [organ * bands + band], per one-sided area
};

// `lights` are those of the first steps. One entry a date.
[[nodiscard]] std::vector<DateSums> sum_dates(const RadiationModel& model, const DayCourse& course,
                                              std::span<const StepLight> lights);

}  // namespace sunfleck
