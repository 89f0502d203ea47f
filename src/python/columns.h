#pragma once
// A table as a dict of arrays, one per column, named as in the result files.

#include "python/arrays.h"
#include "transport/statistics.h"

#include <string>
#include <vector>

namespace sunfleck {

class Columns {
 public:
  explicit Columns(std::vector<pybind11::ssize_t> shape) : shape_(std::move(shape)) {}

  template <class T>
  void add(const std::string& name, std::vector<T> values) {
    dict_[name.c_str()] = array_of(std::move(values), shape_);
  }
  // Adds `name` and its half-widths `name_error`; `estimate(i)` returns the estimate of row i.
  template <class Get>
  void add_estimates(const std::string& name, std::size_t rows, const Get& estimate) {
    std::vector<double> values(rows);
    std::vector<double> errors(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      const Estimate one = estimate(i);
      values[i] = one.value;
      errors[i] = one.half_width;
    }
    add(name, std::move(values));
    add(name + "_error", std::move(errors));
  }
  template <class Get>
  void add_values(const std::string& name, std::size_t rows, const Get& value) {
    std::vector<std::decay_t<decltype(value(std::size_t{0}))>> values(rows);
    for (std::size_t i = 0; i < rows; ++i) values[i] = value(i);
    add(name, std::move(values));
  }
  void set(const char* name, pybind11::object value) { dict_[name] = std::move(value); }

  [[nodiscard]] pybind11::dict take() { return std::move(dict_); }

 private:
  std::vector<pybind11::ssize_t> shape_;
  pybind11::dict dict_;
};

}  // namespace sunfleck
