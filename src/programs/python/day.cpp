#include "programs/python/day.h"

#include "base/error.h"
#include "files/results/stores/step_store.h"
#include "files/results/tables/day_fields.h"
#include "files/results/tables/day_tables.h"
#include "files/results/tables/element_fields.h"
#include "files/results/tables/plane_map.h"
#include "files/results/tables/table_text.h"
#include "programs/python/arrays.h"
#include "programs/python/columns.h"
#include "programs/python/long_work.h"
#include "simulate/in_memory_day.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <variant>

namespace sunfleck {
namespace {

namespace py = pybind11;

class Day {
 public:
  explicit Day(InMemoryDay day)
      : day_(std::move(day)),
        stand_(day_.scene.model),
        part_(day_.plan.course, day_.lights),
        tables_(day_tables(day_.scene.model)) {}

  [[nodiscard]] bool complete() const { return day_.record.complete; }
  [[nodiscard]] std::string summary() const { return day_.summary; }
  [[nodiscard]] std::vector<std::string> warnings() const { return day_.scene.warnings; }

  // Returns the names of the tables by step, date, organ and plant, and of those of the maps.
  [[nodiscard]] std::vector<std::string> tables() const {
    std::vector<std::string> names;
    for (const DayTable& table : tables_) names.emplace_back(table.file);
    for (const PlaneReceiver& plane : day_.scene.model.planes) names.push_back(plane_day_stem(plane) + ".csv");
    return names;
  }

  [[nodiscard]] std::string table(const std::string& name) const {
    if (const std::optional<std::size_t> plane = plane_of(name))
      return csv_text(day_.record, day_.plane_sums.table(day_.plan.course, *plane));
    return day_text(table_of(name), day_.record, stand_, part_);
  }

  [[nodiscard]] py::dict describe(const std::string& name) const {
    if (const std::optional<std::size_t> plane = plane_of(name))
      return descriptions_of(day_.plane_sums.table(day_.plan.course, *plane));
    return descriptions_of(table_of(name).make(stand_, part_));
  }

  // Returns the columns of a table, lists first; the arrays have the table's axes.
  [[nodiscard]] py::dict columns(const std::string& name) const {
    if (const std::optional<std::size_t> plane = plane_of(name))
      return columns_of(day_.plane_sums.table(day_.plan.course, *plane));
    return lists_first(table_of(name).make(stand_, part_));
  }

  // Returns what organs absorb, [step, organ], lists first.
  [[nodiscard]] py::dict organ_steps() const { return lists_first(organ_steps_table(stand_, part_)); }

  [[nodiscard]] bool has_triangles() const { return day_.triangle_light; }

  // Returns the variables of day.nc, [step, triangle], in single precision; those of an unlit one are zero.
  [[nodiscard]] py::dict triangles() const {
    const RadiationModel& model = day_.scene.model;
    const std::vector<LightColumn> kinds = day_columns(model);
    const std::size_t elements = model.canopy.size();
    py::dict columns;
    for (std::size_t b = 0; b < model.bands.size(); ++b) {
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        const auto name = fmt::format("{}_{}", model.bands[b].name, ending(kinds[k]));
        columns[name.c_str()] = read_only(array_of(of_steps(day_.fields, (b * kinds.size() + k) * elements, elements, 0.0F),
                                                   {signed_size(day_.fields.size()), signed_size(elements)}));
      }
    }
    return columns;
  }

  // Returns the variables of plane_H_day.nc for each plane, [step, row, cell], likewise; shares of an unlit step are NaN.
  [[nodiscard]] py::list plane_steps() const {
    const RadiationModel& model = day_.scene.model;
    py::list planes;
    std::size_t begin = 0;
    for (const PlaneReceiver& plane : model.planes) {
      const UserMap map(plane, model.plot);
      const std::size_t cells = std::size_t{map.first.cells} * map.second.cells;
      py::dict columns;
      columns["height_m"] = plane.height_m;
      const auto add = [&](const std::string& name, float unlit) {
        columns[name.c_str()] =
            read_only(array_of(of_steps(day_.maps, begin, cells, unlit),
                               {signed_size(day_.maps.size()), signed_size(map.second.cells), signed_size(map.first.cells)}));
        begin += cells;
      };
      add("sunfleck", std::numeric_limits<float>::quiet_NaN());
      for (const Waveband& band : model.bands) {
        add(band.name + "_direct", 0.0F);
        add(band.name + "_total", 0.0F);
      }
      planes.append(columns);
    }
    return planes;
  }

