#include "programs/python/arrays.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

namespace py = pybind11;

void check_rows_of_three(const py::array& array, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  throw py::value_error(
      fmt::format("{}: an array of {} dimensions (must have the shape (n, 3)); reshape it", name, array.ndim()));
}

std::vector<std::uint32_t> column(const Numbers& array, const char* name) {
  if (array.ndim() != 1)
    throw py::value_error(fmt::format("{}: an array of {} dimensions (must have one); reshape it", name, array.ndim()));
  return {array.data(), array.data() + array.size()};
}

}  // namespace

Mesh mesh_of(const Doubles& vertices, const Numbers& triangles, const Numbers& optics,
             const std::vector<std::string>& optics_names, const Numbers& organs,
             const std::vector<std::tuple<std::uint32_t, std::string, int>>& organ_names, bool keeps_plants) {
  check_rows_of_three(vertices, "vertices");
  check_rows_of_three(triangles, "triangles");
  Mesh mesh;
  const auto corner = vertices.unchecked<2>();
  mesh.vertices.reserve(static_cast<std::size_t>(corner.shape(0)));
  for (py::ssize_t i = 0; i < corner.shape(0); ++i) mesh.vertices.emplace_back(corner(i, 0), corner(i, 1), corner(i, 2));
  const auto number = triangles.unchecked<2>();
  mesh.triangles.reserve(static_cast<std::size_t>(number.shape(0)));
  for (py::ssize_t i = 0; i < number.shape(0); ++i) mesh.triangles.emplace_back(number(i, 0), number(i, 1), number(i, 2));
  mesh.optics_of = column(optics, "optics");
  mesh.organ_of = column(organs, "organ");
  mesh.optics_names = optics_names;
  for (const auto& [plant, name, rank] : organ_names) mesh.organs.push_back({plant, name, rank});
  mesh.keeps_plants = keeps_plants;
  return mesh;
}

}  // namespace sunfleck
