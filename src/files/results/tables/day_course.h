#pragma once
// The course of one or several days: time and light of each step, and the sums over each date.

#include "files/results/tables/organ_kinds.h"
#include "files/results/tables/sensor_reading.h"
#include "physics/light/sun.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// One time step; the light at its middle represents all of [start, start + length_s).
struct DayStep {
  UtcTime start, middle;
  double length_s = 0.0;
  std::size_t date = 0;  // index of the date, from 0
  SunPosition sun;       // at the middle of the step
  bool lamps = false;    // whether the scene has lamps, which are always lit

  // Returns whether the sun is at or below the horizon.
  [[nodiscard]] bool night() const { return !(sun.elevation_rad > 0.0); }
  // Returns whether nothing shines; nothing is simulated then and every figure is zero.
  [[nodiscard]] bool unlit() const { return night() && !lamps; }
};

// The steps of all dates; each date covers the same local hours.
struct DayCourse {
  int offset_minutes = 0;  // local time minus UTC
  std::vector<DayStep> steps;
  std::vector<std::string> dates;  // [date], YYYY-MM-DD, local
};

// The steps of a date: first ... end - 1.
struct StepRange {
  std::size_t first = 0, end = 0;

  [[nodiscard]] std::size_t size() const { return end - first; }
};
[[nodiscard]] StepRange steps_of(const DayCourse& course, std::size_t date);
// Returns the course of a single date, so that its tables can be made from the light of its steps alone.
[[nodiscard]] DayCourse course_of(const DayCourse& course, std::size_t date);

struct StepLight {
  std::vector<BandFluxes> bands;         // [band]
  std::vector<Estimate> organ_absorbed;  // [organ * bands + band], W m-2 of the organ's one-sided area
  Estimate sunlit_leaf_fraction;
  ShadeClassResult leaf_classes;
  std::vector<Estimate> plant_absorbed_w;  // [plant * bands + band], plants as in PlantAreas
  std::vector<KindFlux> kind_absorbed;     // [kind * bands + band], W m-2 of ground, kinds as in OrganKinds
  std::vector<SensorReading> points;       // [point * bands + band], the points of all sensors one after the other
  std::vector<SensorReading> sensors;      // [sensor * bands + band], the means over the points of each sensor
  std::vector<Estimate> plane_sunfleck;    // [plane], share that the beam reaches; value NaN without a beam
  std::vector<Estimate> plane_down;        // [plane * bands + band], W m-2 downwards
  // Whether the step was simulated together with others of its date. Their errors are correlated, because they share packets:
  // in the first of them `of_shared` holds the errors of the sum over all of them, J m-2 of ground or organ and J of the plant;
  // its groups are the kinds of organs. It is 0 elsewhere.
  bool shares_packets = false;
  JointErrors of_shared;

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {  // all but shares_packets
    archive(self.bands, self.organ_absorbed, self.sunlit_leaf_fraction, self.plant_absorbed_w, self.leaf_classes.sunlit_m2,
            self.leaf_classes.shaded_m2, self.leaf_classes.absorbed_sunlit, self.leaf_classes.absorbed_shaded,
            self.leaf_classes.sunlit_sd, self.leaf_classes.shaded_sd, self.kind_absorbed, self.points, self.sensors,
            self.plane_sunfleck, self.plane_down, self.of_shared);
  }
};

// Returns the number of points of all sensors together.
[[nodiscard]] std::size_t sensor_points(const RadiationModel& model);

// Returns the light of a step from its result.
[[nodiscard]] StepLight step_light(const RadiationModel& model, const RadiationResult& result);
// Returns the light of an unlit step: all leaves are in the shade, and nothing that needs a beam has a value.
[[nodiscard]] StepLight no_light(const RadiationModel& model);

// Returns errors of 0 for every figure of the light.
[[nodiscard]] JointErrors no_joint_errors(const StepLight& light);

// Sums over the steps of a date, J m-2. Steps that were simulated by themselves have their own random numbers, so that their
// random errors are independent and add in quadrature. Those of steps that share packets follow from StepLight::of_shared. The
// unshot flux in the half-widths may err in the same direction in all steps and adds linearly. The light at sensors, which is
// measured step by step, and that through planes have no unshot part of their own.
struct DateSums {
  std::size_t steps = 0;
  std::vector<BandFluxes> bands;         // [band], J m-2 of ground
  std::vector<Estimate> organ_absorbed;  // [organ * bands + band], J m-2 of the organ's one-sided area
  std::vector<Estimate> plant_absorbed;  // [plant * bands + band], J of the whole plant
  std::vector<Estimate> kind_absorbed;   // [kind * bands + band], J m-2 of ground
  std::vector<SensorReading> sensors;    // [sensor * bands + band], J m-2, of the means over their points
  std::vector<Estimate> plane_down;      // [plane * bands + band], J m-2 downwards
};

// From J to MJ, in which tables and summaries state these sums.
inline constexpr double per_mega = 1e-6;

// Returns one entry per date, empty for a date without steps. `lights` holds the light of the first steps of the course.
[[nodiscard]] std::vector<DateSums> sum_dates(const DayCourse& course, std::span<const StepLight> lights);

// Returns the sums of a band over all dates, whose random errors are independent as those of separate steps are.
[[nodiscard]] BandFluxes sum_over_dates(std::span<const DateSums> dates, std::size_t band);

}  // namespace sunfleck
