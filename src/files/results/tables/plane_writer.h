#pragma once
// Facula maps as tables: the light that comes down through a horizontal receiver, cell by cell, and the sizes of its sunflecks.

#include "files/results/tables/result_writer.h"
#include "files/results/tables/table.h"
#include "physics/transport/receivers/fleck_sizes.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck {

// Downward irradiance of each cell in one band, [cell], W m-2: of the beam, and of all light.
struct PlaneIrradiance {
  std::vector<double> direct_w_m2, total_w_m2;
};
[[nodiscard]] PlaneIrradiance plane_irradiance(const RadiationModel& model, const RadiationResult& result, std::size_t plane,
                                               std::size_t band);

// Returns the share of each cell that the direct beam reaches, [cell]; NaN for cells that no ray would cross.
[[nodiscard]] std::vector<double> plane_sunfleck(const PlaneResult& plane);

// Returns the table of PLANE.csv: one row per cell, x fastest, in the user's axes.
[[nodiscard]] Table plane_table(const RadiationModel& model, const RadiationResult& result, std::size_t plane);
[[nodiscard]] std::string plane_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result,
                                    std::size_t plane);

// Returns PLANE_flecks.csv: one row per area class of the sunflecks; no rows, and a note that says why, if the cells have too few
// rays.
[[nodiscard]] std::string plane_flecks_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result,
                                           std::size_t plane);

}  // namespace sunfleck
