#include "programs/validate/known/exchange_scenes.h"

namespace sunfleck {
namespace {

using std::numbers::pi;
constexpr double plate_step_m = 0.4;

// Returns the lower square, facing up, and the upper one, facing down.
Mesh facing_squares(double gap_m) {
  MeshMaker mesh;
  mesh.organ("first");
  mesh.level(0.0, 1.0, 0.0, 1.0, 0.5);
  mesh.organ("second");
  mesh.ceiling(0.0, 1.0, 0.0, 1.0, 0.5 + gap_m);
  return mesh.mesh();
}

Mesh floor_and_wall(double height_m) {
  MeshMaker mesh;
  mesh.organ("first");
  mesh.level(0.0, 1.0, 0.0, 1.0, 0.5);
  mesh.organ("second");
  mesh.quad({0.0, 0.5, 0.0}, {0.0, 0.5 + height_m, 0.0}, {0.0, 0.5 + height_m, 1.0}, {0.0, 0.5, 1.0});
  return mesh.mesh();
}

// Returns polygons of the discs' area. At the rim they differ by 1.2e-3 of the radius, which affects the factor only in second
// order.
Mesh facing_discs(double first_radius_m, double second_radius_m) {
  constexpr int corners = 64;
  MeshMaker mesh;
  mesh.organ("first");
  mesh.polygon({0.5, 0.5, 0.5}, {0.0, 1.0, 0.0}, pi * first_radius_m * first_radius_m, corners);
  mesh.organ("second");
  mesh.polygon({0.5, 1.5, 0.5}, {0.0, -1.0, 0.0}, pi * second_radius_m * second_radius_m, corners);
  return mesh.mesh();
}

}  // namespace

std::vector<FacingPair> facing_pairs() {
  return {
      {"parallel squares, gap 1", facing_squares(1.0), {1.0, 1.0}, 0.19982490},
      {"parallel squares, gap 0.5", facing_squares(0.5), {1.0, 1.0}, 0.41525328},
      {"perpendicular squares", floor_and_wall(1.0), {1.0, 1.0}, 0.20004378},
      {"floor and wall of height 2", floor_and_wall(2.0), {1.0, 2.0}, 0.23285260},
      {"equal discs", facing_discs(1.0, 1.0), {pi, pi}, 0.38196601},
      {"disc below one of twice its radius", facing_discs(1.0, 2.0), {pi, 4.0 * pi}, 0.76393202},
  };
}

RadiationModel lamp_below_plate(double gap_m, std::span<const PlatePair> bands) {
  RadiationModel model = lamp_model(facing_squares(gap_m), {1.0, 1.0, true}, bands.size());
  model.optics[0].emission_w_m2.assign(bands.size(), 1.0);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    model.optics[0].upper[b].reflectance = bands[b].lamp;
    model.optics[1].upper[b].reflectance = bands[b].other;
  }
  return model;
}

RadiationModel plates_over_soil(std::size_t count, std::span<const PlateStack> bands, SkyFace face) {
  const bool turned = face == SkyFace::lower;
  MeshMaker mesh;
  for (std::size_t k = 0; k < count; ++k) {
    mesh.organ("leaf", 1, static_cast<int>(k + 1));
    const double y_m = plate_step_m * static_cast<double>(count - k);
    if (turned) mesh.ceiling(0.0, 1.0, 0.0, 1.0, y_m);
    if (!turned) mesh.level(0.0, 1.0, 0.0, 1.0, y_m);
  }
  RadiationModel model = black_model(mesh.mesh(), {1.0, 1.0, true}, beijing_sun());
  set_bands(model, bands.size());
  for (std::size_t b = 0; b < bands.size(); ++b) {
    model.soil->reflectance[b] = bands[b].soil_reflectance;
    for (SurfaceOptics& optics : model.optics) {
      (turned ? optics.lower : optics.upper)[b] = bands[b].top;
      (turned ? optics.upper : optics.lower)[b] = bands[b].bottom;
    }
  }
  return model;
}

RadiationModel leaning_strips(int strips) {
  constexpr double pitch_m = 0.5;
  MeshMaker mesh;
  for (int k = 0; k < strips; ++k) {
    const double x_m = (k + 0.3) * pitch_m;
    mesh.quad({x_m, 0.2, 0.0}, {x_m + 0.1, 1.0, 0.0}, {x_m + 0.1, 1.0, 1.0}, {x_m, 0.2, 1.0});
  }
  return leaf_model(mesh.mesh(), {strips * pitch_m, 1.0, true}, beijing_sun(), std::array{nir_band});
}

}  // namespace sunfleck
