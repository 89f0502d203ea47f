#pragma once
// Facula maps as tables: what comes down through a horizontal receiver, cell by cell, and how large its sunflecks are.

#include "io/result_writer.h"
#include "transport/fleck_sizes.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck {

// The stem of a plane's files: "plane_0.500".
[[nodiscard]] std::string plane_stem(double height_m);

// [cell], W m-2 downwards in a band: of the beam, and of all light.
struct PlaneIrradiance {
  std::vector<double> direct_w_m2, total_w_m2;
};
[[nodiscard]] PlaneIrradiance plane_irradiance(const RadiationModel& model, const RadiationResult& result, std::size_t plane,
                                               std::size_t band);

// [cell], the share of the cell that the direct beam reaches; NaN where no ray would cross it.
[[nodiscard]] std::vector<double> plane_sunfleck(const PlaneResult& plane);

// PLANE.csv: a row per cell, x fastest; x_m, z_m are its centre, sunfleck is empty where no ray would cross it.
[[nodiscard]] std::string plane_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result,
                                    std::size_t plane);

// PLANE_flecks.csv: a row per class of area.
[[nodiscard]] std::string plane_flecks_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result,
                                           std::size_t plane);

}  // namespace sunfleck
