#pragma once
// The maps of a day's horizontal receivers: those of each step, as they are stored, and their sums.

#include "files/results/tables/day_course.h"
#include "files/results/tables/table.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// Returns the maps of all planes, one plane after the other, in single precision: the share of each cell that the beam reaches
// (NaN without a beam, and for cells that no ray would cross), then for each band the irradiance of each cell by the beam and
// by all light, W m-2 downwards. The cells are in the order of plane_table.
[[nodiscard]] std::vector<float> plane_maps(const RadiationModel& model, const RadiationResult& result);

// Returns the number of its values for one plane and for all.
[[nodiscard]] std::size_t plane_map_values(const RadiationModel& model, std::size_t plane);
[[nodiscard]] std::size_t plane_map_values(const RadiationModel& model);

// Sums the maps over the steps of a day or a season; needs the memory of one step's maps.
class PlaneMapSums {
 public:
  explicit PlaneMapSums(const RadiationModel& model);

  // Adds the maps of a lit step. A cell that no ray would cross counts as the mean of the others: leaving the step out would weigh
  // steps by their numbers of rays.
  void add(const DayStep& step, std::span<const float> maps);
  // Counts an unlit step.
  void add_unlit() { ++steps_; }

  // Returns the table of plane_H_day.csv: one row per cell, in the order of plane_table.
  [[nodiscard]] Table table(const DayCourse& course, std::size_t plane) const;

 private:
  struct Sums {
    std::vector<double> sunlit_s;       // [cell], time in the sun
    double known_s = 0.0;               // time with a beam
    std::vector<double> direct, total;  // [band * cells + cell], J m-2
  };

  Plot plot_;
  std::vector<Waveband> bands_;
  std::vector<PlaneReceiver> planes_;
  std::vector<Sums> sums_;  // [plane]
  std::size_t steps_ = 0;
  double beam_s_ = 0.0;  // time with a beam
};

// Returns the stem of the files of a plane's day, such as "plane_0.500_day".
[[nodiscard]] std::string plane_day_stem(const PlaneReceiver& plane);

}  // namespace sunfleck
