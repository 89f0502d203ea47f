// The rounds of an indirect pass: random words, limits of drawing, and all that a device keeps of a pass on its own.
#ifndef SUNFLECK_SHARED_ROUNDS_H
#define SUNFLECK_SHARED_ROUNDS_H

#include "shared/aim.h"
#include "shared/layout.h"
#include "shared/planes.h"
#include "shared/quanta.h"
#include "shared/turn.h"

SHARED_BEGIN

// Used instead of a packet's number for the random words that all packets of a round share: the offset of drawing, and the
// starts of the sequences of directions and of places on lamps.
const uint word_of_offset = 0xffffffffu;
const uint word_of_starts = 0xfffffffeu;

// A round has at least this many packets, and each column is expected in `least_of_column`, in units of 2^-32 of a packet.
const uint64_t least_packets = uint64_t(256u);
const uint64_t least_of_column = uint64_t(16u) << 32u;
// A sum of expectations below this draws nothing.
const uint64_t least_sum = uint64_t(1u) << 20u;

// Value of a place's weight of corner b that stands for a point chosen uniformly on the element: packets of lamps start there.
const float anywhere = -1.0f;

// Returns the weights of corners b and c of a place, and those of the element's middle for `anywhere`.
INLINE vec2 middle_of(float a, float b) {
  const float third = 0.333333343f;
  return a == anywhere ? vec2(third, third) : vec2(a, b);
}

// Order of the first cell of the ground.
const uint ground_order = 0x80000000u;

// Threads of a group in the shaders of rounds.
const uint round_group_size = 128u;
const uint place_parts = element_parts + ground_parts;
// Parts of the sphere by which packets are ordered.
const uint sectors = 128u;
// Each thread of a group turns this many numbers into running sums.
const uint numbers_per_thread = 8u;
const uint numbers_per_block = numbers_per_thread * round_group_size;
// A side writes its number for this many of its packets; the others look for it.
const uint most_numbered = 64u;

// How a device divides the work of a round. None of these affects the results.
struct RoundChoices {
  uint copies;            // of the small sums, so that few threads add to the same one
  uint trace_group_size;  // threads of a group that follows packets
};

// A systematic sample of a beam's rays; packets start where these landed.
struct BeamSample {
  uint rays;    // of the beam
  uint count;   // rays in the sample, at most `rays`
  uint offset;  // random, less than `rays`
};

// What a device knows of a pass. Lengths in metres in the canopy's local frame.
struct PassBlock {
  uint64_t each;          // packets for each column in the first round, in units of 2^-32
  uint64_t unshot_part;   // a column is retired when less than this part of what is absorbed waits
  uint64_t least_judged;  // what is absorbed counts as at least this part of what came in
  uvec2 key;              // of the random words
  vec2 period;            // of an endless plot, along x and z; 0 for an isolated stand
  vec2 per_period;        // 1 / period
  GroundMap ground;
  float offset;  // distance of a packet's origin from its surface
  float layer_base_y;
  float layers_per_metre;
  uint layers;
  uint columns;
  uint optics;  // kinds
  uint faces;   // of the kinds of optics, of the soil plane and of lamps
  uint soil_face;
  uint most_rounds;
  uint most_packets;   // of a round, for which there is room
  BeamSample sampled;  // of landings that the device has kept; their places follow those that the host has sent
  uint sample_word;    // number of the random words of the sample's first ray
  uint counts_hits;    // 1: landings of packets are counted by element
  uint runs;           // of elements; 0: all elements have corners of their own
  uint planes;         // horizontal receivers
  uint zone_of_lamps;  // PlaneReceivers::zone_of_lamps
  ReceiverPlot plot;
  StandSphere stand;  // at which packets are aimed
  RoundChoices choices;
};

// What the shaders of a pass tell each other and the host.
struct RoundState {
  uint64_t all_packets;  // of all rounds so far
  uint64_t offset;       // of drawing
  uint64_t gain;
  uint64_t pace;               // packets drawn for each one expected, in units of 2^-32; more than one where packets are aimed
  uint64_t unaimed;            // sum of the expectations of the first round before places were aimed at, where packets are
  uint64_t parts_of_elements;  // shared::place_part
  uint64_t parts_of_ground;
  uint rounds;
  uint places;       // from which this round's packets are drawn
  uint packets;      // drawn in this round
  uint most_drawn;   // the largest number so far
  uint done;         // 1: no column is left
  uint has_to_wait;  // 1: packets of the last round are still on their way
  uint most_places;
  uint first_places;     // places with flux among the sampled landings
  uint end_of_elements;  // orders, and numbers of cells, of the places that wait next are below these
  uint end_of_cells;
  uint any_least;  // 1: some column is so faint that it needs a least number of packets
};

// A column of a pass.
struct RoundColumn {
  uint64_t start;   // what waited before the first round
  uint64_t total;   // what waits
  uint64_t waited;  // what waited when this round's packets left
  uint64_t incident;
  uint64_t least_of_vegetation;
  uint64_t unshot;
  uint64_t load_factor;
  uint load_shift;
  uint is_active;
  Scale wanted;        // packets for a quantum
  Scale least;         // the same for a faint column
  uint lowest;         // lowest place among the layers at which any waited when this round's packets left
  uint lowest_zone;    // the same among the receivers
  uint64_t from_beam;  // what the beam's first landings leave to be shot, if they are on the device
  uint64_t at_point;   // what landed at each point of the sample
};

