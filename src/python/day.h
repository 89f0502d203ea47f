#pragma once
// A day as Python sees it.

#include <pybind11/pybind11.h>

namespace sunfleck {

void bind_day(pybind11::module_& module);

}  // namespace sunfleck
