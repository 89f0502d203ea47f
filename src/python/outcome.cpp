#include "python/outcome.h"

#include "io/plane_writer.h"
#include "io/sensor_writer.h"
#include "io/table_text.h"
#include "python/columns.h"
#include "simulate/result_folder.h"

#include <pybind11/stl.h>

#include <limits>

namespace sunfleck {
namespace {

namespace py = pybind11;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

py::ssize_t signed_size(std::size_t size) {
  return static_cast<py::ssize_t>(size);
}

py::dict plane_columns(const RadiationModel& model, const RadiationResult& result, std::size_t plane) {
  const PlaneResult& from = result.planes[plane];
  // Cell numbers vary fastest along x.
  Columns columns({signed_size(from.cells_z), signed_size(from.cells_x)});
  columns.set("height_m", py::float_(from.height_m));
  columns.set("sunfleck_ratio", py::float_(from.sunfleck_ratio.value));
  columns.set("sunfleck_ratio_error", py::float_(from.sunfleck_ratio.half_width));
  const auto centres = [](std::uint32_t cells, double size_m) {
    std::vector<double> centres_m(cells);
    for (std::uint32_t i = 0; i < cells; ++i) centres_m[i] = (i + 0.5) / cells * size_m;
    return array_of(std::move(centres_m));
  };
  columns.set("x_m", centres(from.cells_x, model.plot.size_x_m));
  columns.set("z_m", centres(from.cells_z, model.plot.size_z_m));
  columns.add("sunfleck", plane_sunfleck(from));
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    PlaneIrradiance irradiance = plane_irradiance(model, result, plane, b);
    columns.add(model.bands[b].name + "_direct", std::move(irradiance.direct_w_m2));
    columns.add(model.bands[b].name + "_total", std::move(irradiance.total_w_m2));
  }
  return columns.take();
}

py::dict sensor_columns(const RadiationModel& model, const RadiationResult& result, std::size_t number) {
  const Sensor& sensor = model.sensors[number];
  const std::vector<SensorResult>& readings = result.sensors[number];
  const std::size_t points = sensor.points_m.size();
  Columns columns({signed_size(points)});
  columns.set("name", py::str(sensor.name));
  for (int axis = 0; axis < 3; ++axis)
    columns.add_values(std::string(1, "xyz"[axis]), points, [&](std::size_t p) { return sensor.points_m[p][axis]; });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    const auto add = [&](const char* name, const auto part) {
      columns.add_estimates(band + name, points, [&](std::size_t p) -> const Estimate& { return (readings[p].*part)[b]; });
    };
    add("_direct", &SensorResult::direct);
    add("_sky", &SensorResult::sky);
    add("_scattered", &SensorResult::scattered);
  }
  return columns.take();
}

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
  if (name == "triangles.csv") return triangles_csv(simulated_.record, model, simulated_.result);
  if (name == "sensors.csv" && !simulated_.result.sensors.empty())
    return sensors_csv(simulated_.record, model, simulated_.result);
  throw py::value_error(name + " (not a table of this result); use profile.csv, organs.csv, triangles.csv or, if the scene " +
                        "has sensors, sensors.csv");
}

py::dict Outcome::profile() const {
  const std::vector<LayerResult>& layers = simulated_.result.layers;
  const std::size_t rows = layers.size();
  Columns columns({signed_size(rows)});
  columns.add_values("height_m", rows, [&](std::size_t i) { return layers[i].height_m; });
  columns.add_values("leaf_area_index", rows,
                     [&](std::size_t i) { return layers[i].absorbed.empty() ? no_value : layers[i].leaf_area_index; });
  columns.add_estimates("sunfleck_ratio", rows, [&](std::size_t i) { return layers[i].sunfleck_ratio; });
  columns.add_estimates("sunlit_leaf_fraction", rows, [&](std::size_t i) { return as_share(layers[i].sunlit_leaf_fraction); });
  const std::vector<Waveband>& bands = simulated_.scene->model.bands;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    columns.add_estimates(bands[b].name + "_down", rows, [&](std::size_t i) { return layers[i].down[b]; });
    columns.add_estimates(bands[b].name + "_up", rows, [&](std::size_t i) { return layers[i].up[b]; });
    columns.add_estimates(bands[b].name + "_absorbed", rows, [&](std::size_t i) {
      return layers[i].absorbed.empty() ? Estimate{no_value} : layers[i].absorbed[b];
    });
  }
  return columns.take();
}

