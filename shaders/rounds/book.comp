#version 460
#extension GL_GOOGLE_include_directive : require
// Books what packets from number `first` on carry to their landings, and lets wait there what is scattered; see PacketBooks.
// Each thread takes a packet.

#include "landing_place.glsl"

// Places of a stack of planes: where a packet ended, where it started, and where what it carries had waited.
struct Path {
  uint to, from, waited;
};

// Where a packet ended, and where it came from; see Arrival.
struct Arrival {
  WaitingPlace place;
  Path layers, zones;
};

bool lies_on_lamp(WaitingPlace place) { return place.a == anywhere && place.level >= 0; }

Path path_in_layers(WaitingPlace source, float start_y, WaitingPlace end) {
  uint waited = uint(source.level + 1);
  uint from = waited;
  if (lies_on_lamp(source)) from = layer_of(start_y, pass.layer_base_y, pass.layers_per_metre, pass.layers) + 1u;
  return Path(uint(end.level + 1), from, waited);
}

uint zone_at(float y) {
  uint zone = 0u;
  for (uint p = 0u; p < pass.planes; ++p) zone += y >= planes[p].threshold_y ? 1u : 0u;
  return zone;
}

// Returns the zone in which what waits at a place is counted.
uint zone_of(WaitingPlace place) {
  if (lies_on_lamp(place)) return pass.zone_of_lamps;
  if (place.surface == left_upwards) return pass.planes;
  if (place.surface >= landed_on_ground || place.level < 0) return 0u;
  Corners corners = corners_of(place.surface >> 1u);
  return zone_at(landing_y(corners.a.y, corners.b.y, corners.c.y, place.a, place.b));
}

Path path_in_zones(WaitingPlace source, float start_y, WaitingPlace end) {
  if (pass.planes == 0u) return Path(0u, 0u, 0u);
  uint waited = zone_of(source);
  return Path(zone_of(end), lies_on_lamp(source) ? zone_at(start_y) : waited, waited);
}

Arrival arrival_of(Landing landing, float start_y, WaitingPlace source) {
  WaitingPlace end = place_of(landing);
  return Arrival(end, path_in_layers(source, start_y, end), path_in_zones(source, start_y, end));
}

void book_element(uint copy, WaitingPlace place, uint column, uint64_t carried) {
  RoundElement of = elements[place.surface >> 1u];
  uint side = place.surface & 1u;
  atomicAdd(side_landed[place.surface * pass.columns + column], carried);
  atomicAdd(surface_landed[(of.surface * 2u + side) * pass.columns + column], carried);
  if ((of.optics_and_role & 3u) == role_soil) return;
  add_to_row(copy, layer_row(pass, uint(place.level), of.optics_and_role >> 2u, side), column, carried);
}

void book_end(uint copy, uint surface, uint column, uint64_t carried) {
  uint row = surface == left_upwards ? sum_reflected : (surface == left_downwards ? sum_transmitted : sum_lost);
  add_to_row(copy, row, column, carried);
}

// Books what moves in a stack of planes, whose rows hold differences to the plane below.
void book_planes(uint copy, PlaneStack stack, Path path, bool lost, uint column, uint64_t carried) {
  if (stack.places == 0u) return;
  add_to_row(copy, place_row(stack, place_taken, path.waited), column, carried);
  if (lost || path.from == path.to) return;
  uint kind = path.from > path.to ? place_down : place_up;
  add_to_row(copy, place_row(stack, kind, min(path.from, path.to)), column, carried);
  add_to_row(copy, place_row(stack, kind, max(path.from, path.to)), column, uint64_t(0u) - carried);
}

// Books what a packet carried down to the cells of the receivers that it passed.
void book_cells(uint number, Packet packet, Path zones) {
  for (uint p = zones.to; p < zones.from; ++p) {
    uint cell = cell_at(planes[p], pass.plot, packet.origin, packet.direction);
    if (cell == no_cell) continue;
    for (uint c = 0u; c < pass.columns; ++c) {
      uint64_t own = carried(weights[number * pass.columns + c], column_load(columns[c]));
      if (own != uint64_t(0u)) atomicAdd(plane_cells[cell * pass.columns + c], own);
    }
  }
}

uint role_at(uint surface) {
  return surface == landed_on_ground ? role_soil : elements[surface >> 1u].optics_and_role & 3u;
}

// Splits what landed; returns what is scattered.
uint64_t scatter(uint copy, Arrival arrival, uint column, uint64_t carried) {
  uint coefficient = (pass.faces + arrival.place.face) * pass.columns + column;
  uint64_t scattered = part_of(carried, faces[coefficient], arrival.place.u);
  add_to_row(copy, sum_vegetation + role_at(arrival.place.surface), column, carried - scattered);
  add_to_row(copy, place_row(stack_of_layers(pass), place_waiting, arrival.layers.to), column, scattered);
  if (pass.planes > 0u) {
    add_to_row(copy, place_row(stack_of_receivers(pass), place_waiting, arrival.zones.to), column, scattered);
  }
  return scattered;
}

// Books a column; returns what is scattered of it.
uint64_t book_column(uint copy, Arrival arrival, uint column, uint64_t carried) {
  uint surface = arrival.place.surface;
  bool lost = surface == lost_on_its_way;
  book_planes(copy, stack_of_layers(pass), arrival.layers, lost, column, carried);
  book_planes(copy, stack_of_receivers(pass), arrival.zones, lost, column, carried);
  if (surface > landed_on_ground) {
    book_end(copy, surface, column, carried);
    return uint64_t(0u);
  }
  if (surface == landed_on_ground) {
    atomicAdd(cell_landed[(arrival.place.order - ground_order) * pass.columns + column], carried);
  } else {
    book_element(copy, arrival.place, column, carried);
  }
  return scatter(copy, arrival, column, carried);
}

void main() {
  if (gl_GlobalInvocationID.x >= packets_here() || paused_packets != 0u) return;
  uint number = push.first + gl_GlobalInvocationID.x;
  Landing landing = landings[gl_GlobalInvocationID.x];
  Packet packet = packets[gl_GlobalInvocationID.x];
  Arrival arrival = arrival_of(landing, packet.origin.y, places[numbers[number] >> 1u]);
  arrival.place.u = random_words(pass.key, number, state.rounds).x;
  uint copy = own_copy();
  if (pass.counts_hits != 0u && landing.surface < landed_on_ground) atomicAdd(element_hits[landing.surface >> 1u], 1u);
  if (landing.surface != lost_on_its_way) {
    book_cells(number, packet, arrival.zones);
  } else {
    atomicAdd(copies[copy + small_rows(pass) * pass.columns + 1u], uint64_t(1u));
  }
  bool any = false;
  for (uint c = 0u; c < pass.columns; ++c) {
    uint64_t own = carried(weights[number * pass.columns + c], column_load(columns[c]));
    next_quanta[number * pass.columns + c] = own;
    if (own != uint64_t(0u) && book_column(copy, arrival, c, own) != uint64_t(0u)) any = true;
  }
  if (any) {
    keep_place(copy, arrival.place.order);
  } else {  // keeps its number, but sends nothing
    arrival.place = no_place();
    for (uint c = 0u; c < pass.columns; ++c) next_quanta[number * pass.columns + c] = uint64_t(0u);
  }
  next_places[number] = arrival.place;
}
