#pragma once
// A result as Python sees it: arrays by name.

#include "io/element_fields.h"
#include "simulate/requests.h"
#include "simulate/simulated_scene.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>

namespace sunfleck {

// The names are those of the result files; arrays of the triangles are views of what the outcome holds.
class Outcome {
 public:
  explicit Outcome(SimulatedScene simulated) : simulated_(std::move(simulated)) {}

  [[nodiscard]] bool complete() const { return simulated_.record.complete; }
  [[nodiscard]] std::string summary() const;                       // summary.json
  [[nodiscard]] std::string table(const std::string& name) const;  // profile.csv, organs.csv, triangles.csv, sensors.csv
  [[nodiscard]] pybind11::dict profile() const;                    // [layer + 1], as the columns of profile.csv
  [[nodiscard]] pybind11::dict organs() const;                     // [organ], as the columns of organs.csv
  [[nodiscard]] pybind11::list planes() const;                     // a dict for each [[plane]]: maps of [cells_x, cells_z]
  [[nodiscard]] pybind11::list sensors() const;                    // a dict for each [[sensor]]: [point]
  // Writes into a folder what `run` would write there; an earlier result in it is replaced. Throws Error as `run` does.
  void write(const ResultRequest& request) const;

  // [triangle], as the columns of triangles.csv; `self` is the Python object of this.
  [[nodiscard]] pybind11::dict triangles(const pybind11::object& self);
  [[nodiscard]] pybind11::array corners() const;  // [triangle, corner, axis], m, the scene's frame

 private:
  const ElementFields& fields();

  SimulatedScene simulated_;
  std::unique_ptr<ElementFields> fields_;  // made when they are asked for
};

void bind_outcome(pybind11::module_& module);

}  // namespace sunfleck
