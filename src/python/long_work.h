#pragma once
// Work that takes long, beside an interpreter that goes on.

#include "transport/solve.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace sunfleck {

// Does the work in a thread of its own. Meanwhile the calling thread, without the interpreter's lock but for moments, listens
// to Ctrl-C (where it is Python's main thread) and tells `progress` (None or a callable that takes a dict) how far the work is,
// ten times a second, whether there is news or not, and at the end. An exception from either ends the work, and is thrown on
// when it has ended; what the work throws comes before.
void do_long_work(const std::function<void(const Monitor&)>& work, const pybind11::object& progress);

}  // namespace sunfleck
