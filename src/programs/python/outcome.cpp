#include "programs/python/outcome.h"

#include "base/error.h"
#include "files/results/exports/netcdf_file.h"
#include "files/results/tables/plane_writer.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"
#include "pictures/charts/pictures.h"
#include "programs/python/arrays.h"
#include "programs/python/columns.h"
#include "programs/python/long_work.h"
#include "simulate/result_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace sunfleck {
namespace {

namespace py = pybind11;

// Returns the number of a choice. Throws Error (input) if there is no such choice.
std::size_t check_choice(const char* option, const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw_input(fmt::format("{} = '{}'", option, name), "no such choice", fmt::format("use {}", fmt::join(names, ", ")));
}

template <class Choice>
Choice choice_of(const char* option, const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Choice>(check_choice(option, names, name));
}

Picture picture_of(const std::string& chart, const std::string& field) {
  return {choice_of<ChartKind>("chart", chart_names(), chart), choice_of<LightField>("field", field_names(), field)};
}

// `size` is width and height in pixels.
PictureOptions picture_options(std::string band, const std::string& view, std::pair<int, int> size, int samples,
                               std::optional<int> repeat, std::optional<double> top_w_m2) {
  PictureOptions options;
  options.band = std::move(band);
  options.view = choice_of<ViewKind>("view", view_names(), view);
  std::tie(options.width, options.height) = size;
  options.samples = samples;
  options.repeat = repeat;
  options.top_w_m2 = top_w_m2;
  return options;
}

// Returns the table of that name, or null; that of triangles is made from the fields.
const ResultTable* find_table(const std::string& name) {
  const auto found =
      std::find_if(result_tables.begin(), result_tables.end(), [&](const ResultTable& table) { return name == table.file; });
  return found == result_tables.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_table(const std::string& name) {
  throw_input(
      name, "not a table of this result",
      "use profile.csv, organs.csv, plants.csv, triangles.csv or, if the scene has sensors, sensors.csv or sensor_means.csv");
}

}  // namespace

const ElementFields& Outcome::fields() {
  if (!fields_) fields_ = std::make_unique<ElementFields>(make_element_fields(simulated_.scene->model, simulated_.result));
  return *fields_;
}

std::string Outcome::summary() const {
  return summary_json(simulated_.record, simulated_.scene->model, simulated_.result);
}

Table Outcome::table_of(const std::string& name) {
  if (name == "triangles.csv") return triangles_table(fields());
  if (name == "balance") return balance_table(simulated_.result);
  const ResultTable* const table = find_table(name);
  if (table == nullptr) refuse_table(name);
  return table->make(simulated_.scene->model, simulated_.result);
}

std::string Outcome::table(const std::string& name) {
  const ResultTable* const table = find_table(name);
  if (table != nullptr ? !table->is_of(simulated_.result) : name == "balance") refuse_table(name);
  return csv_text(simulated_.record, table_of(name));
}

py::dict Outcome::columns(const std::string& name) {
  return columns_of(table_of(name));
}

py::dict Outcome::describe(const std::string& name) {
  return descriptions_of(table_of(name));
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

py::dict Outcome::triangles(const py::object& self) {
  return columns_of(triangles_table(fields()), self);
}

void Outcome::write(const ResultRequest& request, const StopQuestion& stop) const {
  const std::filesystem::path folder = result_folder(request, simulated_.scene->file);
  FolderLock lock(folder);
  check_pictures(request, simulated_.scene->model);
  check_folder(folder, *simulated_.scene, ResultOf::run);
  prepare_folder(folder, lock, ResultOf::run);
  RunRecord record = simulated_.record;
  write_whole_result(folder, request, simulated_, record, {.stop = stop}).throw_if_any();
}

py::array Outcome::organ_rows(const py::object& self) const {
  const std::span<const std::uint32_t> organs = simulated_.scene->model.canopy.organ_of.get();
  return view_of(organs, {signed_size(organs.size())}, self);
}

py::array Outcome::render(const Picture& picture, const PictureOptions& options) const {
  std::vector<std::uint8_t> bytes;
  const auto receive = [&](std::size_t, const Image& image) {
    bytes.reserve(3 * image.pixels.size());
    for (const auto& pixel : image.pixels) bytes.insert(bytes.end(), pixel.begin(), pixel.end());
  };
  const auto work = [&](const Monitor& monitor) {
    check_view(simulated_.scene->model, options);
    check_field(simulated_.scene->model, picture);
    // If it is stopped, what stopped it is raised.
    static_cast<void>(draw_charts(simulated_.drawing(), options, std::span(&picture, 1), monitor.interrupted, receive));
  };
  do_long_work(work, py::none());
  return array_of(std::move(bytes), {options.height, options.width, 3});
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
  return read_only(array_of(std::move(corners), {signed_size(model.canopy.size()), 3, 3}));
}

void bind_outcome(py::module_& module) {
  py::class_<Outcome>(module, "Outcome")
      .def_property_readonly("complete", &Outcome::complete)
      .def("summary", &Outcome::summary)
      .def("table", &Outcome::table)
      .def("columns", &Outcome::columns)
      .def("describe", &Outcome::describe)
      .def("planes", &Outcome::planes)
      .def("sensors", &Outcome::sensors)
      .def("corners", &Outcome::corners)
      .def("organ_rows", [](const py::object& self) { return self.cast<Outcome&>().organ_rows(self); })
      .def("render",
           [](const Outcome& outcome, const std::string& chart, const std::string& field, std::string band,
              const std::string& view, std::pair<int, int> size, int samples, std::optional<int> repeat,
              std::optional<double> top_w_m2) {
             return outcome.render(picture_of(chart, field),
                                   picture_options(std::move(band), view, size, samples, repeat, top_w_m2));
           })
      .def("triangles", [](const py::object& self) { return self.cast<Outcome&>().triangles(self); })
      .def("write", [](const Outcome& outcome, const std::string& folder, std::vector<std::string> exports,
                       std::vector<std::string> images) {
        ResultRequest request;
        request.output = folder;
        request.exports = std::move(exports);
        for (const std::string& image : images) check_choice("images", image_words(), image);
        request.images = std::move(images);
        do_long_work([&](const Monitor& monitor) { outcome.write(request, monitor.interrupted); }, py::none());
        if (holds(request.exports, "nc")) silence_hdf5();  // it was first called in another thread
      });
}

}  // namespace sunfleck
