#pragma once
// The tables of a day's planes and sensors. Steps and dates are rows as in files/results/tables/day_tables.h.

#include "files/results/tables/day_tables.h"

namespace sunfleck {

// sensors_day.csv: the rows of sensors.csv for each step; its axes are step and point, the points of all sensors.
[[nodiscard]] Table sensors_day_table(const DayStand& stand, const DayPart& part);
// sensor_means_day.csv: the rows of sensor_means.csv for each step; its axes are step and sensor.
[[nodiscard]] Table sensor_means_day_table(const DayStand& stand, const DayPart& part);
// sensor_day_sums.csv: one row per date and sensor, the sums of its means over the steps.
[[nodiscard]] Table sensor_day_sums_table(const DayStand& stand, const DayPart& part);

// planes_day.csv: one row per step and plane; its axes are these.
[[nodiscard]] Table planes_day_table(const DayStand& stand, const DayPart& part);
// plane_day_sums.csv: one row per date and plane, the sums over its steps.
[[nodiscard]] Table plane_day_sums_table(const DayStand& stand, const DayPart& part);

}  // namespace sunfleck
