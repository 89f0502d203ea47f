#pragma once
// A table of results. Each column states once its name, unit and meaning and holds its values; CSV, netCDF, VTK, PLY and the
// arrays of Python are made from it. A column NAME_error holds the half-widths of the confidence intervals of the column NAME, in
// its unit; a half-width relative to its value is named NAME_relative_error.

#include "physics/transport/model/statistics.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace sunfleck {

// The outputs that show a column, as bits.
enum Outputs : unsigned {
  in_csv = 1,     // the table as text
  in_arrays = 2,  // the dicts of Python
  in_netcdf = 4,  // results.nc, day.nc and xarray
  in_meshes = 8   // canopy.vtp and canopy.ply
};

struct RowNumbers {
  std::size_t count = 0;  // the values are 0 ... count - 1
};
using ColumnValues = std::variant<RowNumbers, std::span<const double>, std::span<const std::int32_t>,
                                  std::span<const std::uint32_t>, std::span<const std::string>>;

struct Column {
  std::string name;
  std::string unit;  // 1 for dimensionless numbers, empty for texts
  std::string meaning;
  unsigned outputs = in_csv | in_arrays;
  // The axes of the table along which the values vary, the last fastest; no list: all axes, an empty list: one value for all
  // rows.
  std::optional<std::vector<std::size_t>> axes = {};
  std::optional<std::span<const std::string>> categories = {};  // names of the values 0, 1, ...; none for plain numbers
  std::string error_column = {};                                // name of the column of its half-widths; empty if there is none
  ColumnValues values = RowNumbers{};                           // NaN where there is no value
  std::shared_ptr<const void> owner = {};                       // keeps the values alive; null if the maker of the table does

  [[nodiscard]] bool is_in(Outputs output) const { return (outputs & output) != 0; }
};

struct Table {
  std::string content;             // says what a row is
  std::string units;               // describes the columns in a line of text
  std::vector<std::size_t> shape;  // sizes of the axes; rows run through them, the last fastest
  std::vector<std::string> notes;  // further lines of text
  std::vector<Column> columns;

  [[nodiscard]] std::size_t rows() const;
  // Returns the number of values of a column that varies along these axes.
  [[nodiscard]] std::size_t values_along(const std::optional<std::vector<std::size_t>>& axes) const;
  // Returns the index of the value that a column shows in a row.
  [[nodiscard]] std::size_t value_in_row(const Column& column, std::size_t row) const;

  // Adds a column that owns its values.
  template <class T>
  void add(Column column, std::vector<T> values);
  // Adds a column whose value i is get(i): a number, a text, or an Estimate, which adds a second column NAME_error.
  template <class Get>
  requires std::is_invocable_v<Get, std::size_t>
  void add(Column column, const Get& get);
  // Adds a view of values that must outlive the table.
  template <class T>
  void add_view(Column column, const std::vector<T>& values);
};

// Limits a share to 1 for reporting: the estimate is unbiased and may exceed 1 by chance, although the share cannot.
[[nodiscard]] Estimate as_share(Estimate estimate);

template <class T>
void Table::add(Column column, std::vector<T> values) {
  const auto kept = std::make_shared<const std::vector<T>>(std::move(values));
  column.values = std::span<const T>(*kept);
  column.owner = kept;
  columns.push_back(std::move(column));
}

template <class Get>
requires std::is_invocable_v<Get, std::size_t>
void Table::add(Column column, const Get& get) {
  using Value = std::decay_t<std::invoke_result_t<Get, std::size_t>>;
  const std::size_t count = values_along(column.axes);
  if constexpr (std::is_same_v<Value, Estimate>) {
    std::vector<double> values(count), half_widths(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Estimate estimate = get(i);
      values[i] = estimate.value;
      half_widths[i] = estimate.half_width;
    }
    Column error = column;
    error.name += "_error";
    column.error_column = error.name;
    error.meaning = "half-width of the confidence interval of " + column.name;
    add(std::move(column), std::move(values));
    add(std::move(error), std::move(half_widths));
  } else {
    std::vector<Value> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = get(i);
    add(std::move(column), std::move(values));
  }
}

template <class T>
void Table::add_view(Column column, const std::vector<T>& values) {
  column.values = std::span<const T>(values);
  columns.push_back(std::move(column));
}

}  // namespace sunfleck