 private:
  [[nodiscard]] const DayTable& table_of(const std::string& name) const {
    const auto found = std::find_if(tables_.begin(), tables_.end(), [&](const DayTable& table) { return table.file == name; });
    if (found != tables_.end()) return *found;
    throw_input(name, "not a table of this day", fmt::format("use {}", fmt::join(tables(), ", ")));
  }

  [[nodiscard]] std::optional<std::size_t> plane_of(const std::string& name) const {
    const std::vector<PlaneReceiver>& planes = day_.scene.model.planes;
    for (std::size_t p = 0; p < planes.size(); ++p) {
      if (plane_day_stem(planes[p]) + ".csv" == name) return p;
    }
    return std::nullopt;
  }

  // Returns `count` values of each step, from number `begin` on.
  [[nodiscard]] static std::vector<float> of_steps(const std::vector<std::vector<float>>& steps, std::size_t begin,
                                                   std::size_t count, float unlit) {
    std::vector<float> values(steps.size() * count, unlit);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].empty()) continue;
      const auto from = steps[i].begin() + signed_size(begin);
      std::copy(from, from + signed_size(count), values.begin() + signed_size(i * count));
    }
    return values;
  }

  [[nodiscard]] static py::dict lists_first(Table table) {
    const auto is_text = [](const Column& column) {
      return std::holds_alternative<std::span<const std::string>>(column.values);
    };
    std::stable_partition(table.columns.begin(), table.columns.end(), is_text);
    return columns_of(table);
  }

  InMemoryDay day_;
  DayStand stand_;
  DayPart part_;
  std::vector<DayTable> tables_;
};

// Creates a day from its times and the limits of its work.
std::unique_ptr<Day> day_of(const std::filesystem::path& file, const std::optional<std::string>& text,
                            std::map<std::string, Mesh> meshes, bool allow_outside, const DayRequest& request,
                            WorkRequest limits, std::optional<bool> triangles, const std::string& device, int threads,
                            const py::object& progress) {
  std::optional<InMemoryDay> day;
  const SceneAccess access{.allow_outside = allow_outside, .purpose = ScenePurpose::day};
  const auto work = [&](const Monitor& monitor) {
    Scene scene = text ? read_scene(SceneText{file, *text, std::move(meshes)}, access) : read_scene(file, access);
    limits.triangle_light = triangles ? *triangles : keeps_triangles(request, scene);
    day = simulate_in_memory(std::move(scene), request, limits, {device_word(device), 0, threads}, monitor);
  };
  do_long_work(work, progress);
  return std::make_unique<Day>(std::move(*day));
}

}  // namespace

void bind_day(py::module_& module) {
  py::class_<DayRequest>(module, "DayRequest")
      .def(py::init<std::string, std::string, std::string, std::string, int, std::optional<int>>());
  py::class_<Day>(module, "Day")
      .def_property_readonly("complete", &Day::complete)
      .def_property_readonly("warnings", &Day::warnings)
      .def("summary", &Day::summary)
      .def("table", &Day::table)
      .def("describe", &Day::describe)
      .def("tables", &Day::tables)
      .def("columns", &Day::columns)
      .def("organ_steps", &Day::organ_steps)
      .def_property_readonly("has_triangles", &Day::has_triangles)
      .def("triangles", &Day::triangles)
      .def("plane_steps", &Day::plane_steps);
  module.def("day", &day_of);
}

}  // namespace sunfleck
