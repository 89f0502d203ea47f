#include "simulate/day_folder.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "files/results/exports/day_netcdf.h"
#include "files/results/exports/organ_steps_netcdf.h"
#include "files/results/exports/plane_day_netcdf.h"
#include "files/results/tables/day_tables.h"
#include "files/results/tables/plane_day.h"
#include "files/results/tables/table_text.h"
#include "pictures/charts/pictures.h"
#include "simulate/table_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

constexpr const char* fields_file = "day.nc";
constexpr const char* organ_steps_file = "organs_steps.nc";
constexpr const char* day_plot = "day.png";
constexpr const char* season_plot = "season.png";
constexpr std::array<std::string_view, 4> other_files = {fields_file, organ_steps_file, day_plot, season_plot};

StoredStep stored_step(const FinishedSteps& day, std::size_t step, StepFields fields) {
  std::optional<StoredStep> stored = day.store.read(step, fields);
  if (!stored) throw_failure(fmt::format("step {}", step + 1), "its file is missing or damaged", "run again with --resume");
  return std::move(*stored);
}

// A table that grows date by date beside its final place.
class TableFile {
 public:
  TableFile(const DayTable& table, const fs::path& folder, const StepStore& store)
      : table_(table), file_(folder / table.file), aside_(store.scratch_file(table.file)) {
    std::error_code error;
    fs::remove(aside_, error);  // an earlier day may have been killed while it wrote this table
  }

  void begin(const FinishedSteps& day, const DayStand& stand, const DayPart& part, UnwrittenFiles& unwritten) {
    attempt(unwritten, [&] { append_aside(file_, aside_, day_head(table_, day.record, stand, part, day.course, day.steps)); });
  }
  void add(const DayStand& stand, const DayPart& part, UnwrittenFiles& unwritten) {
    attempt(unwritten, [&] { append_aside(file_, aside_, csv_rows(table_.make(stand, part))); });
  }
  void finish(UnwrittenFiles& unwritten) {
    attempt(unwritten, [&] { replace_file(file_, aside_); });
  }

 private:
  template <class Work>
  void attempt(UnwrittenFiles& unwritten, const Work& work) {
    if (failed_) return;
    const std::size_t before = unwritten.names().size();
    unwritten.attempt(table_.file, work);
    failed_ = unwritten.names().size() > before;
  }

  DayTable table_;
  fs::path file_, aside_;
  bool failed_ = false;
};

class DayFolder {
 public:
  DayFolder(const fs::path& folder, const ResultRequest& request, const FinishedSteps& day)
      : folder_(folder), request_(request), day_(day), stand_(day.model), dark_(no_light(day.model)), plane_sums_(day.model) {}

  WrittenDay write() {
    write_tables();
    write_plane_sums();
    if (day_.steps > 0) {
      write_netcdf();
      draw();
    }
    return std::move(written_);
  }

 private:
  // Writes the tables, and sums the dates and the maps of the planes.
  void write_tables() {
    std::vector<TableFile> files;
    for (const DayTable& table : day_tables(day_.model)) files.emplace_back(table, folder_, day_.store);
    const DayCourse first = course_of(day_.course, 0);
    for (TableFile& file : files) file.begin(day_, stand_, DayPart(first, {}), written_.unwritten);
    for (std::size_t date = 0; date < day_.course.dates.size(); ++date) {
      const DayCourse course = course_of(day_.course, date);
      const std::vector<StepLight> lights = lights_of(date);
      DayPart part(course, lights);
      for (TableFile& file : files) file.add(stand_, part, written_.unwritten);
      DateSums& sums = written_.sums.emplace_back();
      sums.steps = part.sums[0].steps;
      sums.bands = std::move(part.sums[0].bands);
    }
    for (TableFile& file : files) file.finish(written_.unwritten);
  }

  // Returns the light of the finished steps of a date, and adds their maps to the sums.
  std::vector<StepLight> lights_of(std::size_t date) {
    const StepRange range = steps_of(day_.course, date);
    std::vector<StepLight> lights;
    for (std::size_t i = range.first; i < std::min(range.end, day_.steps); ++i) {
      if (day_.course.steps[i].unlit()) {
        lights.push_back(dark_);
        plane_sums_.add_unlit();
        continue;
      }
      StoredStep step = stored_step(day_, i, StepFields::none);
      plane_sums_.add(day_.course.steps[i], step.maps);
      lights.push_back(std::move(step.light));
    }
    return lights;
  }

