#include "programs/validate/case_bench.h"

#include <cmath>
#include <utility>

namespace sunfleck {

std::unique_ptr<Tracer> CaseBench::tracer(const RadiationModel& model, const SceneTree& tree) const {
  return maker_(tree.bvh, trace_domain(model), tree.layout.words());
}

RadiationResult CaseBench::simulate(const RadiationModel& model, const SolveSettings& settings) const {
  const SceneTree tree(model);
  const std::unique_ptr<Tracer> device = tracer(model, tree);
  RadiationResult result = solve(model, tree.layout, *device, settings, {{}, stop_});
  if (result.stop == StopReason::interrupted) throw CaseInterrupted();
  return result;
}

void CaseBench::compare(const std::string& what, const Estimate& got, double expected, const Ask& ask) {
  const double error = got.half_width / t_quantile(ask.confidence, ask.replicates);
  KnownAnswer row{what, expected, got.value};
  row.standard_error = std::hypot(error, ask.reference_error);
  row.replicates = ask.replicates;
  row.largest_error = ask.largest_error;
  row.tolerance = ask.tolerance;
  rows_.push_back(row);
}

void CaseBench::compare(const std::string& what, const Estimate& got, const Estimate& expected, const Ask& ask) {
  Ask both = ask;
  both.reference_error = expected.half_width / t_quantile(ask.confidence, ask.replicates);
  compare(what, got, expected.value, both);
}

void CaseBench::equal(const std::string& what, double got, double expected, double tolerance) {
  KnownAnswer row{what, expected, got};
  row.tolerance = tolerance;
  rows_.push_back(row);
}

std::vector<KnownAnswer> CaseBench::take_rows(const std::string& group) {
  for (KnownAnswer& row : rows_) row.name = group + ": " + row.name;
  return std::exchange(rows_, {});
}

}  // namespace sunfleck
