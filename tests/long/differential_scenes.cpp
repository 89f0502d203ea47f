#include "long/differential_scenes.h"

#include "long/differential_parts.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

namespace sunfleck::test::differential {
namespace {

// Builds level plates, some across the plot's border, above or below one that covers all of it.
RadiationModel plates(Random& random, int scene) {
  const Plot plot = random_plot(random);
  MeshMaker maker;
  for (int plate = 1; plate <= 8; ++plate) {
    maker.organ("leaf", 1, plate);
    const double x_m = random.uniform(0.0, plot.size_x_m);
    const double z_m = random.uniform(0.0, plot.size_z_m);
    const double width_m = random.uniform(0.2, 0.6);
    maker.level(x_m, x_m + width_m, z_m, z_m + random.uniform(0.2, 0.6), 0.1 * plate + 0.02);
  }
  if (scene > 0) {
    maker.organ("leaf_cover", 1, 9);
    maker.level(0.0, plot.size_x_m, 0.0, plot.size_z_m, 0.05 + 0.4 * scene);
  }
  return painted_model(maker.mesh(), plot, random_sun(random), random);
}

// Builds a room without other light: either all its surfaces are lamps, or a panel below the ceiling is.
RadiationModel room(Random& random, Plot plot, bool all_glow) {
  MeshMaker maker;
  add_room(maker, {0.05, 0.02, 0.05}, {plot.size_x_m - 0.05, 0.7, plot.size_z_m - 0.05});
  maker.organ("lamp", 1, 7);
  const double x_m = random.uniform(0.2, 0.4);
  const double z_m = random.uniform(0.2, 0.4);
  maker.quad({x_m, 0.6, z_m}, {x_m + 0.2, 0.6, z_m}, {x_m + 0.2, 0.62, z_m + 0.3}, {x_m, 0.62, z_m + 0.3});
  add_leaves(maker, random, {10, 0.02, {{0.2, 0.15, 0.2}, {plot.size_x_m - 0.2, 0.5, plot.size_z_m - 0.2}}, "leaf", 7});
  RadiationModel model = painted_model(maker.mesh(), plot, random_sun(random), random);
  model.sun.reset();
  if (!plot.periodic) model.soil.reset();
  for (Sensor& sensor : model.sensors) sensor.points_m[0].y = 0.05 + 0.5 * sensor.points_m[0].y;
  for (Waveband& band : model.bands) band.direct_w_m2 = 0.0;
  for (SurfaceOptics& optics : model.optics) {
    if (all_glow || optics.name == "lamp") optics.emission_w_m2 = {random.uniform(50.0, 100.0), random.uniform(10.0, 50.0)};
  }
  return model;
}

RadiationModel furnace(Random& random, int scene) {
  RadiationModel model = room(random, random_plot(random, scene % 2 == 0), true);
  // Every surface scatters the same share of the light, whether by reflection or by transmission.
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const double sent_on = random.uniform(0.3, 0.7);
    for (SurfaceOptics& optics : model.optics) {
      FaceOptics& face = optics.upper[b];
      const double through = face.transmittance > 0.0 ? random.uniform(0.3, 0.6) * sent_on : 0.0;
      optics.lower[b] = face = {sent_on - through, through};
    }
  }
  return model;
}

RadiationModel lamps(Random& random, int scene) {
  return room(random, random_plot(random, scene % 2 == 0), false);
}

RadiationModel leaf_canopy(Random& random, int scene) {
  const Plot plot = random_plot(random);
  MeshMaker maker;
  add_leaves(maker, random, {20 + 10 * scene, 0.08 / (1 + scene), above(plot, 0.1, 1.0)});
  return painted_model(maker.mesh(), plot, random_sun(random), random);
}

RadiationModel discs(Random& random, int /*scene*/) {
  const Plot plot = random_plot(random);
  MeshMaker maker;
  for (int disc = 1; disc <= 12; ++disc) {
    maker.organ("leaf", 1, disc);
    const double x_m = random.uniform(0.0, plot.size_x_m);
    const double y_m = random.uniform(0.1, 1.0);
    const double z_m = random.uniform(0.0, plot.size_z_m);
    maker.polygon({x_m, y_m, z_m}, {0.0, 1.0, 0.0}, 0.12, 6, random.uniform(0.0, 1.0));
  }
  return painted_model(maker.mesh(), plot, random_sun(random), random);
}

RadiationModel maize_like(Random& random, int /*scene*/) {
  const Plot plot{0.6, random.uniform(0.8, 1.0), true};
  MeshMaker maker;
  add_plant(maker, random, {0.3, 0.0, 0.2}, 1);
  add_plant(maker, random, {0.25, 0.0, 0.6}, 2);
  return painted_model(maker.mesh(), plot, random_sun(random), random);
}

// Returns a uniform, an overcast or a clear sky, or single lights; the scene with the overcast sky has no sun.
SkyModel random_sky(Random& random, int number) {
  if (number == 0) return {};
  if (number == 1) return {.kind = SkyKind::overcast};
  if (number == 2) return {.kind = SkyKind::general, .cie_type = 12};
  SkyModel lights{.kind = SkyKind::lights};
  for (int light = 0; light < 5; ++light) {
    const double weight = random.uniform(0.5, 2.0);
    const double zenith = random.uniform(0.0, 1.3);
    lights.lights.push_back({weight, inclined(zenith, random.uniform(0.0, 6.28))});
  }
  return lights;
}

RadiationModel sky_light(Random& random, int scene) {
  RadiationModel model = leaf_canopy(random, 0);
  const SkyModel sky = random_sky(random, scene);
  add_sky(model, sky, random.uniform(0.5, 1.5));
  if (scene != 1) return model;
  model.sun.reset();
  for (Waveband& band : model.bands) band.direct_w_m2 = 0.0;
  return model;
}

// Builds leaves on a plot that is not repeated, some of them beside it.
RadiationModel isolated(Random& random, int scene) {
  const Plot plot = random_plot(random, false);
  MeshMaker maker;
  Leaves leaves{20, 0.06, above(plot, 0.1, 0.9)};
  leaves.space.lo_m.x -= 0.2;
  leaves.space.hi_m.z += 0.2;
  add_leaves(maker, random, leaves);
  RadiationModel model = painted_model(maker.mesh(), plot, random_sun(random), random);
  if (scene > 0) add_sky(model, random_sky(random, scene == 1 ? 0 : 3), 0.8);
  return model;
}

// Gives a model new bands with random light and optics; `faces` returns the optics of a band.
template <class Faces>
void set_random_bands(RadiationModel& model, Random& random, int count, const Faces& faces) {
  model.bands.clear();
  for (int b = 0; b < count; ++b) {
    const double direct_w_m2 = random.uniform(0.5, 200.0);
    model.bands.push_back({"band" + std::to_string(b), direct_w_m2, model.sky ? random.uniform(0.5, 100.0) : 0.0});
  }
  for (SurfaceOptics& optics : model.optics) {
    optics.upper.clear();
    optics.lower.clear();
    for (int b = 0; b < count; ++b) {
      optics.upper.push_back(faces(b));
      optics.lower.push_back(faces(b));
    }
  }
  if (!model.soil) return;
  model.soil->reflectance.clear();
  for (int b = 0; b < count; ++b) model.soil->reflectance.push_back(random.uniform(0.0, 0.5));
}

FaceOptics any_face(Random& random) {
  const double sent_on = random.uniform(0.0, 0.9);
  const double reflected = random.uniform(0.0, sent_on);
  return {reflected, sent_on - reflected};
}

// Builds black, transparent, reflecting and nearly white leaves.
RadiationModel wavebands(Random& random, int scene) {
  RadiationModel model = leaf_canopy(random, 0);
  if (scene == 2) add_sky(model, {}, 1.0);
  const std::array<FaceOptics, 5> faces{{{0.0, 0.0}, {0.0, 0.6}, {0.6, 0.0}, {0.5, 0.47}, {0.1, 0.05}}};
  set_random_bands(model, random, 5, [&](int b) { return faces[static_cast<std::size_t>(b)]; });
  return model;
}

RadiationModel twenty_bands(Random& random, int scene) {
  RadiationModel model = leaf_canopy(random, scene % 2);
  if (scene == 1) add_sky(model, {}, 1.0);
  set_random_bands(model, random, 20, [&](int) { return any_face(random); });
  return model;
}

RadiationModel asymmetric(Random& random, int /*scene*/) {
  RadiationModel model = leaf_canopy(random, 1);
  set_random_bands(model, random, 3, [&](int) { return any_face(random); });
  return model;
}

RadiationModel receivers(Random& random, int scene) {
  RadiationModel model = scene == 1 ? isolated(random, 1) : sky_light(random, scene);
  model.planes.clear();
  for (const double height_m : {0.0, 0.15, 0.5, 0.75, 1.2}) add_plane(model, height_m);
  for (int sensor = 0; sensor < 4; ++sensor) {
    const glm::dvec3 normal = random_normal(random);
    add_sensor(model, random, sensor % 2 == 0 ? SensorResponse::cosine : SensorResponse::spherical, normal, 0.9);
  }
  return model;
}

// Builds triangles that coincide with earlier ones, some of them turned over, as separate organs with separate optics.
RadiationModel copies(Random& random, int /*scene*/) {
  const Plot plot = random_plot(random);
  MeshMaker maker;
  add_leaves(maker, random, {16, 0.08, above(plot, 0.1, 0.9)});
  const Mesh once = maker.mesh();
  for (std::size_t t = 0; t < once.triangles.size(); t += 3) {
    maker.organ("leaf_copy", 2, static_cast<int>(t));
    const glm::uvec3 corner = once.triangles[t];
    const bool turned = t % 2 == 0;
    maker.triangle(once.vertices[corner.x], once.vertices[turned ? corner.z : corner.y],
                   once.vertices[turned ? corner.y : corner.z]);
  }
  return painted_model(maker.mesh(), plot, random_sun(random), random);
}

// Builds leaves of which some lie in the plane of the beam.
RadiationModel edge_on(Random& random, int /*scene*/) {
  const Plot plot = random_plot(random);
  const SunPosition sun = random_sun(random);
  const glm::dvec3 to_sun = direction_to_sun(sun);
  MeshMaker maker;
  add_leaves(maker, random, {12, 0.08, above(plot, 0.1, 0.9)});
  for (int leaf = 13; leaf <= 20; ++leaf) {
    maker.organ("leaf", 1, leaf);
    const glm::dvec3 normal = glm::normalize(glm::cross(to_sun, random_normal(random)));
    const double x_m = random.uniform(0.0, plot.size_x_m);
    const double y_m = random.uniform(0.2, 0.8);
    const double z_m = random.uniform(0.0, plot.size_z_m);
    maker.polygon({x_m, y_m, z_m}, normal, 0.08, 4, random.uniform(0.0, 1.0));
  }
  return painted_model(maker.mesh(), plot, sun, random);
}

// Builds leaves that reach through the ground or lie below it: one scene has an endless plot; the isolated ones are also lit
// from the side, by a low sun.
RadiationModel through_ground(Random& random, int scene) {
  const Plot plot = random_plot(random, scene == 0);
  MeshMaker maker;
  Leaves leaves{14, 0.1, above(plot, plot.periodic ? -0.1 : -0.4, 0.1)};
  leaves.space.lo_m.x -= plot.periodic ? 0.0 : 0.1;
  add_leaves(maker, random, leaves);
  add_leaves(maker, random, {6, 0.08, above(plot, 0.3, 0.8), "leaf", 14});
  const double elevation_deg = random.uniform(20.0, 35.0);
  RadiationModel model = painted_model(maker.mesh(), plot, sun_at(elevation_deg, random.uniform(0.0, 360.0)), random);
  if (scene == 2) add_sky(model, {}, 0.7);
  return model;
}

RadiationModel low_sun(Random& random, int scene) {
  const Plot plot = random_plot(random, scene != 2);
  MeshMaker maker;
  add_leaves(maker, random, {16, 0.02, above(plot, 0.05, 0.6)});
  return painted_model(maker.mesh(), plot, sun_at(2.0, random.uniform(0.0, 360.0)), random);
}

// Builds strips up to twice as long as the plot is wide, over a leaf that is larger than the whole plot. No strip is level,
// because its copies would lie in one plane.
RadiationModel large_leaves(Random& random, int /*scene*/) {
  const Plot plot{random.uniform(0.4, 0.6), random.uniform(0.4, 0.6), true};
  MeshMaker maker;
  for (int strip = 1; strip <= 6; ++strip) {
    maker.organ("leaf", 1, strip);
    const double half_length_m = random.uniform(0.35, 0.5);
    const double half_width_m = random.uniform(0.02, 0.05);
    const double tilt = random.uniform(0.3, 0.7);
    const glm::dvec3 along = inclined(0.5 * std::numbers::pi - tilt, random.uniform(0.2, 1.3));
    const glm::dvec3 across = glm::normalize(glm::cross(along, random_normal(random)));
    const glm::dvec3 centre_m{random.uniform(0.0, plot.size_x_m), random.uniform(0.9, 1.2), random.uniform(0.0, plot.size_z_m)};
    const glm::dvec3 far_m = half_length_m * along;
    const glm::dvec3 side_m = half_width_m * across;
    maker.quad(centre_m - far_m - side_m, centre_m + far_m - side_m, centre_m + far_m + side_m, centre_m - far_m + side_m);
  }
  maker.organ("leaf_large", 1, 7);
  const double tilt = random.uniform(0.1, 0.3);
  const glm::dvec3 normal = inclined(tilt, random.uniform(0.2, 1.3));
  maker.polygon({0.2, 0.3, 0.2}, normal, random.uniform(0.4, 0.6), 4, 0.5);
  return painted_model(maker.mesh(), plot, random_sun(random), random);
}

RadiationModel no_soil(Random& random, int scene) {
  RadiationModel model = scene == 1 ? isolated(random, 0) : leaf_canopy(random, scene / 2);
  model.soil.reset();
  if (scene == 2) add_sky(model, {.kind = SkyKind::overcast}, 0.5);
  return model;
}

// Builds soil from triangles, with or without the soil plane below.
RadiationModel soil_mesh(Random& random, int scene) {
  const Plot plot = random_plot(random, scene != 2);
  MeshMaker maker;
  add_soil_sheet(maker, random, plot);
  add_leaves(maker, random, {14, 0.08, above(plot, 0.3, 0.9)});
  RadiationModel model = painted_model(maker.mesh(), plot, random_sun(random), random);
  if (scene == 1) model.soil.reset();
  return model;
}

constexpr std::array<SceneKind, 19> kinds{{{"Plates", 3, plates},
                                           {"Furnace", 3, furnace},
                                           {"LeafCanopy", 4, leaf_canopy},
                                           {"Discs", 3, discs},
                                           {"MaizeLike", 3, maize_like},
                                           {"SkyLight", 4, sky_light},
                                           {"Isolated", 3, isolated},
                                           {"Wavebands", 3, wavebands},
                                           {"Receivers", 3, receivers},
                                           {"Copies", 3, copies},
                                           {"EdgeOn", 3, edge_on},
                                           {"ThroughGround", 3, through_ground},
                                           {"LowSun", 3, low_sun},
                                           {"LargeLeaves", 3, large_leaves},
                                           {"Lamps", 3, lamps},
                                           {"Asymmetric", 4, asymmetric},
                                           {"TwentyBands", 3, twenty_bands},
                                           {"NoSoil", 3, no_soil},
                                           {"SoilMesh", 3, soil_mesh}}};

}  // namespace

std::span<const SceneKind> scene_kinds() {
  return kinds;
}

RadiationModel make_scene(const SceneKind& kind, int scene) {
  const auto number = static_cast<std::uint32_t>(
      std::find_if(kinds.begin(), kinds.end(), [&](const SceneKind& k) { return k.make == kind.make; }) - kinds.begin());
  Random random(1000 * (number + 1) + static_cast<std::uint32_t>(scene));
  return kind.make(random, scene);
}

}  // namespace sunfleck::test::differential
