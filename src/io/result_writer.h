#pragma once
// The result folder: summary.json and the tables. docs/formats.md describes each file and column; the units stand in the
// files. Every file is written aside and renamed, so that none is ever half there.

#include "io/element_fields.h"
#include "transport/accuracy.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/tracer.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// How a result came about.
struct RunRecord {
  std::string version;
  std::string commit;
  std::string title;
  std::string scene_file;
  std::string scene_digest;
  std::uint64_t seed = 1;
  bool complete = true;                  // false: stopped before its work was done
  bool pictures_interrupted = false;     // stopped while its pictures were drawn
  std::vector<std::string> not_written;  // files that failed
  Accuracy accuracy;
  std::optional<double> grid_m;  // settings that fix or limit the work, as asked for
  std::optional<int> passes;
  std::optional<std::uint64_t> max_rays;
  std::optional<double> memory_bytes;  // bound on replicates in the making
  std::optional<double> max_seconds;
  int threads = 0;  // 0: all
  int ranks = 1;    // processes that shared the work
  TracerDevice device;
  struct Seconds {
    double load = 0.0, bvh = 0.0, device = 0.0, direct = 0.0, indirect = 0.0, write = 0.0, total = 0.0;
  } seconds;
};

// summary.json as text, two spaces of indent.
[[nodiscard]] std::string summary_json(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);

// The tables, as text. Numbers have nine significant digits; a cell is empty where there is no value: intervals of too few
// replicates or hits, and shares of a beam that is not there. organs.csv has a row for each organ of the canopy, in its order,
// also for soil elements that a mesh brings along (organ soil; plant 0 from a .can). The ground of [soil] is no organ and has
// no row; what both absorb together is absorbed_soil of the summary.
[[nodiscard]] std::string profile_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);
[[nodiscard]] std::string organs_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);
[[nodiscard]] std::string triangles_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);
[[nodiscard]] std::string triangles_csv(const RunRecord& record, const ElementFields& fields);

[[nodiscard]] const char* error_target_name(ErrorTarget target);  // as scene files call it

}  // namespace sunfleck
