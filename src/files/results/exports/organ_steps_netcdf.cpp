#include "files/results/exports/organ_steps_netcdf.h"

#include "base/check.h"
#include "files/results/exports/day_time_axis.h"
#include "files/results/exports/netcdf_writer.h"

#include <algorithm>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

constexpr const char* area_units = "W m-2";

class OrganWriter {
 public:
  OrganWriter(const OrganSteps& of, const std::filesystem::path& file)
      : of_(of),
        file_("organs_steps.nc", file),
        time_(add_time_axis(file_, of.course, of.steps)),
        organ_(file_.dimension("organ", of.stand.model.canopy.organs.size())) {}

  void write() {
    add_record(file_, "day", of_.record, of_.stand.model);
    add_organs();
    define_light();
    for (std::size_t date = 0; date < of_.course.dates.size(); ++date) {
      StepRange range = steps_of(of_.course, date);
      range.end = std::min(range.end, of_.steps);
      if (range.first < range.end) write_steps(range);
    }
    file_.finish();
  }

 private:
  void add_organs() {
    const std::vector<Organ>& organs = of_.stand.model.canopy.organs;
    std::vector<std::int64_t> plants;
    std::vector<std::int32_t> ranks;
    std::vector<std::string> names, roles;
    for (std::size_t o = 0; o < organs.size(); ++o) {
      plants.push_back(organs[o].plant);
      ranks.push_back(organs[o].rank);
      names.push_back(organs[o].name);
      roles.emplace_back(role_name(of_.stand.kinds.organ_roles[o]));
    }
    file_.add("plant", {organ_}, "1", "number of the plant, 0 for soil", plants);
    file_.add("rank", {organ_}, "1", "leaf number from the ground, 0 for organs without one", ranks);
    file_.add("area_m2", {organ_}, "m2", "one-sided area", of_.stand.kinds.organ_m2);
    file_.names("organ_name", organ_, names, "name of the organ");
    file_.names("role", organ_, roles, "leaf, stem, fruit, structure, lamp or soil");
  }

  void define_light() {
    const std::size_t at_once = steps_of(of_.course, 0).size();
    const auto define = [&](const std::string& name, const std::string& meaning) {
      const int number = file_.variable<float>(name, {time_, organ_}, area_units, meaning);
      file_.attribute(number, "coordinates", "plant rank area_m2 organ_name role");
      file_.store_by_rows(number, at_once);
      light_.push_back(number);
      return number;
    };
    for (const Waveband& band : of_.stand.model.bands) {
      const std::string name = band.name + "_absorbed";
      const int absorbed = define(name, "flux absorbed by both faces per one-sided area");
      file_.attribute(absorbed, "ancillary_variables", name + "_error");
      define(name + "_error", "half-width of the confidence interval of " + name);
    }
  }

  void write_steps(const StepRange& range) {
    const std::size_t organs = of_.stand.model.canopy.organs.size(), bands = of_.stand.model.bands.size();
    std::vector<std::vector<float>> values(light_.size(), std::vector<float>(range.size() * organs));  // [variable]
    for (std::size_t step = range.first; step < range.end; ++step) {
      if (of_.course.steps[step].unlit()) continue;
      const StepLight light = of_.light(step);
      EXPECT(light.organ_absorbed.size(), ==, organs * bands);
      const std::size_t row = (step - range.first) * organs;
      for (std::size_t i = 0; i < organs * bands; ++i) {
        const std::size_t at = row + i / bands, variable = 2 * (i % bands);
        values[variable][at] = static_cast<float>(light.organ_absorbed[i].value);
        values[variable + 1][at] = static_cast<float>(light.organ_absorbed[i].half_width);
      }
    }
    for (std::size_t v = 0; v < light_.size(); ++v) file_.put_rows(light_[v], range.first, range.size(), values[v]);
  }

  const OrganSteps& of_;
  NetcdfFile file_;
  int time_, organ_;
  std::vector<int> light_;  // [2 * band + (0 value, 1 half-width)]
};

}  // namespace

void write_organ_steps(const std::filesystem::path& file, const std::filesystem::path& aside, const OrganSteps& organs) {
  EXPECT(organs.steps, >, std::size_t{0});
  write_aside(file, aside, [&] { OrganWriter(organs, aside).write(); });
}

}  // namespace sunfleck
