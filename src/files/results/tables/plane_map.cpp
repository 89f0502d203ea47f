#include "files/results/tables/plane_map.h"

#include "physics/canopy/axes.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

MapAxis axis_of(std::uint32_t cells_x, std::uint32_t cells_z, const Plot& plot, int which) {
  const int axis = level_axes(plot.axes).at(static_cast<std::size_t>(which));
  const bool along_x = (plot.axes == Axes::south_up_west) == (which == 0);
  return {fmt::format("{}_m", "xyz"[axis]), axis_direction(plot.axes, axis), along_x ? cells_x : cells_z,
          along_x ? plot.size_x_m : plot.size_z_m};
}

}  // namespace

UserMap::UserMap(std::uint32_t cells_x, std::uint32_t cells_z, const Plot& plot)
    : axes(plot.axes), first(axis_of(cells_x, cells_z, plot, 0)), second(axis_of(cells_x, cells_z, plot, 1)) {}

UserMap::UserMap(const PlaneReceiver& plane, const Plot& plot)
    : UserMap(static_cast<std::uint32_t>(plane.cells_x), static_cast<std::uint32_t>(plane.cells_z), plot) {}

void UserMap::add_centres(Table& table) const {
  const auto add = [&](const MapAxis& axis, std::size_t along) {
    table.add({axis.column, "m", fmt::format("centre of the cell, towards the {}", axis.direction), in_csv | in_arrays,
               std::vector<std::size_t>{along}},
              [&](std::size_t cell) { return axis.centre_m(cell); });
  };
  add(first, 1);
  add(second, 0);
}

std::string UserMap::centres_text() const {
  return fmt::format("{} ({}), {} ({}): m, centre of the cell", first.column, first.direction, second.column, second.direction);
}

}  // namespace sunfleck