py::dict Outcome::organs() const {
  const RadiationModel& model = simulated_.scene->model;
  const std::vector<Organ>& organs = model.canopy.organs;
  const std::vector<OrganResult>& results = simulated_.result.organs;
  const std::size_t rows = organs.size();
  Columns columns({signed_size(rows)});
  columns.add_values("plant", rows, [&](std::size_t o) { return organs[o].plant; });
  py::list names;
  for (const Organ& organ : organs) names.append(organ.name);
  columns.set("organ", names);
  columns.add_values("rank", rows, [&](std::size_t o) { return organs[o].rank; });
  columns.add_values("area_m2", rows, [&](std::size_t o) { return results[o].area_m2; });
  columns.add_estimates("sunlit_fraction", rows, [&](std::size_t o) { return as_share(results[o].sunlit_fraction); });
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const std::string& band = model.bands[b].name;
    columns.add_values(band + "_direct", rows, [&](std::size_t o) { return results[o].direct[b].value; });
    columns.add_values(band + "_indirect", rows, [&](std::size_t o) { return results[o].indirect[b].value; });
    columns.add_values(band + "_absorbed", rows, [&](std::size_t o) { return results[o].absorbed[b].value; });
    columns.add_values(band + "_error", rows, [&](std::size_t o) {
      const Estimate& absorbed = results[o].absorbed[b];
      return absorbed.value > 0.0 ? absorbed.half_width / absorbed.value : no_value;
    });
    const double umol_per_joule = model.bands[b].umol_per_joule;
    if (!(umol_per_joule > 0.0)) continue;
    columns.add_values(band + "_absorbed_umol_m2_s", rows,
                       [&](std::size_t o) { return results[o].absorbed[b].value * umol_per_joule; });
  }
  return columns.take();
}

py::list Outcome::planes() const {
  py::list planes;
  for (std::size_t i = 0; i < simulated_.result.planes.size(); ++i)
    planes.append(plane_columns(simulated_.scene->model, simulated_.result, i));
  return planes;
}

py::list Outcome::sensors() const {
  py::list sensors;
  for (std::size_t i = 0; i < simulated_.result.sensors.size(); ++i)
    sensors.append(sensor_columns(simulated_.scene->model, simulated_.result, i));
  return sensors;
}

py::dict Outcome::triangles(const py::object& self) {
  const ElementFields& of = fields();
  py::dict columns;
  columns["plant"] = view_of(of.plant, self);
  columns["rank"] = view_of(of.rank, self);
  columns["organ"] = view_of(of.organ, self);
  columns["optics"] = view_of(of.optics, self);
  columns["organ_name"] = py::cast(of.organ_names);
  columns["optics_name"] = py::cast(of.optics_names);
  columns["area_m2"] = view_of(of.area_m2, self);
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns[std::string(1, "xyz"[axis]).c_str()] = view_of(of.centroid_m[axis], self);
  for (const std::vector<LightValues>& band : of.light) {
    for (const LightValues& column : band) columns[column.name.c_str()] = view_of(column.values, self);
  }
  return columns;
}

void Outcome::write(const ResultRequest& request) const {
  const std::filesystem::path folder = result_folder(request, simulated_.scene->file);
  FolderLock lock(folder);
  check_pictures(request, simulated_.scene->model);
  prepare_folder(folder, lock);
  RunRecord record = simulated_.record;
  write_whole_result(folder, request, simulated_, record).throw_if_any();
}

py::array Outcome::corners() const {
  const Canopy& canopy = simulated_.scene->model.canopy;
  std::vector<double> corners;
  corners.reserve(9 * canopy.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 corner = corner_m(canopy, e, k);
      corners.insert(corners.end(), {corner.x, corner.y, corner.z});
    }
  }
  return array_of(std::move(corners), {signed_size(canopy.size()), 3, 3});
}

void bind_outcome(py::module_& module) {
  py::class_<Outcome>(module, "Outcome")
      .def_property_readonly("complete", &Outcome::complete)
      .def("summary", &Outcome::summary)
      .def("table", &Outcome::table)
      .def("profile", &Outcome::profile)
      .def("organs", &Outcome::organs)
      .def("planes", &Outcome::planes)
      .def("sensors", &Outcome::sensors)
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
