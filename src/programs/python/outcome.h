#pragma once
// A result for Python: arrays by name.

#include "files/results/tables/element_fields.h"
#include "files/results/tables/table.h"
#include "simulate/requests.h"
#include "simulate/simulated_scene.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace sunfleck {

// Names are those of the result files; arrays of the triangles are views of data that the outcome owns.
class Outcome {
 public:
  explicit Outcome(SimulatedScene simulated) : simulated_(std::move(simulated)) {}

  [[nodiscard]] bool complete() const { return simulated_.record.complete; }
  [[nodiscard]] std::string summary() const;                 // summary.json
  [[nodiscard]] std::string table(const std::string& name);  // profile.csv, organs.csv, plants.csv, ...
  // Return the columns of a table, or of `balance`: their values, and the unit, the meaning and whether xarray has it.
  [[nodiscard]] pybind11::dict columns(const std::string& name);
  [[nodiscard]] pybind11::dict describe(const std::string& name);
  [[nodiscard]] pybind11::list planes() const;   // a dict per [[plane]]: maps of [cells_x, cells_z]
  [[nodiscard]] pybind11::list sensors() const;  // a dict per [[sensor]]: [point]
  // Writes into a folder what `run` would write there; an earlier result in it is replaced. If stopped, leaves the remaining
  // pictures out. Throws Error as `run` does.
  void write(const ResultRequest& request, const StopQuestion& stop) const;

  // Returns the columns of triangles.csv, [triangle]; `self` is the Python object of this outcome.
  [[nodiscard]] pybind11::dict triangles(const pybind11::object& self);
  // Returns each triangle's organ, [triangle], as the row of organs.csv.
  [[nodiscard]] pybind11::array organ_rows(const pybind11::object& self) const;
  // Returns a picture as sRGB, [row from the top, column, 3]. Other threads run while it draws, and Ctrl-C stops it. Throws Error
  // (input) if the scene lacks what the picture is to show, as `render` does.
  [[nodiscard]] pybind11::array render(const Picture& picture, const PictureOptions& options) const;
  [[nodiscard]] pybind11::array corners() const;  // [triangle, corner, axis], m, in the scene's frame

 private:
  const ElementFields& fields();
  [[nodiscard]] Table table_of(const std::string& name);

  SimulatedScene simulated_;
  std::unique_ptr<ElementFields> fields_;  // created when first used
};

void bind_outcome(pybind11::module_& module);

}  // namespace sunfleck
