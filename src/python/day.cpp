#include "python/day.h"

#include "base/error.h"
#include "io/day_tables.h"
#include "io/element_fields.h"
#include "io/step_store.h"
#include "io/table_text.h"
#include "python/columns.h"
#include "python/long_work.h"
#include "simulate/in_memory_day.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>

namespace sunfleck {
namespace {

namespace py = pybind11;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

py::ssize_t signed_size(std::size_t size) {
  return static_cast<py::ssize_t>(size);
}

class Day {
 public:
  explicit Day(InMemoryDay day) : day_(std::move(day)) {}

  [[nodiscard]] bool complete() const { return day_.record.complete; }
  [[nodiscard]] std::string summary() const { return day_.summary; }
  [[nodiscard]] std::vector<std::string> warnings() const { return day_.scene.warnings; }

  [[nodiscard]] std::string table(const std::string& name) const {
    const RadiationModel& model = day_.scene.model;
    if (name == "day.csv") return day_csv(day_.record, model, day_.plan.course, day_.lights);
    if (name == "organs_day.csv") return organs_day_csv(day_.record, model, day_.plan.course, day_.lights);
    throw py::value_error(name + " (not a table of a day); use day.csv or organs_day.csv");
  }

  // Returns the columns of day.csv, [step].
  [[nodiscard]] py::dict steps() const {
    const std::size_t rows = day_.lights.size();
    const DayCourse& course = day_.plan.course;
    Columns columns({signed_size(rows)});
    py::list times;
    for (std::size_t i = 0; i < rows; ++i) times.append(local_time_text(course.steps[i].start, course.offset_minutes));
    columns.set("time", times);
    columns.add_values("step_s", rows, [&](std::size_t i) { return course.steps[i].length_s; });
    columns.add_values("elevation_deg", rows, [&](std::size_t i) { return course.steps[i].sun.elevation_rad / degree; });
    columns.add_values("azimuth_deg", rows, [&](std::size_t i) { return course.steps[i].sun.azimuth_rad / degree; });
    for (std::size_t b = 0; b < day_.scene.model.bands.size(); ++b) {
      const std::string& band = day_.scene.model.bands[b].name;
      const auto add = [&](const char* name, const auto part) {
        columns.add_estimates(band + name, rows, [&](std::size_t i) { return day_.lights[i].bands[b].*part; });
      };
      add("_incident", &StepBand::incident);
      add("_absorbed_vegetation", &StepBand::absorbed_vegetation);
      add("_absorbed_soil", &StepBand::absorbed_soil);
      add("_reflected", &StepBand::reflected);
    }
    columns.add_estimates("sunlit_leaf_fraction", rows,
                          [&](std::size_t i) { return as_share(day_.lights[i].sunlit_leaf_fraction); });
    return columns.take();
  }

  // Returns what organs absorbed, [date, organ], as the columns of organs_day.csv; dates without a step are left out.
  [[nodiscard]] py::dict organs() const {
    const RadiationModel& model = day_.scene.model;
    const std::vector<Organ>& organs = model.canopy.organs;
    const std::size_t bands = model.bands.size();
    const std::vector<DateSums> sums = sum_dates(model, day_.plan.course, day_.lights);
    std::vector<std::size_t> dates;
    for (std::size_t d = 0; d < sums.size(); ++d)
      if (sums[d].steps > 0) dates.push_back(d);
    Columns columns({signed_size(dates.size()), signed_size(organs.size())});
    add_organ_names(columns, dates);
    const std::size_t cells = dates.size() * organs.size();
    for (std::size_t b = 0; b < bands; ++b) {
      const auto joules = [&](std::size_t cell) -> const Estimate& {
        return sums[dates[cell / organs.size()]].organ_absorbed[(cell % organs.size()) * bands + b];
      };
      const std::string& band = model.bands[b].name;
      columns.add_values(band + "_absorbed_mj_m2", cells, [&](std::size_t cell) { return joules(cell).value * 1e-6; });
      columns.add_values(band + "_error", cells, [&](std::size_t cell) {
        return joules(cell).value > 0.0 ? joules(cell).half_width / joules(cell).value : no_value;
      });
      const double umol_per_joule = model.bands[b].umol_per_joule;
      if (!(umol_per_joule > 0.0)) continue;
      columns.add_values(band + "_absorbed_mol_m2", cells,
                         [&](std::size_t cell) { return joules(cell).value * umol_per_joule * 1e-6; });
    }
    return columns.take();
  }

  // Returns the variables of day.nc, [step, triangle], in single precision; those of a night are zero.
  [[nodiscard]] py::dict triangles() const {
    const RadiationModel& model = day_.scene.model;
    const std::vector<LightColumn> kinds = day_columns(model);
    const std::size_t elements = model.canopy.size();
    Columns columns({signed_size(day_.fields.size()), signed_size(elements)});
    for (std::size_t b = 0; b < model.bands.size(); ++b) {
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        std::vector<float> values(day_.fields.size() * elements, 0.0F);
        for (std::size_t i = 0; i < day_.fields.size(); ++i) {
          if (day_.fields[i].empty()) continue;
          const auto begin = day_.fields[i].begin() + signed_size((b * kinds.size() + k) * elements);
          std::copy(begin, begin + signed_size(elements), values.begin() + signed_size(i * elements));
        }
        columns.add(fmt::format("{}_{}", model.bands[b].name, ending(kinds[k])), std::move(values));
      }
    }
    return columns.take();
  }

 private:
  void add_organ_names(Columns& columns, const std::vector<std::size_t>& dates) const {
    const Canopy& canopy = day_.scene.model.canopy;
    py::list date_names;
    for (const std::size_t date : dates) date_names.append(day_.plan.course.dates[date]);
    columns.set("date", date_names);
    py::list names;
    std::vector<std::uint32_t> plants;
    std::vector<int> ranks;
    for (const Organ& organ : canopy.organs) {
      names.append(organ.name);
      plants.push_back(organ.plant);
      ranks.push_back(organ.rank);
    }
    columns.set("organ", names);
    columns.set("plant", array_of(std::move(plants)));
    columns.set("rank", array_of(std::move(ranks)));
    columns.set("area_m2", array_of(organ_areas_m2(canopy)));
  }

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
      .def("steps", &Day::steps)
      .def("organs", &Day::organs)
      .def("triangles", &Day::triangles);
  module.def("day", &day_of);
}

}  // namespace sunfleck
