#pragma once
// The record of a run and its summary.json. docs/formats.md describes each entry.

#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/tracer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The settings and circumstances of a run.
struct RunRecord {
  std::string version;
  std::string commit;
  std::string title;
  std::string scene_file;
  std::string scene_digest;
  std::uint64_t seed = 1;
  bool complete = true;                  // false if it was stopped before its work was done
  bool pictures_interrupted = false;     // true if Ctrl-C stopped it while its pictures were drawn
  std::vector<std::string> not_written;  // files that could not be written
  Accuracy accuracy;
  std::optional<double> grid_m;  // this and the next four: user settings that fix or limit the work
  std::optional<int> passes;
  std::optional<std::uint64_t> max_rays;
  std::optional<std::uint64_t> memory_bytes;  // bound on replicates in progress
  std::optional<double> max_seconds;
  int threads = 0;  // 0: all
  int ranks = 1;    // number of processes that shared the work
  TracerDevice device;
  struct Seconds {
    double load = 0.0, bvh = 0.0, device = 0.0, direct = 0.0, indirect = 0.0, write = 0.0, total = 0.0;
  } seconds;
};

// Returns summary.json, indented by two spaces.
[[nodiscard]] std::string summary_json(const RunRecord& record, const RadiationModel& model, const RadiationResult& result);

[[nodiscard]] const char* error_target_name(ErrorTarget target);  // as in scene files

}  // namespace sunfleck
