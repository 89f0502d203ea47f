#include "programs/validate/known/case_scenes.h"

#include "base/random.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {

SunPosition sun_at(double elevation_deg, double azimuth_deg) {
  return {elevation_deg * degree, azimuth_deg * degree};
}

SunPosition beijing_sun() {
  return sun_at(53.0176, 120.569);
}

glm::dvec3 from_east_north_up(double x, double y, double z) {
  return {-y, z, -x};
}

glm::dvec3 inclined(double inclination_rad, double angle_rad) {
  return {std::sin(inclination_rad) * std::cos(angle_rad), std::cos(inclination_rad),
          std::sin(inclination_rad) * std::sin(angle_rad)};
}

void MeshMaker::organ(const std::string& name, int plant, int rank) {
  mesh_.organs.push_back({static_cast<std::uint32_t>(plant), name, rank});
  mesh_.optics_names.push_back(name);
}

void MeshMaker::triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  if (mesh_.organs.empty()) organ("leaf");
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  mesh_.vertices.insert(mesh_.vertices.end(), {a, b, c});
  mesh_.triangles.emplace_back(first, first + 1, first + 2);
  mesh_.organ_of.push_back(static_cast<std::uint32_t>(mesh_.organs.size() - 1));
  mesh_.optics_of.push_back(static_cast<std::uint32_t>(mesh_.organs.size() - 1));
}

void MeshMaker::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void MeshMaker::level(double x0, double x1, double z0, double z1, double y) {
  quad({x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0});
}

void MeshMaker::ceiling(double x0, double x1, double z0, double z1, double y) {
  quad({x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1});
}

void MeshMaker::polygon(const glm::dvec3& centre, const glm::dvec3& normal, double area_m2, int corners, double spin_rad) {
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

Mesh random_leaf_mesh(int count, double area_m2, const Plot& plot, double height_m, std::uint64_t seed) {
  RandomStream random(seed, 0);
  MeshMaker mesh;
  for (int leaf = 1; leaf <= count; ++leaf) {
    mesh.organ("leaf", 1, leaf);
    const double x_m = plot.size_x_m * random.unit();
    const double y_m = height_m * (0.1 + 0.9 * random.unit());
    const double z_m = plot.size_z_m * random.unit();
    const double inclination = std::acos(2.0 * random.unit() - 1.0);
    const glm::dvec3 normal = inclined(inclination, 2.0 * std::numbers::pi * random.unit());
    mesh.polygon({x_m, y_m, z_m}, normal, area_m2, 4, 1.5 * random.unit());
  }
  return mesh.mesh();
}

RadiationModel black_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun) {
  RadiationModel model;
  model.plot = plot;
  const PlacedMesh placed{mesh, {Placement{}}};
  model.canopy = assemble_canopy(std::span(&placed, 1), plot);
  for (const std::string& name : model.canopy.optics_names) model.optics.push_back({name, {}, {}, {}, {}});
  model.soil = Soil{};
  model.sun = sun;
  set_bands(model, 1);
  return model;
}

void set_bands(RadiationModel& model, std::size_t count) {
  model.bands.clear();
  for (std::size_t b = 0; b < count; ++b) model.bands.push_back({"band" + std::to_string(b), 1.0, 0.0});
  for (SurfaceOptics& optics : model.optics) optics.upper = optics.lower = std::vector<FaceOptics>(count);
  if (model.soil) model.soil->reflectance.assign(count, 0.0);
}

RadiationModel lamp_model(const Mesh& mesh, const Plot& plot, std::size_t bands) {
  RadiationModel model = black_model(mesh, plot, {});
  model.sun.reset();
  model.soil.reset();
  set_bands(model, bands);
  return model;
}

void set_leaf_bands(RadiationModel& model, std::span<const LeafBand> bands) {
  set_bands(model, bands.size());
  for (std::size_t b = 0; b < bands.size(); ++b) {
    model.bands[b].name = bands[b].name;
    if (model.soil) model.soil->reflectance[b] = bands[b].soil_reflectance;
    const FaceOptics face{bands[b].reflectance, bands[b].transmittance};
    for (SurfaceOptics& optics : model.optics) optics.upper[b] = optics.lower[b] = face;
  }
}

RadiationModel leaf_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun, std::span<const LeafBand> bands) {
  RadiationModel model = black_model(mesh, plot, sun);
  set_leaf_bands(model, bands);
  return model;
}

void shine_from_sky(RadiationModel& model, const SkyModel& sky) {
  for (Waveband& band : model.bands) {
    band.diffuse_w_m2 = band.direct_w_m2;
    band.direct_w_m2 = 0.0;
  }
  model.sky = sky;
}

SolveSettings case_work(const RadiationModel& model, double rays, double packets, int replicates) {
  SolveSettings settings;
  settings.grid_m = std::sqrt(model.plot.area_m2() / rays);
  settings.passes = replicates;
  settings.accuracy.indirect = 1e-5;
  if (packets > 0.0) settings.packets = packets;
  return settings;
}

Estimate absorbed_by_organ(const RadiationModel& model, const RadiationResult& result, std::size_t organ, std::size_t band) {
  const OrganResult& got = result.organs.at(organ);
  return got.absorbed.at(band).scaled(got.area_m2 / model.plot.area_m2());
}

}  // namespace sunfleck
