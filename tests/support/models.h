#pragma once
// Small scenes built by the tests, and one call that simulates them on the CPU path.

#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/trace_domain.h"
#include "physics/bvh/build.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/solve/solve.h"

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
  return degrees * std::numbers::pi / 180.0;
}

inline SunPosition sun_at(double elevation_deg, double azimuth_deg) {
  return {radians(elevation_deg), radians(azimuth_deg)};
}

// Returns the sun at the paper's instant (validation D2).
inline SunPosition paper_sun() {
  return sun_at(53.0176, 120.569);
}

// Converts validation.md's axes (x east, y north, z up) to the scene's (X south, Y up, Z west).
inline glm::dvec3 from_enu(double x, double y, double z) {
  return {-y, z, -x};
}

// Collects triangles. Each call of organ() begins a new organ, to which the following triangles belong.
class MeshMaker {
 public:
  void organ(const std::string& name, int plant = 1, int rank = 0) {
    mesh_.organs.push_back({static_cast<std::uint32_t>(plant), name, rank});
    mesh_.optics_names.push_back(name);
  }
  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    if (mesh_.organs.empty()) organ("leaf");
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), {a, b, c});
    mesh_.triangles.emplace_back(first, first + 1, first + 2);
    mesh_.organ_of.push_back(static_cast<std::uint32_t>(mesh_.organs.size() - 1));
    mesh_.optics_of.push_back(static_cast<std::uint32_t>(mesh_.organs.size() - 1));
  }
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  // Adds a horizontal rectangle facing up, X from x0 to x1, Z from z0 to z1.
  void level(double x0, double x1, double z0, double z1, double y) { quad({x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0}); }
  // Adds a regular polygon of this area, counter-clockwise about the normal, cut into a fan.
  void polygon(const glm::dvec3& centre, const glm::dvec3& normal, double area_m2, int corners, double spin_rad = 0.0) {
    const double step = 2.0 * std::numbers::pi / corners;
    const double radius_m = std::sqrt(2.0 * area_m2 / (corners * std::sin(step)));
    const glm::dvec3 other = std::abs(normal.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(other, normal));
    const glm::dvec3 v = glm::cross(normal, u);
    const auto at = [&](int k) {
      return centre + radius_m * (std::cos(spin_rad + k * step) * u + std::sin(spin_rad + k * step) * v);
    };
    for (int k = 1; k + 1 < corners; ++k) triangle(at(0), at(k), at(k + 1));
  }
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

 private:
  Mesh mesh_;
};

// Draws numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_()) / 4294967296.0; }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

 private:
  std::mt19937 engine_;
};

// Returns the unit vector with this inclination from the vertical, whose horizontal part points at this angle from X towards Z.
inline glm::dvec3 inclined(double inclination_rad, double angle_rad) {
  return {std::sin(inclination_rad) * std::cos(angle_rad), std::cos(inclination_rad),
          std::sin(inclination_rad) * std::sin(angle_rad)};
}

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

// Returns a model with one band "PAR" of 1 W m-2 on the horizontal; every surface is black, including the soil.
inline RadiationModel black_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun) {
  RadiationModel model;
  model.plot = plot;
  const PlacedMesh placed{mesh, {Placement{}}};
  model.canopy = assemble_canopy(std::span(&placed, 1), plot);
  for (const std::string& name : model.canopy.optics_names) {
    model.optics.push_back({name, {FaceOptics{}}, {FaceOptics{}}, {}});
  }
  model.bands = {{"PAR", 1.0, 0.0}};
  model.soil = Soil{{0.0}, 0.05, {}};
  model.sun = sun;
  return model;
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

// Returns settings for `total_rays` rays in `replicates` replicates.
inline SolveSettings fixed_work(const RadiationModel& model, double total_rays, int replicates = 32, std::uint64_t seed = 1) {
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
