#pragma once
// Converts between numpy's arrays and C++ vectors.

#include "physics/canopy/mesh.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// Returns the size as Python counts it.
[[nodiscard]] inline pybind11::ssize_t signed_size(std::size_t size) {
  return static_cast<pybind11::ssize_t>(size);
}

// Makes an array read-only, because all who ask for it receive the same one.
[[nodiscard]] inline pybind11::array read_only(pybind11::array array) {
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

// Returns a read-only array of that shape that refers to values without a copy; `owner` lives as long as the array. There may be
// no values.
template <class T>
pybind11::array view_of(std::span<const T> values, std::vector<pybind11::ssize_t> shape, const pybind11::handle& owner) {
  return read_only(pybind11::array_t<T>(std::move(shape), values.data(), owner));
}

// Returns an array that takes over the vector.
template <class T>
pybind11::array array_of(std::vector<T>&& values, std::vector<pybind11::ssize_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return pybind11::array_t<T>(std::move(shape), kept->data(), owner);
}
template <class T>
pybind11::array array_of(std::vector<T>&& values) {
  const pybind11::ssize_t size = signed_size(values.size());
  return array_of(std::move(values), {size});
}

using Doubles = pybind11::array_t<double, pybind11::array::c_style>;
using Numbers = pybind11::array_t<std::uint32_t, pybind11::array::c_style>;

// Returns a mesh. vertices: [vertex][3], m; triangles: [triangle][3], vertex numbers; optics, organs: [triangle], indices into
// the names that follow them; keeps_plants as in Mesh. Throws ValueError for other shapes; import_mesh checks the ranges of the
// numbers.
[[nodiscard]] Mesh mesh_of(const Doubles& vertices, const Numbers& triangles, const Numbers& optics,
                           const std::vector<std::string>& optics_names, const Numbers& organs,
                           const std::vector<std::tuple<std::uint32_t, std::string, int>>& organ_names, bool keeps_plants);

}  // namespace sunfleck
