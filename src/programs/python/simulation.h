#pragma once
// Binds the simulation for Python.

#include <pybind11/pybind11.h>

namespace sunfleck {

void bind_simulation(pybind11::module_& module);

}  // namespace sunfleck
