// The buffers of an indirect pass, the same for all shaders of its rounds.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "shared/rounds.h"

struct Corners {
  vec3 a, b, c;
};

layout(local_size_x = round_group_size) in;
layout(push_constant, scalar) uniform Push { RoundPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer Pass { PassBlock pass; };
layout(set = 0, binding = 1, scalar) buffer State { RoundState state; };
layout(set = 0, binding = 2, scalar) buffer Columns { RoundColumn columns[]; };
layout(set = 0, binding = 3, scalar) buffer Totals { uint64_t totals[]; };  // small sums, then what moved from places
layout(set = 0, binding = 4, scalar) buffer Copies { uint64_t copies[]; };  // of the small sums
layout(set = 0, binding = 5, scalar) readonly buffer Faces { uint64_t faces[]; };  // what they reflect, then what they scatter
layout(set = 0, binding = 6, scalar) readonly buffer Elements { RoundElement elements[]; };
layout(set = 0, binding = 7, scalar) readonly buffer AllCorners { Corners all_corners[]; };  // of elements, then of meshes
layout(set = 0, binding = 8, scalar) buffer NextPlaces { WaitingPlace next_places[]; };
layout(set = 0, binding = 9, scalar) buffer NextQuanta { uint64_t next_quanta[]; };
layout(set = 0, binding = 10, scalar) buffer Places { WaitingPlace places[]; };
layout(set = 0, binding = 11, scalar) buffer Quanta { uint64_t quanta[]; };
layout(set = 0, binding = 12, scalar) buffer Sums { uint64_t sums[]; };
layout(set = 0, binding = 13, scalar) buffer BlockSums { uint64_t block_sums[]; };
layout(set = 0, binding = 14, scalar) buffer Numbers { uint numbers[]; };  // of the packets' sides
layout(set = 0, binding = 15, scalar) buffer Weights { uint weights[]; };
layout(set = 0, binding = 16, scalar) buffer Packets { Packet packets[]; };
layout(set = 0, binding = 17, scalar) buffer PacketOrder { uint ordered_packets; uint packet_order[]; };
layout(set = 0, binding = 18, scalar) readonly buffer Landings { Landing landings[]; };
layout(set = 0, binding = 19, scalar) buffer SideLanded { uint64_t side_landed[]; };
layout(set = 0, binding = 20, scalar) buffer ElementHits { uint element_hits[]; };
layout(set = 0, binding = 21, scalar) buffer CellLanded { uint64_t cell_landed[]; };
layout(set = 0, binding = 22, scalar) buffer SurfaceLanded { uint64_t surface_landed[]; };
layout(set = 0, binding = 23, scalar) buffer Groups { uint groups[]; };  // [kind * 3]
layout(set = 0, binding = 24, scalar) buffer Outbox { uint paused_packets; };
layout(set = 0, binding = 25, scalar) readonly buffer Runs { ElementRun runs[]; };  // in the order of their elements
layout(set = 0, binding = 26, scalar) readonly buffer Planes { ReceiverPlane planes[]; };
layout(set = 0, binding = 27, scalar) buffer PlaneCells { uint64_t plane_cells[]; };  // what came down through them

// Returns whether there is nothing to do: all columns are retired, or the host has to finish the last round first.
bool is_at_rest() { return state.done != 0u || state.has_to_wait != 0u; }

uint run_count() { return parts_of(state.places, round_group_size); }

uint side_count() { return 2u * state.places; }

// Returns of how many numbers running sums are made.
uint summed_numbers() { return push.first == sums_of_runs ? run_count() * place_parts : side_count(); }

// Returns how many packets this dispatch has.
uint packets_here() { return min(push.count, state.packets - push.first); }

void set_groups(uint kind, uint threads, uint group_size) { groups[kind * 3u] = parts_of(threads, group_size); }

// A side from which packets start: of the upper sides of all places, then of the lower ones.
struct Side {
  uint place;
  uint side;
};

Side side_of(uint number) {
  return number < state.places ? Side(number, 0u) : Side(number - state.places, 1u);
}

// What a side sends of what landed at its place: the part between two coefficients, [from + column] and [to + column]; `from` is
// no_coefficients for the side on which it landed.
struct Sent {
  uint from;
  uint to;
  uint u;
};
const uint no_coefficients = 0xffffffffu;

Sent sent_from(Side side) {
  WaitingPlace place = places[side.place];
  uint reflected = place.face * pass.columns;
  if ((place.surface & 1u) == side.side) return Sent(no_coefficients, reflected, place.u);
  return Sent(reflected, reflected + pass.faces * pass.columns, place.u);
}

uint64_t quanta_sent(uint64_t landed, Sent sent, uint column) {
  uint64_t to = part_of(landed, faces[sent.to + column], sent.u);
  return sent.from == no_coefficients ? to : to - part_of(landed, faces[sent.from + column], sent.u);
}

// Returns the running sum of all numbers before the k-th.
uint64_t sum_before(uint k) { return k > 0u ? sums[k - 1u] : uint64_t(0u); }

uint64_t drawn_before(uint side) { return drawn_up_to(sum_before(side), state.gain, state.offset); }

// Return where the totals have a kind of sum at a place of a stack, and what moved from there.
uint word_of_place(PlaneStack stack, uint kind, uint place, uint column) {
  return place_row(stack, kind, place) * pass.columns + column;
}
uint moved_word(PlaneStack stack, uint place, uint column) {
  return small_words(pass) + (stack.first_moved + place) * pass.columns + column;
}

// Returns where this group's copy of the small sums begins.
uint own_copy() { return (gl_WorkGroupID.x % pass.choices.copies) * small_words(pass); }

void add_to_row(uint copy, uint row, uint column, uint64_t value) {
  atomicAdd(copies[copy + row * pass.columns + column], value);
}
