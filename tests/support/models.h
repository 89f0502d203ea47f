#pragma once
// Small scenes beside those of `sunfleck validate`, and one call that simulates a scene on the CPU path.

#include "base/units.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/trace_domain.h"
#include "physics/bvh/build.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/solve/solve.h"
#include "programs/validate/known/case_scenes.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace sunfleck::test {

inline double radians(double degrees) {
  return degrees * degree;
}

// Draws numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_()) / 4294967296.0; }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

 private:
  std::mt19937 engine_;
};

// Returns square leaves of random place and spherical orientation in a box on the plot, one organ each, with ranks from 1.
inline Mesh random_leaves(int count, double area_m2, const Plot& plot, double height_m, std::uint32_t seed) {
  Random random(seed);
  MeshMaker maker;
  for (int leaf = 1; leaf <= count; ++leaf) {
    maker.organ("leaf", 1, leaf);
    const double x_m = random.uniform(0.0, plot.size_x_m);
    const double y_m = random.uniform(0.1 * height_m, height_m);
    const double z_m = random.uniform(0.0, plot.size_z_m);
    const double cosine = random.uniform(-1.0, 1.0);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    maker.polygon({x_m, y_m, z_m}, inclined(std::acos(cosine), angle), area_m2, 4, random.uniform(0.0, 1.5));
  }
  return maker.mesh();
}

// Tree and counters of a model, ready for a tracer.
struct Prepared {
  explicit Prepared(const RadiationModel& model)
      : layout(make_counter_layout(model)), bvh(build_bvh(model.canopy, box_padding_m(model))) {
    number_counters(layout, model.canopy, bvh);
  }
  CounterLayout layout;
  Bvh bvh;
};

inline TraceDomain tracer_scene(const RadiationModel& model) {
  return {model.plot.periodic, model.soil.has_value()};
}

inline constexpr Plot unit_plot{1.0, 1.0, true};
inline constexpr Plot unit_stand{1.0, 1.0, false};

// Replicates of a run whose test needs no other number.
inline constexpr int usual_replicates = 32;

// Returns settings for `total_rays` rays in `replicates` replicates.
inline SolveSettings fixed_work(const RadiationModel& model, double total_rays, int replicates = usual_replicates,
                                std::uint64_t seed = 1) {
  SolveSettings settings;
  settings.grid_m = std::sqrt(model.plot.area_m2() / total_rays);
  settings.passes = replicates;
  settings.seed = seed;
  return settings;
}

inline RadiationResult simulate(const RadiationModel& model, const Prepared& prepared, const SolveSettings& settings,
                                CpuWalk walk = CpuWalk::tree) {
  CpuTracer tracer(prepared.bvh, tracer_scene(model), walk);
  return solve(model, prepared.layout, tracer, settings, {});
}

inline RadiationResult simulate(const RadiationModel& model, const SolveSettings& settings, CpuWalk walk = CpuWalk::tree) {
  return simulate(model, Prepared(model), settings, walk);
}

// Returns the share of the plot's beam that lands on an organ.
inline Estimate share_of_beam(const RadiationModel& model, const RadiationResult& result, std::size_t organ) {
  const OrganResult& got = result.organs.at(organ);
  return got.direct.at(0).scaled(got.area_m2 / model.plot.area_m2() / model.bands.at(0).direct_w_m2);
}

}  // namespace sunfleck::test
