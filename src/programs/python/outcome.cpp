#include "programs/python/outcome.h"

#include "files/results/tables/plane_writer.h"
#include "files/results/tables/result_tables.h"
#include "programs/python/arrays.h"
#include "programs/python/columns.h"
#include "simulate/result_folder.h"

#include <pybind11/stl.h>

namespace sunfleck {
namespace {

namespace py = pybind11;

}  // namespace

const ElementFields& Outcome::fields() {
  if (!fields_) fields_ = std::make_unique<ElementFields>(make_element_fields(simulated_.scene->model, simulated_.result));
  return *fields_;
}

std::string Outcome::summary() const {
  return summary_json(simulated_.record, simulated_.scene->model, simulated_.result);
}

std::string Outcome::table(const std::string& name) const {
  const RadiationModel& model = simulated_.scene->model;
  if (name == "profile.csv") return profile_csv(simulated_.record, model, simulated_.result);
  if (name == "organs.csv") return organs_csv(simulated_.record, model, simulated_.result);
  if (name == "plants.csv") return plants_csv(simulated_.record, model, simulated_.result);
  if (name == "triangles.csv") return triangles_csv(simulated_.record, model, simulated_.result);
  if (name == "sensors.csv" && !simulated_.result.sensors.empty())
    return sensors_csv(simulated_.record, model, simulated_.result);
  if (name == "sensor_means.csv" && !simulated_.result.sensors.empty())
    return sensor_means_csv(simulated_.record, model, simulated_.result);
  throw py::value_error(
      name + " (not a table of this result); use profile.csv, organs.csv, plants.csv, triangles.csv or, if the scene " +
      "has sensors, sensors.csv or sensor_means.csv");
}

py::dict Outcome::describe(const std::string& name) {
  const RadiationModel& model = simulated_.scene->model;
  const RadiationResult& result = simulated_.result;
  if (name == "profile.csv") return descriptions_of(layers_table(model, result));
  if (name == "organs.csv") return descriptions_of(organs_table(model, result));
  if (name == "plants.csv") return descriptions_of(plants_table(model, result));
  if (name == "triangles.csv") return descriptions_of(triangles_table(fields()));
  if (name == "sensors.csv") return descriptions_of(sensors_table(model, result));
  if (name == "sensor_means.csv") return descriptions_of(sensor_means_table(model, result));
  if (name == "balance") return descriptions_of(balance_table(result));
  throw py::value_error(
      name + " (not a table of this result); use profile.csv, organs.csv, plants.csv, triangles.csv, sensors.csv or " +
      "sensor_means.csv");
}

py::dict Outcome::profile() const {
  return columns_of(layers_table(simulated_.scene->model, simulated_.result));
}

py::dict Outcome::organs() const {
  return columns_of(organs_table(simulated_.scene->model, simulated_.result));
}

py::dict Outcome::plants() const {
  return columns_of(plants_table(simulated_.scene->model, simulated_.result));
}

py::dict Outcome::balance() const {
  return columns_of(balance_table(simulated_.result));
}

py::list Outcome::planes() const {
  py::list planes;
  for (std::size_t i = 0; i < simulated_.result.planes.size(); ++i)
    planes.append(columns_of(plane_table(simulated_.scene->model, simulated_.result, i)));
  return planes;
}

py::list Outcome::sensors() const {
  py::list sensors;
  for (std::size_t i = 0; i < simulated_.result.sensors.size(); ++i) {
    py::dict sensor;
    sensor["name"] = simulated_.scene->model.sensors[i].name;
    sensors.append(columns_of(sensor_table(simulated_.scene->model, simulated_.result, i), {}, sensor));
  }
  return sensors;
}

py::dict Outcome::sensor_means() const {
  if (simulated_.result.sensors.empty()) return {};
  return columns_of(sensor_means_table(simulated_.scene->model, simulated_.result));
}

py::dict Outcome::triangles(const py::object& self) {
  return columns_of(triangles_table(fields()), self);
}

void Outcome::write(const ResultRequest& request) const {
  const std::filesystem::path folder = result_folder(request, simulated_.scene->file);
  FolderLock lock(folder);
  check_pictures(request, simulated_.scene->model);
  check_inputs(folder, *simulated_.scene);
  prepare_folder(folder, lock);
  RunRecord record = simulated_.record;
  write_whole_result(folder, request, simulated_, record).throw_if_any();
}

py::array Outcome::corners() const {
  const RadiationModel& model = simulated_.scene->model;
  std::vector<double> corners;
  corners.reserve(9 * model.canopy.size());
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 corner = corner_m(model, e, k);
      corners.insert(corners.end(), {corner.x, corner.y, corner.z});
    }
  }
  return array_of(std::move(corners), {signed_size(model.canopy.size()), 3, 3});
}

void bind_outcome(py::module_& module) {
  py::class_<Outcome>(module, "Outcome")
      .def_property_readonly("complete", &Outcome::complete)
      .def("summary", &Outcome::summary)
      .def("table", &Outcome::table)
      .def("describe", &Outcome::describe)
      .def("balance", &Outcome::balance)
      .def("profile", &Outcome::profile)
      .def("organs", &Outcome::organs)
      .def("plants", &Outcome::plants)
      .def("planes", &Outcome::planes)
      .def("sensors", &Outcome::sensors)
      .def("sensor_means", &Outcome::sensor_means)
      .def("corners", &Outcome::corners)
      .def("triangles", [](const py::object& self) { return self.cast<Outcome&>().triangles(self); })
      .def("write", [](const Outcome& outcome, const std::string& folder, std::vector<std::string> exports,
                       std::vector<std::string> images) {
        ResultRequest request;
        request.output = folder;
        request.exports = std::move(exports);
        request.images = std::move(images);
        const py::gil_scoped_release release;
        outcome.write(request);
      });
}

}  // namespace sunfleck
