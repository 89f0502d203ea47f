#version 460
#extension GL_GOOGLE_include_directive : require
// Books what packets from number `first` on carry to their landings, and lets wait there what is scattered; see PacketBooks.
// Each thread takes a packet.

#include "landing_place.glsl"

// Where a packet ended, and where it came from; see Arrival. to, from and waited number places among the layers.
struct Arrival {
  WaitingPlace place;
  uint to, from, waited;
};

Arrival arrival_of(Landing landing, float start_y, WaitingPlace source) {
  Arrival arrival;
  arrival.place = place_of(landing);
  arrival.to = uint(arrival.place.level + 1);
  arrival.waited = uint(source.level + 1);
  bool from_lamp = source.a == anywhere && source.level >= 0;
  arrival.from = arrival.waited;
  if (from_lamp) arrival.from = layer_of(start_y, pass.layer_base_y, pass.layers_per_metre, pass.layers) + 1u;
  return arrival;
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

// The planes hold differences to the plane below.
void book_planes(uint copy, Arrival arrival, uint column, uint64_t carried) {
  add_to_row(copy, place_row(pass, place_taken, arrival.waited), column, carried);
  if (arrival.place.surface == lost_on_its_way || arrival.from == arrival.to) return;
  uint kind = arrival.from > arrival.to ? place_down : place_up;
  add_to_row(copy, place_row(pass, kind, min(arrival.from, arrival.to)), column, carried);
  add_to_row(copy, place_row(pass, kind, max(arrival.from, arrival.to)), column, uint64_t(0u) - carried);
}

uint role_at(uint surface) {
  return surface == landed_on_ground ? role_soil : elements[surface >> 1u].optics_and_role & 3u;
}

// Splits what landed; returns what is scattered.
uint64_t scatter(uint copy, Arrival arrival, uint column, uint64_t carried) {
  uint coefficient = (pass.faces + arrival.place.face) * pass.columns + column;
  uint64_t scattered = part_of(carried, faces[coefficient], arrival.place.u);
  add_to_row(copy, sum_vegetation + role_at(arrival.place.surface), column, carried - scattered);
  add_to_row(copy, place_row(pass, place_waiting, arrival.to), column, scattered);
  return scattered;
}

// Books a column; returns what is scattered of it.
uint64_t book_column(uint copy, Arrival arrival, uint column, uint64_t carried) {
  uint surface = arrival.place.surface;
  book_planes(copy, arrival, column, carried);
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
  Arrival arrival = arrival_of(landing, packets[gl_GlobalInvocationID.x].origin.y, places[numbers[number] >> 1u]);
  arrival.place.u = random_words(pass.key, number, state.rounds).x;
  uint copy = own_copy();
  if (pass.counts_hits != 0u && landing.surface < landed_on_ground) atomicAdd(element_hits[landing.surface >> 1u], 1u);
  if (landing.surface == lost_on_its_way) {
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
