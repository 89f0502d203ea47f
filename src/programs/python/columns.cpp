#include "programs/python/columns.h"

#include "programs/python/arrays.h"

#include <pybind11/stl.h>

#include <utility>
#include <variant>

namespace sunfleck {
namespace {

namespace py = pybind11;

py::list list_of(std::span<const std::string> texts) {
  py::list list;
  for (const std::string& text : texts) list.append(text);
  return list;
}

std::vector<py::ssize_t> shape_of(const Table& table, const Column& column) {
  std::vector<py::ssize_t> shape;
  if (!column.axes) return {table.shape.begin(), table.shape.end()};
  for (const std::size_t axis : *column.axes) shape.push_back(signed_size(table.shape[axis]));
  return shape;
}

struct MakeObject {
  const Table& table;
  const Column& column;
  const py::handle& holder;

  py::object operator()(std::span<const std::string> texts) const { return list_of(texts); }
  py::object operator()(const RowNumbers& numbers) const {
    std::vector<std::int64_t> values(numbers.count);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i);
    return read_only(array_of(std::move(values)));
  }
  template <class T>
  py::object operator()(std::span<const T> numbers) const {
    const std::vector<py::ssize_t> shape = shape_of(table, column);
    if (shape.empty()) return py::float_(static_cast<double>(numbers.front()));
    if (column.owner) return read_only(py::array_t<T>(shape, numbers.data(), capsule_of(column.owner)));
    return view_of(numbers, shape, holder);
  }

  static py::capsule capsule_of(const std::shared_ptr<const void>& owner) {
    using Owner = std::shared_ptr<const void>;
    return {new Owner(owner), [](void* kept) { delete static_cast<Owner*>(kept); }};
  }
};

}  // namespace

py::dict columns_of(const Table& table, const py::handle& holder, py::dict first) {
  std::vector<const Column*> unnamed;  // columns whose categories have not been added
  const auto add_names = [&] {
    for (const Column* column : std::exchange(unnamed, {}))
      first[(column->name + "_name").c_str()] = list_of(*column->categories);
  };
  for (const Column& column : table.columns) {
    if (!column.is_in(in_arrays)) continue;
    if (!column.categories) add_names();
    first[column.name.c_str()] = std::visit(MakeObject{table, column, holder}, column.values);
    if (column.categories) unnamed.push_back(&column);
  }
  add_names();
  return first;
}

py::dict descriptions_of(const Table& table) {
  py::dict descriptions;
  for (const Column& column : table.columns) {
    const bool is_array = column.is_in(in_arrays);
    if (is_array || column.is_in(in_csv))
      descriptions[column.name.c_str()] = py::make_tuple(column.unit, column.meaning, is_array && column.is_in(in_netcdf));
  }
  return descriptions;
}

}  // namespace sunfleck
