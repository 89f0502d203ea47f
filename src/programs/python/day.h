#pragma once
// Binds a day for Python.

#include <pybind11/pybind11.h>

namespace sunfleck {

void bind_day(pybind11::module_& module);

}  // namespace sunfleck
