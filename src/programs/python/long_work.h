#pragma once
// Runs long work while the Python interpreter continues.

#include "physics/transport/solve/solve.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace sunfleck {

// Does the work in a separate thread. Meanwhile the calling thread, which holds the interpreter's lock only for moments,
// listens for Ctrl-C (if it is Python's main thread) and reports the progress to `progress` (None or a callable that takes a
// dict) ten times a second, whether there is news or not, and at the end. An exception from either ends the work and is
// rethrown when it has ended; an exception from the work itself takes precedence.
void do_long_work(const std::function<void(const Monitor&)>& work, const pybind11::object& progress);

// Ends all long work, and waits for it: for `atexit`, since threads that return to an interpreter that is gone end the process.
// Work that was to begin later raises SystemExit, which ends a thread in silence.
void end_long_work();

}  // namespace sunfleck
