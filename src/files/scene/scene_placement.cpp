#include "files/scene/scene_placement.h"

#include "base/check.h"
#include "physics/canopy/axes.h"
#include "physics/canopy/canopy.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace sunfleck {

namespace {

// Along the user's level axes, in the user's coordinates.
struct Extent {
  glm::dvec2 lo_m{0.0}, hi_m{0.0};
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

// Returns the extent of elements first..first + count - 1.
Extent extent_of(const Canopy& canopy, const Plot& plot, std::size_t first, std::size_t count) {
  EXPECT(first + count, <=, canopy.size());
  glm::vec3 lo = canopy.corners[first][0];
  glm::vec3 hi = lo;
  for (std::size_t e = first; e < first + count; ++e) {
    for (const glm::vec3& corner : canopy.corners[e]) {
      lo = glm::min(lo, corner);
      hi = glm::max(hi, corner);
    }
  }
  const glm::dvec3 a_m = user_position_m(plot, canopy.origin_m + glm::dvec3(lo));
  const glm::dvec3 b_m = user_position_m(plot, canopy.origin_m + glm::dvec3(hi));
  const auto [i, j] = level_axes(plot.axes);
  return {glm::min(glm::dvec2(a_m[i], a_m[j]), glm::dvec2(b_m[i], b_m[j])),
          glm::max(glm::dvec2(a_m[i], a_m[j]), glm::dvec2(b_m[i], b_m[j]))};
}

// The plot as the user sees it.
struct UserPlot {
  explicit UserPlot(const Plot& plot)
      : first(level_axes(plot.axes)[0]),
        second(level_axes(plot.axes)[1]),
        size_m(along_level_axes(plot.axes, {plot.size_x_m, plot.size_z_m})) {}

  int first, second;  // its level axes
  glm::dvec2 size_m;  // along them
};

std::string centring_cure(const GeometryPart& part, const Extent& extent, const Plot& plot) {
  const UserPlot user(plot);
  const glm::dvec2 shift_m = 0.5 * (user.size_m - extent.lo_m - extent.hi_m);
  if (part.maize) {
    const glm::dvec2 large_m = along_level_axes(
        plot.axes, {part.maize->per_row * part.maize->spacing_in_row_m, part.maize->rows * part.maize->spacing_between_rows_m});
    return fmt::format("size = [{:.6g}, {:.6g}] would be large enough", large_m.x, large_m.y);
  }
  if (part.table.has("positions")) {
    return fmt::format("adding {:.6g} to each x and {:.6g} to each {} would centre it", shift_m.x, shift_m.y,
                       "xyz"[user.second]);
  }
  const bool one = part.placements.size() == 1;
  glm::dvec3 at_m = one ? user_position_m(plot, part.placements.front().position_m) : glm::dvec3(0.0);
  at_m[user.first] += shift_m.x;
  at_m[user.second] += shift_m.y;
  const std::string list = fmt::format("[{:.6g}, {:.6g}, {:.6g}]", at_m.x, at_m.y, at_m.z);
  return one ? fmt::format("at = [{}] would centre it", list) : fmt::format("adding {} to each `at` would centre it", list);
}

void warn_of_overlap(const GeometryPart& part, const Plot& plot, std::vector<std::string>& warnings) {
  const double length_m = part.maize->per_row * part.maize->spacing_in_row_m;
  const double width_m = part.maize->rows * part.maize->spacing_between_rows_m;
  // Rounding may make a stand that fills the plot exceed its size.
  if (length_m <= plot.size_x_m * (1.0 + 1e-9) && width_m <= plot.size_z_m * (1.0 + 1e-9)) return;
  const glm::dvec2 large_m = along_level_axes(plot.axes, {length_m, width_m});
  warnings.push_back(
      fmt::format("{} makes a stand of {:.6g} x {:.6g} m, which overlaps itself when wrapped into the plot; "
                  "plot.size = [{:.6g}, {:.6g}] would be large enough",
                  part.table.place(part.source_key()), large_m.x, large_m.y, large_m.x, large_m.y));
}

void warn_of_outside(const GeometryPart& part, const Extent& extent, const Plot& plot, std::vector<std::string>& warnings) {
  const UserPlot user(plot);
  if (!stands_off(extent.lo_m.x, extent.hi_m.x, user.size_m.x) && !stands_off(extent.lo_m.y, extent.hi_m.y, user.size_m.y))
    return;
  const char first = axis_letter(plot.axes, user.first);
  const char second = axis_letter(plot.axes, user.second);
  warnings.push_back(
      fmt::format("{} extends over {} {:.6g}..{:.6g}, {} {:.6g}..{:.6g} m, outside the plot {} 0..{:.6g}, {} 0..{:.6g} m; {}",
                  part.table.place(part.source_key()), first, extent.lo_m.x, extent.hi_m.x, second, extent.lo_m.y,
                  extent.hi_m.y, first, user.size_m.x, second, user.size_m.y, centring_cure(part, extent, plot)));
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
      warn_of_outside(parts[i], extent_of(scene.model.canopy, scene.model.plot, first, count), scene.model.plot, warnings);
    }
    first += count;
  }
  return warnings;
}

}  // namespace sunfleck
