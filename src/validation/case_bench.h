#pragma once
// What a known-answer case works with: the device under test, and the table it adds its rows to.

#include "tracers/cpu_tracer.h"
#include "tracers/scene_tree.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/solve.h"
#include "transport/tracer.h"
#include "validation/verdict.h"

#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace sunfleck {

// The device under test: a tracer for a tree, which outlives it, with counters of that length.
using TracerMaker = std::function<std::unique_ptr<Tracer>(const Bvh& bvh, CpuTracer::Scene scene, std::size_t counter_words)>;

// Thrown where the user's wish to stop ends a case.
class CaseInterrupted : public std::exception {};

// What makes a comparison with an estimate a test.
struct Ask {
  std::size_t replicates = 32;   // behind the estimate's error
  double largest_error = 0.0;    // with a larger standard error the comparison says too little, and fails
  double tolerance = 1e-6;       // as in KnownAnswer
  double reference_error = 0.0;  // standard error of the reference itself
  double confidence = 0.95;      // of the estimate's half-width
};

class CaseBench {
 public:
  CaseBench(TracerMaker maker, StopQuestion stop, bool cpu_path)
      : maker_(std::move(maker)), stop_(std::move(stop)), cpu_path_(cpu_path) {}

  // True where the device under test is the CPU path itself.
  [[nodiscard]] bool cpu_path() const { return cpu_path_; }
  [[nodiscard]] const StopQuestion& stop() const { return stop_; }
  [[nodiscard]] std::unique_ptr<Tracer> tracer(const RadiationModel& model, const SceneTree& tree) const;
  [[nodiscard]] RadiationResult simulate(const RadiationModel& model, const SolveSettings& settings) const;

  void compare(const std::string& what, const Estimate& got, double expected, const Ask& ask);
  // Two estimates of one value from independent runs with as many replicates each.
  void compare(const std::string& what, const Estimate& got, const Estimate& expected, const Ask& ask);
  // A value without chance in it.
  void equal(const std::string& what, double got, double expected, double tolerance = 1e-6);

  // What the cases of a group, named before the colon of each row, added since the last call.
  [[nodiscard]] std::vector<KnownAnswer> take_rows(const std::string& group);

 private:
  TracerMaker maker_;
  StopQuestion stop_;
  bool cpu_path_;
  std::vector<KnownAnswer> rows_;
};

}  // namespace sunfleck