// What a device must know of an element.
struct RoundElement {
  uint surface;          // number of its surface
  uint optics_and_role;  // kind of optics * 4, and one of:
};
const uint role_vegetation = 0u;
const uint role_structure = 1u;
const uint role_soil = 2u;

// Consecutive elements of a canopy with copies of meshes, whose corners are kept once for each mesh.
struct ElementRun {
  uint first_element;
  uint first_corners;  // number of its corners in the buffer of all corners
  uint is_copy;        // 1: the corners are those of the mesh, which `turn` places; 0: those of the elements
  CopyTurn turn;
};

// A place where flux waits; see EmissionPoint in physics/transport/indirect/emission.h.
struct WaitingPlace {
  uint surface;
  uint order;
  float a;
  float b;
  int level;
  uint face;
  uint u;
};

// One dispatch: at most `count` packets or words from number `first` on.
struct RoundPush {
  uint first;
  uint count;
};
const uint all_packets = 0xffffffffu;
// Numbers of which running sums are made: of the places of each run in each part, where a run is what one group sorts, and of
// the sides' expectations.
const uint sums_of_runs = 0u;
const uint sums_of_sides = 1u;

// Groups of threads that a round's steps need, as vkCmdDispatchIndirect reads them, each (n, 1, 1).
const uint groups_of_places = 0u;
const uint groups_of_run_sums = 1u;
const uint groups_of_sides = 2u;
const uint groups_of_side_sums = 3u;
const uint groups_of_packets = 4u;
const uint groups_of_traces = 5u;  // of `trace_group_size` threads
const uint kinds_of_groups = 6u;

// The small sums, each with `columns` words but for the last.
const uint sum_weights = 0u;
const uint sum_vegetation = 1u;  // absorbed; in the order of the roles
const uint sum_structure = 2u;
const uint sum_soil = 3u;
const uint sum_reflected = 4u;
const uint sum_transmitted = 5u;
const uint sum_lost = 6u;
const uint sums_of_places = 7u;  // of the places of stacks, then of layers

// Two stacks of horizontal planes cut space into places, numbered from the bottom: those of the layers, into the soil, the layers,
// and above; and the receivers, into their zones (PlaneFlux). For each place of a stack there are sums of what waits, what was
// taken along, and what passed down and up.
const uint place_waiting = 0u;
const uint place_taken = 1u;
const uint place_down = 2u;
const uint place_up = 3u;
const uint kinds_of_places = 4u;
struct PlaneStack {
  uint places;       // 0 without receivers
  uint first_row;    // of the small sums
  uint first_moved;  // of the rows after the small sums, which have what moved from each place
};

// Returns the k-th ray of a sample.
INLINE uint sampled_ray(BeamSample sample_of_beam, uint k) {
  const uint64_t up_to = uint64_t(k) * uint64_t(sample_of_beam.rays) + uint64_t(sample_of_beam.offset);
  return uint(up_to / uint64_t(sample_of_beam.count));
}

// Returns how many parts of `each` hold `count`.
INLINE uint parts_of(uint count, uint each) {
  return (count + each - 1u) / each;
}

// Return the stacks.
INLINE PlaneStack stack_of_layers(PassBlock block) {
  PlaneStack stack;
  stack.places = block.layers + 2u;
  stack.first_row = sums_of_places;
  stack.first_moved = 0u;
  return stack;
}
INLINE PlaneStack stack_of_receivers(PassBlock block) {
  const PlaneStack layers = stack_of_layers(block);
  PlaneStack stack;
  stack.places = block.planes > 0u ? block.planes + 1u : 0u;
  stack.first_row = layers.first_row + kinds_of_places * layers.places;
  stack.first_moved = layers.places;
  return stack;
}

// Returns the row of a kind of sum at a place of a stack.
INLINE uint place_row(PlaneStack stack, uint kind, uint place) {
  return stack.first_row + kind * stack.places + place;
}

// Returns the row of what landed in a layer on a side of a kind of optics.
INLINE uint layer_row(PassBlock block, uint layer, uint kind, uint side) {
  return place_row(stack_of_receivers(block), kinds_of_places, 0u) + (layer * block.optics + kind) * 2u + side;
}

// Returns the number of rows, and of words: two for the places kept and the packets lost follow the rows.
INLINE uint small_rows(PassBlock block) {
  return layer_row(block, block.layers, 0u, 0u);
}
INLINE uint small_words(PassBlock block) {
  return small_rows(block) * block.columns + 2u;
}

// Returns the number of all words: the small sums, and what moved from the places of the stacks.
INLINE uint all_words(PassBlock block) {
  const PlaneStack receivers = stack_of_receivers(block);
  return small_words(block) + (receivers.first_moved + receivers.places) * block.columns;
}

// Returns the load of a column. (A Load inside the column would be laid out differently in C++ and in GLSL.)
INLINE Load column_load(RoundColumn column) {
  Load load;
  load.factor = column.load_factor;
  load.shift = column.load_shift;
  return load;
}

SHARED_END

#endif
