#pragma once
// The tools of a known-answer case: the device under test, and the table to which it adds its rows.

#include "devices/tracers/scene_tree.h"
#include "devices/tracers/trace_domain.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/solve/solve.h"
#include "programs/validate/known/verdict.h"

#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace sunfleck {

// Creates the tracer under test for a tree, which must outlive it, with counters of that length.
using TracerMaker = std::function<std::unique_ptr<Tracer>(const Bvh& bvh, TraceDomain domain, std::size_t counter_words)>;

// Thrown when the user's request to stop ends a case.
class CaseInterrupted : public std::exception {};

// Requirements that make a comparison with an estimate a meaningful test.
struct Ask {
  std::size_t replicates = 32;   // number of replicates behind the estimate's error
  double largest_error = 0.0;    // a larger standard error makes the comparison fail, because it says too little
  double tolerance = 1e-6;       // as in KnownAnswer
  double reference_error = 0.0;  // standard error of the reference itself
  double confidence = 0.95;      // of the estimate's half-width
};

class CaseBench {
 public:
  CaseBench(TracerMaker maker, StopQuestion stop, bool cpu_path)
      : maker_(std::move(maker)), stop_(std::move(stop)), cpu_path_(cpu_path) {}

  // Returns true if the device under test is the CPU path itself.
  [[nodiscard]] bool cpu_path() const { return cpu_path_; }
  [[nodiscard]] const StopQuestion& stop() const { return stop_; }
  [[nodiscard]] std::unique_ptr<Tracer> tracer(const RadiationModel& model, const SceneTree& tree) const;
  [[nodiscard]] RadiationResult simulate(const RadiationModel& model, const SolveSettings& settings) const;

  void compare(const std::string& what, const Estimate& got, double expected, const Ask& ask);
  // Compares two estimates of one value from independent runs with equally many replicates.
  void compare(const std::string& what, const Estimate& got, const Estimate& expected, const Ask& ask);
  // Compares a value that involves no chance.
  void equal(const std::string& what, double got, double expected, double tolerance = 1e-6);

  // Returns the rows added by the cases of a group since the last call; their names begin with the group and a colon.
  [[nodiscard]] std::vector<KnownAnswer> take_rows(const std::string& group);

 private:
  TracerMaker maker_;
  StopQuestion stop_;
  bool cpu_path_;
  std::vector<KnownAnswer> rows_;
};

}  // namespace sunfleck
