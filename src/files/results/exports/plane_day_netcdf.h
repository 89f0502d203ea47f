#pragma once
// Writes plane_H_day.nc: the map of a horizontal receiver at every step, as netCDF-4 with CF 1.8 attributes (xarray, R).

#include "files/results/tables/day_course.h"
#include "files/results/tables/result_writer.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

namespace sunfleck {

struct PlaneSteps {
  const RunRecord& record;
  const RadiationModel& model;
  const DayCourse& course;
  std::size_t steps = 0;  // number of steps to write, from the first, > 0
  std::size_t plane = 0;
  // Returns the maps of a step that is not unlit, of all planes, laid out as by plane_maps (files/results/tables/plane_day.h).
  std::function<std::vector<float>(std::size_t step)> maps;
};

// Writes the dimension time and two for the cells, with their centres as coordinates: the sunlit share of each cell and, for each
// band, the irradiance by the beam and by all light, in single precision. In an unlit step irradiances are zero, shares are
// missing. Holds one step in memory at a time. Writes to `aside`, which must be on the same file system, and renames it. Throws
// Error (failure).
void write_plane_steps(const std::filesystem::path& file, const std::filesystem::path& aside, const PlaneSteps& plane);

}  // namespace sunfleck
