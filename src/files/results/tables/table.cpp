#include "files/results/tables/table.h"

#include <functional>
#include <numeric>

namespace sunfleck {

std::size_t Table::rows() const {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::size_t Table::values_along(const std::optional<std::vector<std::size_t>>& axes) const {
  if (!axes) return rows();
  std::size_t count = 1;
  for (const std::size_t axis : *axes) count *= shape.at(axis);
  return count;
}

std::size_t Table::value_in_row(const Column& column, std::size_t row) const {
  if (!column.axes) return row;
  std::size_t value = 0;
  for (const std::size_t axis : *column.axes) {
    std::size_t rows_per_step = 1;
    for (std::size_t faster = axis + 1; faster < shape.size(); ++faster) rows_per_step *= shape[faster];
    value = value * shape[axis] + row / rows_per_step % shape[axis];
  }
  return value;
}

Estimate as_share(Estimate estimate) {
  if (estimate.value > 1.0) estimate.value = 1.0;
  return estimate;
}

}  // namespace sunfleck
