#pragma once
// The cells of a horizontal receiver as the user sees them: which axes they lie along, and in which order tables list them.

#include "files/results/tables/table.h"
#include "physics/canopy/plot.h"
#include "physics/transport/model/receivers.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sunfleck {

// A level axis of the user, along which the cells of a map are counted from the plot's corner at the user's origin.
struct MapAxis {
  std::string column;     // x_m, y_m or z_m
  const char* direction;  // south, east, ...
  std::uint32_t cells = 1;
  double size_m = 0.0;

  [[nodiscard]] double centre_m(std::size_t cell) const { return (static_cast<double>(cell) + 0.5) / cells * size_m; }
};

// The rows of a map's table run along `second`, and within a row along `first`.
struct UserMap {
  UserMap(std::uint32_t cells_x, std::uint32_t cells_z, const Plot& plot);
  UserMap(const PlaneReceiver& plane, const Plot& plot);

  // Returns values [z * cells_x + x] in the order of the table.
  template <class T>
  [[nodiscard]] std::vector<T> in_rows(std::vector<T> values) const {
    if (axes == Axes::south_up_west) return values;
    std::vector<T> rows;
    rows.reserve(values.size());
    for (std::uint32_t north = 0; north < second.cells; ++north) {
      for (std::uint32_t east = 0; east < first.cells; ++east) {
        rows.push_back(values[(first.cells - 1 - east) * std::size_t{second.cells} + (second.cells - 1 - north)]);
      }
    }
    return rows;
  }

  // Adds the columns of the centres of the cells to a table whose axes are `second` and `first`.
  void add_centres(Table& table) const;

  // Returns which columns the centres have and where they count towards: "x_m (south), z_m (west)".
  [[nodiscard]] std::string centres_text() const;

  Axes axes;
  MapAxis first, second;
};

}  // namespace sunfleck
