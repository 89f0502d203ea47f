#include "programs/python/day.h"

#include "base/error.h"
#include "files/results/stores/step_store.h"
#include "files/results/tables/day_fields.h"
#include "files/results/tables/day_tables.h"
#include "files/results/tables/element_fields.h"
#include "programs/python/arrays.h"
#include "programs/python/columns.h"
#include "programs/python/long_work.h"
#include "simulate/in_memory_day.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <variant>

namespace sunfleck {
namespace {

namespace py = pybind11;

class Day {
 public:
  explicit Day(InMemoryDay day) : day_(std::move(day)) {}

  [[nodiscard]] bool complete() const { return day_.record.complete; }
  [[nodiscard]] std::string summary() const { return day_.summary; }
  [[nodiscard]] std::vector<std::string> warnings() const { return day_.scene.warnings; }

  [[nodiscard]] std::string table(const std::string& name) const {
    const RadiationModel& model = day_.scene.model;
    if (name == "day.csv") return day_csv(day_.record, model, day_.plan.course, day_.lights);
    if (name == "day_sums.csv") return day_sums_csv(day_.record, model, day_.plan.course, day_.lights);
    if (name == "organs_day.csv") return organs_day_csv(day_.record, model, day_.plan.course, day_.lights);
    if (name == "plants_day.csv") return plants_day_csv(day_.record, model, day_.plan.course, day_.lights);
    throw not_a_table(name);
  }

  [[nodiscard]] py::dict describe(const std::string& name) const {
    if (name == "day.csv") return descriptions_of(steps_table());
    if (name == "day_sums.csv") return descriptions_of(sums_table());
    if (name == "organs_day.csv") return descriptions_of(organs_table());
    if (name == "plants_day.csv") return descriptions_of(plants_table());
    throw not_a_table(name);
  }

  // Returns the columns of day.csv, [step].
  [[nodiscard]] py::dict steps() const { return columns_of(steps_table()); }
  // Returns the columns of day_sums.csv, [date].
  [[nodiscard]] py::dict sums() const { return columns_of(sums_table()); }

  // Returns what organs absorbed, [date, organ], as the columns of organs_day.csv, lists first; dates without a step are left
  // out.
  [[nodiscard]] py::dict organs() const { return lists_first(organs_table()); }
  // Returns what plants absorbed, [date, plant], likewise.
  [[nodiscard]] py::dict plants() const { return lists_first(plants_table()); }

  // Returns the variables of day.nc, [step, triangle], in single precision; those of a night are zero.
  [[nodiscard]] py::dict triangles() const {
    const RadiationModel& model = day_.scene.model;
    const std::vector<LightColumn> kinds = day_columns(model);
    const std::size_t elements = model.canopy.size();
    py::dict columns;
    for (std::size_t b = 0; b < model.bands.size(); ++b) {
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        std::vector<float> values(day_.fields.size() * elements, 0.0F);
        for (std::size_t i = 0; i < day_.fields.size(); ++i) {
          if (day_.fields[i].empty()) continue;
          const auto begin = day_.fields[i].begin() + signed_size((b * kinds.size() + k) * elements);
          std::copy(begin, begin + signed_size(elements), values.begin() + signed_size(i * elements));
        }
        columns[fmt::format("{}_{}", model.bands[b].name, ending(kinds[k])).c_str()] =
            array_of(std::move(values), {signed_size(day_.fields.size()), signed_size(elements)});
      }
    }
    return columns;
  }

 private:
  [[nodiscard]] static py::value_error not_a_table(const std::string& name) {
    return py::value_error(name + " (not a table of a day); use day.csv, day_sums.csv, organs_day.csv or plants_day.csv");
  }

  [[nodiscard]] static py::dict lists_first(Table table) {
    const auto is_text = [](const Column& column) {
      return std::holds_alternative<std::span<const std::string>>(column.values);
    };
    std::stable_partition(table.columns.begin(), table.columns.end(), is_text);
    return columns_of(table);
  }

  [[nodiscard]] Table steps_table() const { return sunfleck::steps_table(day_.scene.model, day_.plan.course, day_.lights); }
  [[nodiscard]] Table sums_table() const { return day_sums_table(day_.scene.model, day_.plan.course, day_.lights); }
  [[nodiscard]] Table organs_table() const { return organs_day_table(day_.scene.model, day_.plan.course, day_.lights); }
  [[nodiscard]] Table plants_table() const { return plants_day_table(day_.scene.model, day_.plan.course, day_.lights); }

  InMemoryDay day_;
};

// Creates a day from its times and the limits of its work.
std::unique_ptr<Day> day_of(const std::filesystem::path& file, const std::optional<std::string>& text,
                            std::map<std::string, Mesh> meshes, bool allow_outside, const DayRequest& request,
                            const WorkRequest& limits, const std::string& device, int threads, const py::object& progress) {
  std::optional<InMemoryDay> day;
  const SceneAccess access{.allow_outside = allow_outside, .purpose = ScenePurpose::day};
  const auto work = [&](const Monitor& monitor) {
    Scene scene = text ? read_scene(SceneText{file, *text, std::move(meshes)}, access) : read_scene(file, access);
    day = simulate_in_memory(std::move(scene), request, limits, {device, 0, threads}, monitor);
  };
  do_long_work(work, progress);
  return std::make_unique<Day>(std::move(*day));
}

DayRequest day_request(std::string from, std::string to, std::string date, std::string to_date, int step_min) {
  return {std::move(from), std::move(to), std::move(date), std::move(to_date), step_min};
}

}  // namespace

void bind_day(py::module_& module) {
  py::class_<DayRequest>(module, "DayRequest").def(py::init(&day_request));
  py::class_<Day>(module, "Day")
      .def_property_readonly("complete", &Day::complete)
      .def_property_readonly("warnings", &Day::warnings)
      .def("summary", &Day::summary)
      .def("table", &Day::table)
      .def("describe", &Day::describe)
      .def("steps", &Day::steps)
      .def("organs", &Day::organs)
      .def("sums", &Day::sums)
      .def("plants", &Day::plants)
      .def("triangles", &Day::triangles);
  module.def("day", &day_of);
}

}  // namespace sunfleck
