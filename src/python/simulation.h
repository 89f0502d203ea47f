#pragma once
// The simulation as Python sees it.

#include <pybind11/pybind11.h>

namespace sunfleck {

void bind_simulation(pybind11::module_& module);

}  // namespace sunfleck