  void write_plane_sums() {
    for (std::size_t p = 0; p < day_.model.planes.size(); ++p) {
      const std::string name = plane_day_stem(day_.model.planes[p]) + ".csv";
      written_.unwritten.attempt(name,
                                 [&] { write_file(folder_ / name, csv_text(day_.record, plane_sums_.table(day_.course, p))); });
    }
  }

  void write_netcdf() {
    if (!day_.model.canopy.organs.empty()) {
      attempt_netcdf(organ_steps_file, [&](const fs::path& file, const fs::path& aside) {
        const auto light = [&](std::size_t i) { return stored_step(day_, i, StepFields::none).light; };
        write_organ_steps(file, aside, {day_.record, stand_, day_.course, day_.steps, light});
      });
    }
    if (wanted_fields(request_, day_.course) == StepFields::kept) {
      attempt_netcdf(fields_file, [&](const fs::path& file, const fs::path& aside) {
        const auto fields = [&](std::size_t i) { return stored_step(day_, i, StepFields::kept).fields; };
        write_day_netcdf(file, aside, {day_.record, day_.model, day_.course, day_.steps, fields});
        std::error_code error;
        say(fmt::format("{}: {:.1f} MB", fields_file, static_cast<double>(fs::file_size(file, error)) * 1e-6));
      });
    }
    if (!holds(request_.exports, "nc")) return;
    for (std::size_t p = 0; p < day_.model.planes.size(); ++p) {
      attempt_netcdf(plane_day_stem(day_.model.planes[p]) + ".nc", [&](const fs::path& file, const fs::path& aside) {
        const auto maps = [&](std::size_t i) { return stored_step(day_, i, StepFields::none).maps; };
        write_plane_steps(file, aside, {day_.record, day_.model, day_.course, day_.steps, p, maps});
      });
    }
  }

  template <class Write>
  void attempt_netcdf(const std::string& name, const Write& write) {
    written_.unwritten.attempt(name, [&] { write(folder_ / name, day_.store.scratch_file(name)); });
  }

  void draw() {
    const auto wanted = [&](const char* image) { return holds(request_.images, image) || holds(request_.images, "all"); };
    TablePlots plots(folder_, written_.unwritten);
    if (wanted("day")) plots.draw("day.gp", variables("day.csv"), day_plot);
    if (wanted("season") && day_.course.dates.size() > 1) plots.draw("season.gp", variables("season.csv"), season_plot);
    if (!wanted("planes")) return;
    for (const PlaneReceiver& plane : day_.model.planes) {
      const std::string stem = plane_day_stem(plane);
      plots.draw("plane_day.gp", variables(stem + ".csv"), stem + ".png");
    }
  }

  [[nodiscard]] PlotVariables variables(const std::string& table) const {
    PlotVariables variables;
    variables.set_file("table", folder_ / table);
    variables.set_file("sums", folder_ / "day_sums.csv");
    variables.set_text("title", day_.record.title);
    variables.set_text("band", day_.model.bands[picture_band(day_.model, request_.pictures.band)].name);
    return variables;
  }

  const fs::path& folder_;
  const ResultRequest& request_;
  const FinishedSteps& day_;
  const DayStand stand_;
  const StepLight dark_;
  PlaneMapSums plane_sums_;
  WrittenDay written_;
};

}  // namespace

StepFields wanted_fields(const ResultRequest& request, const DayCourse& course) {
  if (holds(request.exports, "none")) return StepFields::none;
  return course.dates.size() == 1 || holds(request.exports, "nc") ? StepFields::kept : StepFields::none;
}

WrittenDay write_day_files(const fs::path& folder, const ResultRequest& request, const FinishedSteps& day) {
  return DayFolder(folder, request, day).write();
}

bool is_file_of_days(const fs::path& name) {
  const auto has_name = [&](const DayTable& table) { return name == table.file; };
  return std::find(other_files.begin(), other_files.end(), name.string()) != other_files.end() ||
         std::any_of(day_tables().begin(), day_tables().end(), has_name);
}

}  // namespace sunfleck
