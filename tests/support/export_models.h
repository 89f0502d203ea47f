#pragma once
// Models that the tests of the exports write: two triangles with results chosen by hand, and a simulated maize plant on soil.

#include "base/units.h"
#include "files/results/exports/exports.h"
#include "physics/canopy/maize.h"
#include "support/models.h"

#include <string>
#include <vector>

namespace sunfleck::test {

// Contains characters that end a string, a line, a tag, a number or a field in some format, and a byte that is not UTF-8.
inline const std::string awkward_name = "a \"tip\", <dry> & 'x'\n\x01#;\\\xff\xc3\xa9";

// Returns two triangles of two organs, far from the origin; A is black, B scatters. Both receive sky light.
inline RadiationModel two_triangles() {
  RadiationModel model;
  model.plot = {2.0, 3.0, true};
  model.canopy.origin_m = {10.0, 2000.1, 30.0};
  model.canopy.corners = {{{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}}},
                          {{{0.0F, 3.0F, 0.0F}, {0.0F, 3.0F, 3.0F}, {3.0F, 3.0F, 0.0F}}}};
  model.canopy.organ_of = {0, 1};
  model.canopy.optics_of = {0, 1};
  model.canopy.organs = {{1, "leaf", 7}, {2, awkward_name, 0}};
  model.canopy.optics_names = {"leaf", awkward_name};
  const SurfaceOptics leaf{"leaf", {{0.0, 0.0}, {0.5, 0.25}}, {{0.0, 0.0}, {0.25, 0.0}}, {}};
  model.optics = {leaf, leaf};
  model.bands = {{"A", 100.0, 0.0}, {"B-2", 200.0, 0.0}};
  model.sun = SunPosition{0.5, 1.0};
  model.layers = 1;
  return model;
}

// The first triangle has 20 and 4 landings of 0.01 m2 of level ground; in B a quantum is 0.01 W.
inline RadiationResult two_triangles_result() {
  RadiationResult result;
  result.bands = {{{{100.0, 0.0}, {60.0, 1.0}, {0.0, 0.0}, {30.0, 2.0}, {0.0, 0.0}, {10.0, no_value}}, "A"},
                  {{{200.0, 0.0}, {100.0, 21.0}, {0.0, 0.0}, {60.0, 22.0}, {0.0, 20.0}, {20.0, 20.0}, 20.0}, "B-2"}};
  result.elements = {{20, 4}, {0, 0}};
  result.element_error = {0.5, no_value, 0.75, no_value};
  result.ground_per_ray_m2 = 0.01;
  result.side_indirect = {0, 100, 0, 300, 0, 0, 0, 0};
  result.side_sky = {0, 50, 0, 0, 0, 0, 0, 0};
  result.w_per_quantum = {0.5, 0.01};
  return result;
}

inline RunRecord awkward_record() {
  RunRecord record;
  record.version = "9.8.7";
  record.commit = "0123abc";
  record.title = awkward_name;
  record.scene_file = "scene.toml";
  record.scene_digest = "f00d";
  record.seed = 18446744073709551615U;
  record.grid_m = 0.002;
  return record;
}

// Returns a maize plant that scatters in two bands, over soil of two triangles; periodic, without a soil plane.
inline RadiationModel maize_on_soil() {
  MaizeStand stand;
  stand.rows = 1;
  stand.per_row = 1;
  const Plot plot{stand.spacing_in_row_m, stand.spacing_between_rows_m, true};
  MeshMaker soil;
  soil.organ("soil", 0);
  soil.level(0.0, plot.size_x_m, 0.0, plot.size_z_m, 0.0);
  const std::vector<PlacedMesh> parts = {{make_maize(stand), {Placement{}}}, {soil.mesh(), {Placement{}}}};
  RadiationModel model;
  model.plot = plot;
  model.canopy = assemble_canopy(parts, plot);
  model.bands = {{"PAR", 350.0, 0.0}, {"NIR", 400.0, 0.0}};
  for (const std::string& name : model.canopy.optics_names) {
    const bool is_leaf = name == "leaf";
    const std::vector<FaceOptics> faces = role_from_name(name) == Role::soil ? std::vector<FaceOptics>{{0.15, 0.0}, {0.35, 0.0}}
                                          : is_leaf ? std::vector<FaceOptics>{{0.12, 0.06}, {0.40, 0.45}}
                                                    : std::vector<FaceOptics>{{0.12, 0.0}, {0.40, 0.0}};
    model.optics.push_back({name, faces, faces, {}});
  }
  model.sun = beijing_sun();
  return model;
}

// Returns greys, darker with every triangle.
inline std::vector<ElementColour> grey_colours(std::size_t count) {
  std::vector<ElementColour> colours;
  for (std::size_t e = 0; e < count; ++e) {
    const double linear = 1.0 / (1.0 + static_cast<double>(e));
    const auto srgb = static_cast<std::uint8_t>(e % 256);
    colours.push_back({{linear, linear, linear}, {srgb, srgb, srgb}});
  }
  return colours;
}

}  // namespace sunfleck::test
