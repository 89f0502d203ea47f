#pragma once
// Binds the sun and the sky for Python, without a canopy.

#include <pybind11/pybind11.h>

namespace sunfleck {

void bind_light(pybind11::module_& module);

}  // namespace sunfleck
