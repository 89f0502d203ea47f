// Places where rays and packets landed.
#include "pass.glsl"

#include "corners.glsl"

#include "shared/beam.h"

WaitingPlace place_of(Landing landing) {
  WaitingPlace place = WaitingPlace(landing.surface, landing.triangle, landing.place_a, landing.place_b, -1, 0u, 0u);
  if (landing.surface < landed_on_ground) {
    uint element = landing.surface >> 1u;
    RoundElement of = elements[element];
    place.face = (of.optics_and_role >> 2u) * 2u + (landing.surface & 1u);
    if ((of.optics_and_role & 3u) == role_soil) return place;
    Corners corners = corners_of(element);
    float y = landing_y(corners.a.y, corners.b.y, corners.c.y, landing.place_a, landing.place_b);
    place.level = int(layer_of(y, pass.layer_base_y, pass.layers_per_metre, pass.layers));
  } else if (landing.surface == landed_on_ground) {
    place.order = ground_order + soil_cell(pass.ground, vec2(landing.place_a, landing.place_b));
    place.face = pass.soil_face;
  } else if (landing.surface == left_upwards) {
    place.level = int(pass.layers);
  }
  return place;
}

// Returns a place from which nothing is sent.
WaitingPlace no_place() { return WaitingPlace(0u, 0u, 0.0, 0.0, -1, pass.soil_face, 0u); }

// Counts a place that keeps flux. An end that is read too early costs no more than an unneeded atomic operation.
void keep_place(uint copy, uint order) {
  atomicAdd(copies[copy + small_rows(pass) * pass.columns], uint64_t(1u));
  uint end = (order & ~ground_order) + 1u;
  if (order < ground_order) {
    if (end > state.end_of_elements) atomicMax(state.end_of_elements, end);
  } else {
    if (end > state.end_of_cells) atomicMax(state.end_of_cells, end);
  }
}
