#include "physics/transport/solve/judge.h"

#include "physics/transport/solve/foresight.h"
#include "physics/transport/solve/work_planner.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace sunfleck {
namespace {

// Lights with less than this share of the brightest one's flux are not compared with the bounds.
constexpr double least_bright_share = 0.01;

template <class Error>
double largest(const std::vector<bool>& judged, const Error& error_of) {
  double largest = 0.0;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    if (!judged[k]) continue;
    const double error = error_of(k);
    if (std::isnan(error)) return error;
    largest = std::max(largest, error);
  }
  return largest;
}

}  // namespace

Judge::Judge(Lights lights, const SolveSettings& settings, bool has_indirect, Tracer& tracer, const StopQuestion& interrupted)
    : lights_(lights), settings_(settings), has_indirect_(has_indirect), judged_(bright_lights(lights, least_bright_share)) {
  const auto neighbours = std::make_shared<std::optional<TriangleNeighbours>>();
  triangles_.reserve(lights.size());
  for (std::size_t k = 0; k < lights.size(); ++k) triangles_.emplace_back(tracer, settings.seed, neighbours, interrupted);
}

void Judge::begin_series() {
  for (RunTriangles& of_light : triangles_) of_light.forget();
}

void Judge::judge_triangles(const Series& series) {
  if (settings_.accuracy.of != ErrorTarget::triangle) return;
  for (std::size_t k = 0; k < lights_.size(); ++k) triangles_[k].judge(*series.sums[k], settings_.accuracy);
}

std::optional<JudgedError> Judge::direct_error_of(const Series& series, std::size_t light) const {
  if (!lights_[light].has_beam()) return std::nullopt;
  JudgedError error = sunfleck::direct_error(*series.sums[light], settings_.accuracy);
  error.raise(triangles_[light].direct_error());
  return error;
}

std::optional<JudgedError> Judge::indirect_error_of(const Series& series, std::size_t light) const {
  if (!has_indirect_) return std::nullopt;
  JudgedError error = sunfleck::indirect_error(*series.sums[light], settings_.accuracy);
  error.raise(triangles_[light].indirect_error());
  return error;
}

double Judge::direct_error(const Series& series, std::size_t light) const {
  return direct_error_of(series, light).value_or(JudgedError{}).relative;
}

double Judge::indirect_error(const Series& series, std::size_t light) const {
  return indirect_error_of(series, light).value_or(JudgedError{}).relative;
}

double Judge::direct_error(const Series& series) const {
  return largest(judged_, [&](std::size_t light) { return direct_error(series, light); });
}

double Judge::indirect_error(const Series& series) const {
  return largest(judged_, [&](std::size_t light) { return indirect_error(series, light); });
}

bool Judge::bounds_hold(const Series& series) const {
  return direct_error(series) <= settings_.accuracy.direct && indirect_error(series) <= settings_.accuracy.indirect;
}

std::size_t Judge::needed_replicates(const Series& series) const {
  const std::size_t done = series.replicates();
  if (done < 2) return planned_replicates;
  const auto needs = [&](double error, double bound) {
    return replicates_needed(error, bound, settings_.accuracy.confidence, done, most_replicates);
  };
  return std::max(needs(direct_error(series), settings_.accuracy.direct),
                  needs(indirect_error(series), settings_.accuracy.indirect));
}

void Judge::refine(std::size_t light, const RunSums& sums, RadiationResult& result) {
  triangles_[light].refine(sums, settings_.accuracy.confidence, result);
}

}  // namespace sunfleck
