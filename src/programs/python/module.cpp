// The compiled part of the Python module; the part that users see is in programs/python/sunfleck.

#include "base/error.h"
#include "base/log.h"
#include "base/version.h"
#include "programs/python/day.h"
#include "programs/python/light.h"
#include "programs/python/long_work.h"
#include "programs/python/outcome.h"
#include "programs/python/simulation.h"

#include <pybind11/pybind11.h>

#include <exception>

namespace {

namespace py = pybind11;

// Raises the Python exception for the kind of Error; `errors` is the module with the classes and the words of messages.
void translate(const sunfleck::Error& error, const py::object& errors) {
  const char* name = "SunfleckError";
  if (error.kind() == sunfleck::ErrorKind::input) name = "InputError";
  if (dynamic_cast<const sunfleck::MissingFile*>(&error) != nullptr) name = "MissingFileError";
  if (error.kind() == sunfleck::ErrorKind::device) name = "DeviceError";
  PyErr_SetObject(errors.attr(name).ptr(), errors.attr("with_arguments")(error.what()).ptr());
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  sunfleck::start_log(sunfleck::Verbosity::quiet);
  // Never destroyed, because the interpreter ends before static objects are destroyed.
  static const py::object& errors = *new py::object(py::module_::import("sunfleck._errors"));
  // NOLINTNEXTLINE(performance-unnecessary-value-param): so pybind11 wants it
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const sunfleck::Error& error) {
      translate(error, errors);
    }
  });
  module.attr("version") = sunfleck::version();
  module.attr("commit") = sunfleck::commit();
  sunfleck::bind_light(module);
  sunfleck::bind_outcome(module);
  sunfleck::bind_simulation(module);
  sunfleck::bind_day(module);
  py::module_::import("atexit").attr("register")(py::cpp_function(&sunfleck::end_long_work));
}
