#include "long/differential_parts.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace sunfleck::test::differential {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

bool is_opaque(const std::string& name) {
  return name.starts_with("stem") || name.starts_with("wall") || name.starts_with("lamp") || name.starts_with("soil");
}

}  // namespace

Plot random_plot(Random& random, bool periodic) {
  const double size_x_m = random.uniform(0.8, 1.3);
  return {size_x_m, random.uniform(0.8, 1.3), periodic};
}

SunPosition random_sun(Random& random) {
  const double elevation_deg = random.uniform(20.0, 75.0);
  return sun_at(elevation_deg, random.uniform(0.0, 360.0));
}

glm::dvec3 random_normal(Random& random) {
  const double cosine = random.uniform(-1.0, 1.0);
  return inclined(std::acos(cosine), random.uniform(0.0, full_turn));
}

Space above(const Plot& plot, double lowest_m, double highest_m) {
  return {{0.0, lowest_m, 0.0}, {plot.size_x_m, highest_m, plot.size_z_m}};
}

void add_leaves(MeshMaker& maker, Random& random, const Leaves& leaves) {
  for (int leaf = 1; leaf <= leaves.count; ++leaf) {
    maker.organ(leaves.name, 1, leaves.rank + leaf);
    glm::dvec3 centre_m;
    for (int axis = 0; axis < 3; ++axis) centre_m[axis] = random.uniform(leaves.space.lo_m[axis], leaves.space.hi_m[axis]);
    const glm::dvec3 normal = random_normal(random);
    maker.polygon(centre_m, normal, leaves.area_m2, 4, random.uniform(0.0, 1.5));
  }
}

void add_plant(MeshMaker& maker, Random& random, const glm::dvec3& foot_m, int plant) {
  constexpr double half_m = 0.02;
  constexpr double height_m = 0.9;
  const std::array<glm::dvec3, 4> corner{
      {{-half_m, 0.0, -half_m}, {-half_m, 0.0, half_m}, {half_m, 0.0, half_m}, {half_m, 0.0, -half_m}}};
  const glm::dvec3 up(0.0, height_m, 0.0);
  maker.organ("stem", plant, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::dvec3 a = foot_m + corner[k];
    const glm::dvec3 b = foot_m + corner[(k + 1) % 4];
    maker.quad(a, b, b + up, a + up);
  }
  const double azimuth = random.uniform(0.0, full_turn);
  for (int leaf = 1; leaf <= 4; ++leaf) {
    maker.organ("leaf", plant, leaf);
    const double heading = azimuth + std::numbers::pi * leaf + random.uniform(-0.4, 0.4);
    const glm::dvec3 along(std::cos(heading), 0.0, std::sin(heading));
    const glm::dvec3 across(-along.z, 0.0, along.x);
    glm::dvec3 midrib_m = foot_m + glm::dvec3(0.0, 0.18 * leaf, 0.0) + along * (half_m + 0.005);
    double half_width_m = 0.05;
    double rise = random.uniform(0.6, 1.1);
    for (int piece = 0; piece < 3; ++piece) {
      const glm::dvec3 next_m = midrib_m + 0.16 * glm::normalize(along + glm::dvec3(0.0, rise, 0.0));
      const double next_width_m = piece == 2 ? 0.01 : half_width_m * 0.9;
      maker.quad(midrib_m - across * half_width_m, midrib_m + across * half_width_m, next_m + across * next_width_m,
                 next_m - across * next_width_m);
      midrib_m = next_m;
      half_width_m = next_width_m;
      rise -= 0.9;
    }
  }
}

void add_room(MeshMaker& maker, const glm::dvec3& lo_m, const glm::dvec3& hi_m) {
  const auto at = [&](int x, int y, int z) {
    return glm::dvec3(x != 0 ? hi_m.x : lo_m.x, y != 0 ? hi_m.y : lo_m.y, z != 0 ? hi_m.z : lo_m.z);
  };
  const std::array<std::array<glm::dvec3, 4>, 6> walls{{{at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)},
                                                        {at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)},
                                                        {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)},
                                                        {at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)},
                                                        {at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)},
                                                        {at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}}};
  int number = 0;
  for (const auto& wall : walls) {
    maker.organ("wall", 1, ++number);
    maker.quad(wall[0], wall[1], wall[2], wall[3]);
  }
}

void add_soil_sheet(MeshMaker& maker, Random& random, const Plot& plot) {
  constexpr int cells = 3;
  std::array<std::array<double, cells>, cells> height_m{};
  for (auto& row : height_m) {
    for (double& height : row) height = random.uniform(0.01, 0.09);
  }
  const auto at = [&](int x, int z) {
    const double height = height_m[static_cast<std::size_t>(x % cells)][static_cast<std::size_t>(z % cells)];
    return glm::dvec3(plot.size_x_m * x / cells, height, plot.size_z_m * z / cells);
  };
  maker.organ("soil", 0, 0);
  for (int x = 0; x < cells; ++x) {
    for (int z = 0; z < cells; ++z) maker.quad(at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z));
  }
}

FaceOptics dark_face(Random& random) {
  const double reflectance = random.uniform(0.05, 0.15);
  return {reflectance, random.uniform(0.02, 0.1)};
}

FaceOptics bright_face(Random& random) {
  const double reflectance = random.uniform(0.3, 0.5);
  return {reflectance, random.uniform(0.2, 0.45)};
}

void paint(RadiationModel& model, Random& random) {
  model.bands = {{"dark", 1.0, 0.0}, {"bright", 1.0, 0.0}};
  for (SurfaceOptics& optics : model.optics) {
    std::vector<FaceOptics> faces{dark_face(random), bright_face(random)};
    for (FaceOptics& face : faces) face.transmittance = is_opaque(optics.name) ? 0.0 : face.transmittance;
    optics.upper = optics.lower = std::move(faces);
  }
  if (model.soil) model.soil->reflectance = {random.uniform(0.05, 0.2), random.uniform(0.15, 0.4)};
}

RadiationModel painted_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun, Random& random) {
  RadiationModel model = black_model(mesh, plot, sun);
  paint(model, random);
  model.layers = 3 + static_cast<int>(random.uniform(0.0, 5.0));
  add_plane(model, random.uniform(0.2, 0.6));
  add_sensor(model, random, SensorResponse::cosine, {0.0, 1.0, 0.0}, 0.8);
  add_sensor(model, random, SensorResponse::spherical, {0.0, 1.0, 0.0}, 0.8);
  return model;
}

void add_sky(RadiationModel& model, const SkyModel& sky, double part) {
  model.sky = sky;
  for (Waveband& band : model.bands) band.diffuse_w_m2 = part;
}

void add_plane(RadiationModel& model, double height_m) {
  model.planes.push_back({height_m, 3, 2});
}

void add_sensor(RadiationModel& model, Random& random, SensorResponse response, const glm::dvec3& normal, double highest_m) {
  Sensor sensor;
  sensor.name = "sensor" + std::to_string(model.sensors.size());
  const double x_m = random.uniform(0.1, 0.9) * model.plot.size_x_m;
  const double y_m = random.uniform(0.05, highest_m);
  sensor.points_m = {{x_m, y_m, random.uniform(0.1, 0.9) * model.plot.size_z_m}};
  sensor.response = response;
  sensor.normal = glm::normalize(normal);
  model.sensors.push_back(sensor);
}

}  // namespace sunfleck::test::differential
