#include "programs/validate/known/beam_scenes.h"

#include "base/units.h"

#include <cmath>

namespace sunfleck {
namespace {

constexpr Plot unit_plot{1.0, 1.0, true};

// Adds squares on every second field of a board over a plot of 2 x 2 m.
void add_board(MeshMaker& mesh, int fields, double y_m) {
  const double field_m = 2.0 / fields;
  for (int x = 0; x < fields; ++x) {
    for (int z = x % 2; z < fields; z += 2) mesh.level(x * field_m, (x + 1) * field_m, z * field_m, (z + 1) * field_m, y_m);
  }
}

// Adds a level rectangle that faces up, with its middle at that place (x east, y north, z up).
void add_plate(MeshMaker& mesh, double x, double y, double size_x, double size_y, double z) {
  mesh.quad(from_east_north_up(x - size_x / 2, y - size_y / 2, z), from_east_north_up(x + size_x / 2, y - size_y / 2, z),
            from_east_north_up(x + size_x / 2, y + size_y / 2, z), from_east_north_up(x - size_x / 2, y + size_y / 2, z));
}

}  // namespace

RadiationModel triangle_under(const SunPosition& sun) {
  const glm::dvec3 shift_m(0.055, -0.95, 0.05);
  MeshMaker mesh;
  mesh.triangle(from_east_north_up(0, 0, 1) + shift_m, from_east_north_up(0.04, 0.01, 1.02) + shift_m,
                from_east_north_up(0.01, 0.05, 0.99) + shift_m);
  return black_model(mesh.mesh(), {0.06, 0.06, false}, sun);
}

RadiationModel level_plate_case() {
  MeshMaker mesh;
  add_plate(mesh, 0.5, 0.5, 0.4, 0.3, 0.8);
  return black_model(mesh.mesh(), unit_plot, beijing_sun());
}

RadiationModel tilted_plate_case() {
  // Half the sides, along the plate's level line and along its steepest slope.
  const double inclination = 50.0 * degree;
  const double angle = 20.0 * degree;
  const glm::dvec3 along = 0.15 * from_east_north_up(-std::sin(angle), std::cos(angle), 0.0);
  const glm::dvec3 up = 0.1 * from_east_north_up(-std::cos(inclination) * std::cos(angle),
                                                 -std::cos(inclination) * std::sin(angle), std::sin(inclination));
  const glm::dvec3 centre = from_east_north_up(0.5, 0.5, 0.8);
  MeshMaker mesh;
  mesh.quad(centre - along - up, centre + along - up, centre + along + up, centre - along + up);
  return black_model(mesh.mesh(), unit_plot, beijing_sun());
}

RadiationModel two_plates_case() {
  MeshMaker mesh;
  mesh.organ("leaf", 1, 2);
  add_plate(mesh, 0.5, 0.5, 0.4, 0.4, 1.0);
  mesh.organ("leaf", 1, 1);
  add_plate(mesh, 0.2, 0.6, 0.5, 0.3, 0.4);
  return black_model(mesh.mesh(), unit_plot, beijing_sun());
}

RadiationModel blind_under(const SunPosition& sun, double tilt_deg, double beyond) {
  const double across = 0.4 * std::cos(tilt_deg * degree);
  const double rise = 0.4 * std::sin(tilt_deg * degree);
  MeshMaker mesh;
  mesh.quad(from_east_north_up(-across, -beyond, 0.5 - rise), from_east_north_up(across, -beyond, 0.5 + rise),
            from_east_north_up(across, 0.7 + beyond, 0.5 + rise), from_east_north_up(-across, 0.7 + beyond, 0.5 - rise));
  return black_model(mesh.mesh(), {0.7, 1.0, true}, sun);
}

RadiationModel checkerboards_under(const SunPosition& sun) {
  MeshMaker mesh;
  for (int layer = 1; layer <= 3; ++layer) {
    mesh.organ("leaf", 1, layer);
    add_board(mesh, 1 << layer, 2.0 - 0.5 * layer);
  }
  return black_model(mesh.mesh(), {2.0, 2.0, true}, sun);
}

}  // namespace sunfleck
