#pragma once
// The tables of a day by time, date, organ and plant. A table can be made of all steps at once or date by date, with the same
// rows.

#include "base/units.h"
#include "files/results/tables/day_course.h"
#include "files/results/tables/day_stand.h"
#include "files/results/tables/result_writer.h"
#include "files/results/tables/table.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// The steps that a table is made of: those of a day, or those of one of its dates (course_of).
struct DayPart {
  DayPart(const DayCourse& its_course, std::span<const StepLight> its_lights)
      : course(its_course), lights(its_lights), sums(sum_dates(its_course, its_lights)) {}

  const DayCourse& course;
  // The light of the first steps of the course: of all of them, or of those finished before the day was stopped.
  std::span<const StepLight> lights;
  std::vector<DateSums> sums;  // [date]

  // Returns the numbers of the dates that have steps.
  [[nodiscard]] std::vector<std::size_t> dates() const;
};

// day.csv: one row per step.
[[nodiscard]] Table steps_table(const DayStand& stand, const DayPart& part);
// day_sums.csv: one row per date that has steps, the sums of its steps.
[[nodiscard]] Table day_sums_table(const DayStand& stand, const DayPart& part);
// season.csv: one row per date and kind of organ; its axes are date and kind.
[[nodiscard]] Table season_table(const DayStand& stand, const DayPart& part);
// organs_day.csv: the rows of organs.csv for each date that has steps; its axes are date and organ.
[[nodiscard]] Table organs_day_table(const DayStand& stand, const DayPart& part);
// plants_day.csv: the rows of plants.csv for each date that has steps; its axes are date and plant.
[[nodiscard]] Table plants_day_table(const DayStand& stand, const DayPart& part);
// What organs absorb at each step, for arrays and organs_steps.nc; its axes are step and organ.
[[nodiscard]] Table organ_steps_table(const DayStand& stand, const DayPart& part);

// A table of a day and the name of its file.
struct DayTable {
  const char* file;
  Table (*make)(const DayStand& stand, const DayPart& part);
  bool (*is_of)(const RadiationModel& model);
};
// Returns all tables of days, or those of a model: tables of planes and sensors only if it has any.
[[nodiscard]] std::span<const DayTable> day_tables();
[[nodiscard]] std::vector<DayTable> day_tables(const RadiationModel& model);

// Adds the columns `time`, the start of each step, and `date`, which vary along the first axis of a table.
void add_step_times(Table& table, const DayCourse& course);
void add_dates(Table& table, const DayPart& part);

// Adds the energy of a date and, with photon units, its photons: the columns BANDname_mj_m2 and BANDname_mol_m2. `joules` returns
// J m-2 of a row.
template <class Joules>
void add_sum(Table& table, const Waveband& band, const std::string& name, const std::string& fate, const Joules& joules) {
  table.add({band.name + name + "_mj_m2", "MJ m-2", "energy " + fate},
            [&](std::size_t row) { return joules(row).scaled(per_mega); });
  if (!(band.umol_per_joule > 0.0)) return;
  table.add({band.name + name + "_mol_m2", "mol m-2", "photons " + fate},
            [&](std::size_t row) { return joules(row).scaled(band.umol_per_joule * per_mega); });
}

// Returns a table of the whole day as text. Where the day was stopped, a line of the head says so.
[[nodiscard]] std::string day_text(const DayTable& table, const RunRecord& record, const DayStand& stand, const DayPart& day);
// Returns its head only. `part` may be any part of the day, of which the first `steps_done` steps are finished.
[[nodiscard]] std::string day_head(const DayTable& table, const RunRecord& record, const DayStand& stand, const DayPart& part,
                                   const DayCourse& whole, std::size_t steps_done);

}  // namespace sunfleck
