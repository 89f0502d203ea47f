#include "files/scene/scene_placement.h"

#include "base/check.h"
#include "physics/canopy/canopy.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>

namespace sunfleck {

namespace {

struct Extent {
  double x_lo = 0.0, x_hi = 0.0, z_lo = 0.0, z_hi = 0.0;
};

// Returns how far an interval extends beyond 0..size.
double overhang(double lo, double hi, double size) {
  return std::max({0.0, -lo, hi - size});
}

// Returns whether centring the interval would clearly reduce its overhang beyond 0..size. Tolerates a tenth of the plot,
// because the leaves of a stand extend over its border.
bool stands_off(double lo, double hi, double size) {
  const double centred = std::max(0.0, 0.5 * (hi - lo - size));
  return overhang(lo, hi, size) > centred + 0.1 * size;
}

// Returns the extent of elements first..first + count - 1 in the scene's frame.
Extent extent_of(const Canopy& canopy, std::size_t first, std::size_t count) {
  EXPECT(first + count, <=, canopy.size());
  glm::vec3 lo = canopy.corners[first][0];
  glm::vec3 hi = lo;
  for (std::size_t e = first; e < first + count; ++e) {
    for (const glm::vec3& corner : canopy.corners[e]) {
      lo = glm::min(lo, corner);
      hi = glm::max(hi, corner);
    }
  }
  const glm::dvec3& origin = canopy.origin_m;
  return {origin.x + lo.x, origin.x + hi.x, origin.z + lo.z, origin.z + hi.z};
}

std::string centring_cure(const GeometryPart& part, const Extent& extent, const Plot& plot) {
  const double dx = 0.5 * (plot.size_x_m - extent.x_lo - extent.x_hi);
  const double dz = 0.5 * (plot.size_z_m - extent.z_lo - extent.z_hi);
  if (part.maize) {
    return fmt::format("size = [{:.6g}, {:.6g}] would be large enough", part.maize->per_row * part.maize->spacing_in_row_m,
                       part.maize->rows * part.maize->spacing_between_rows_m);
  }
  if (part.table.has("positions")) return fmt::format("adding {:.6g} to each x and {:.6g} to each z would centre it", dx, dz);
  if (part.placements.size() > 1) return fmt::format("adding [{:.6g}, 0, {:.6g}] to each `at` would centre it", dx, dz);
  const glm::dvec3& at = part.placements.front().position_m;
  return fmt::format("at = [[{:.6g}, {:.6g}, {:.6g}]] would centre it", at.x + dx, at.y, at.z + dz);
}

void warn_of_overlap(const GeometryPart& part, const Plot& plot, std::vector<std::string>& warnings) {
  const double length_m = part.maize->per_row * part.maize->spacing_in_row_m;
  const double width_m = part.maize->rows * part.maize->spacing_between_rows_m;
  // Rounding may make a stand that fills the plot exceed its size.
  if (length_m <= plot.size_x_m * (1.0 + 1e-9) && width_m <= plot.size_z_m * (1.0 + 1e-9)) return;
  warnings.push_back(
      fmt::format("{} makes a stand of {:.6g} x {:.6g} m, which overlaps itself when wrapped into the plot; "
                  "plot.size = [{:.6g}, {:.6g}] would be large enough",
                  part.table.place(part.source_key()), length_m, width_m, length_m, width_m));
}

void warn_of_outside(const GeometryPart& part, const Extent& extent, const Plot& plot, std::vector<std::string>& warnings) {
  if (!stands_off(extent.x_lo, extent.x_hi, plot.size_x_m) && !stands_off(extent.z_lo, extent.z_hi, plot.size_z_m)) return;
  warnings.push_back(
      fmt::format("{} extends over X {:.6g}..{:.6g}, Z {:.6g}..{:.6g} m, outside the plot X 0..{:.6g}, "
                  "Z 0..{:.6g} m; {}",
                  part.table.place(part.source_key()), extent.x_lo, extent.x_hi, extent.z_lo, extent.z_hi, plot.size_x_m,
                  plot.size_z_m, centring_cure(part, extent, plot)));
}

}  // namespace

std::vector<std::string> placement_warnings(std::span<const GeometryPart> parts, std::span<const PlacedMesh> meshes,
                                            const Scene& scene) {
  std::vector<std::string> warnings;
  std::size_t first = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t count = meshes[i].mesh.triangles.size() * meshes[i].placements.size();
    if (scene.model.plot.periodic) {
      if (parts[i].maize) warn_of_overlap(parts[i], scene.model.plot, warnings);
    } else if (count > 0) {
      warn_of_outside(parts[i], extent_of(scene.model.canopy, first, count), scene.model.plot, warnings);
    }
    first += count;
  }
  return warnings;
}

}  // namespace sunfleck
