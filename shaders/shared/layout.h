// Everything that is passed from the host to the shaders: blocks, binding numbers, group size, counter numbers.
#ifndef SUNFLECK_SHARED_LAYOUT_H
#define SUNFLECK_SHARED_LAYOUT_H

#include "shared/bridge.h"

SHARED_BEGIN

const uint group_size = 64u;

// Words of the counters that come before the cells of the soil and the bins of the elements.
const uint counter_transmitted = 0u;  // rays that fell through the ground of a scene without soil
const uint counter_met = 1u;          // isolated stands: rays that met an element or the plot's ground
const uint counter_missed = 2u;       // isolated stands: rays that met neither
const uint counter_lost = 3u;         // rays ended by the guard on crossed periods
const uint counter_first_cell = 16u;

// lavapipe silently ends every loop after 65,535 iterations, counted over all loops of the eight invocations that it runs
// side by side. Where these walk differently their iterations add up, so each may use an eighth. A ray pauses between two
// periods once it has spent the first number of steps; it is handed back to the host if it reaches the second number within
// a period.
const uint steps_before_pause = 4096u;
const uint steps_in_one_dispatch = 8000u;

// A ray that has crossed this many periods is given up and counted as lost.
const uint max_crossings = 1048576u;

// The ground that ends rays, and the grid of the soil's map.
struct GroundMap {
  vec2 plot_lo;  // the plot's rectangle, x and z
  vec2 plot_hi;
  vec2 cells_per_metre;
  uint cells_x;
  uint cells_z;
  float y;
  float depth;  // rays are followed this far below the ground, so that a mesh lying in the ground wins over it
};

// The beam rays of one replicate. Lengths in metres in the canopy's local frame.
struct BeamBlock {
  vec3 corner;       // of the rectangle on which the rays start
  float per_column;  // 1 / columns
  vec3 edge_u;       // along the rectangle's columns
  float per_row;     // 1 / rows
  vec3 edge_v;       // along the rectangle's rows
  uint columns;
  vec3 direction;  // unit vector of travel
  uint rows;
  uvec2 key;     // of the random numbers: seed and replicate
  vec2 period;   // of an endless plot, along x and z
  vec2 overlap;  // distance past the border up to which a hit still counts in the period before it
  GroundMap ground;
  float layer_base_y;
  float layers_per_metre;
  uint layers;
};

// One dispatch of beam rays: rays first..first+count-1 of the replicate, or the paused rays of the inbox.
struct BeamPush {
  uint first;
  uint count;
  uint from_inbox;
  uint first_landing;  // ray of the first place in the buffer of landings; no_landings if they are not wanted
};
const uint no_landings = 0xffffffffu;

// A ray on its way, between two dispatches.
struct PausedRay {
  vec3 origin;
  uint crossings;
  uint ray;
  uint stuck;  // 1: the steps of one period exceed those of a dispatch
};

// The scene as packets need it. Lengths in metres in the canopy's local frame.
struct PacketBlock {
  vec2 period;   // of an endless plot, along x and z
  vec2 overlap;  // as in BeamBlock
  GroundMap ground;
  float top_y;  // above all elements: packets that rise past it have left
};

// A packet at its start. In an endless plot the origin lies in the period that the tree covers.
struct Packet {
  vec3 origin;
  // The element that it leaves, which cannot stop it in the period where it starts; no_element for ground and beam.
  uint element;
  vec3 direction;  // any length
  uint image;      // that element's copy in the period where the packet starts, as BvhTriangle::image
};
const uint no_element = 0xffffffffu;

// The end of a packet's path. The surface is 2 * element + side (place_a, place_b: barycentric weights of corners b and c),
// or one of:
const uint landed_on_ground = 0xfffffff0u;  // place_a, place_b: x and z
const uint left_upwards = 0xfffffff1u;
const uint left_downwards = 0xfffffff2u;
const uint lost_on_its_way = 0xfffffff3u;  // ended by the guard on crossed periods
struct Landing {
  uint surface;
  uint triangle;  // of the tree, in leaf order
  float place_a;
  float place_b;
};

// One dispatch of packets: packets first..first+count-1, or the paused ones of the inbox.
struct PacketPush {
  uint first;
  uint count;
  uint from_inbox;
};

struct PausedPacket {
  vec3 origin;
  uint crossings;
  uint packet;
  uint image;
  uint stuck;  // as in PausedRay
};

SHARED_END

#endif
