// Beam rays: their origins, their steps from one period of an endless plot to the next, and the counters for their landings.
#ifndef SUNFLECK_SHARED_BEAM_H
#define SUNFLECK_SHARED_BEAM_H

#include "shared/intersect.h"
#include "shared/layout.h"
#include "shared/random.h"

SHARED_BEGIN

// Returns the origin of one jittered ray per cell. Rays are numbered along strips four rows wide, column by column, so that
// rays with nearby numbers start near each other whatever the grid's size.
INLINE vec3 beam_origin(BeamBlock beam, uint ray) {
  const uint rays_per_strip = 4u * beam.columns;
  const uint strip = ray / rays_per_strip;
  const uint in_strip = ray - strip * rays_per_strip;
  const uint rows_left = beam.rows - 4u * strip;
  const uint strip_rows = rows_left < 4u ? rows_left : 4u;
  const uint column = in_strip / strip_rows;
  const uint row = 4u * strip + (in_strip - column * strip_rows);
  const uvec4 words = random_words(beam.key, ray, 0u);
  EXACT float u = (float(column) + unit_interval(words.x)) * beam.per_column;
  EXACT float v = (float(row) + unit_interval(words.y)) * beam.per_row;
  EXACT vec3 at = beam.corner + (beam.edge_u * vec3(u) + beam.edge_v * vec3(v));
  return at;
}

// The next border of the period that a ray reaches.
struct Crossing {
  float t;       // where the ray crosses it, at least 0
  float limit;   // up to where hits belong to this period: a little past the crossing, so that none falls between two periods
  bool along_x;  // true if the border is x = constant
};

INLINE Crossing next_crossing(Ray ray, vec2 period, vec2 overlap) {
  const bool north_to_south = ray.inverse.x > 0.0f;
  const bool east_to_west = ray.inverse.z > 0.0f;
  EXACT float x = ((north_to_south ? period.x : 0.0f) - ray.origin.x) * ray.inverse.x;
  EXACT float z = ((east_to_west ? period.y : 0.0f) - ray.origin.z) * ray.inverse.z;
  EXACT float limit_x = ((north_to_south ? period.x + overlap.x : -overlap.x) - ray.origin.x) * ray.inverse.x;
  EXACT float limit_z = ((east_to_west ? period.y + overlap.y : -overlap.y) - ray.origin.z) * ray.inverse.z;
  Crossing crossing;
  crossing.along_x = x < z;
  const float nearest = crossing.along_x ? x : z;
  crossing.t = nearest > 0.0f ? nearest : 0.0f;  // in this order, every device turns -0 into 0
  crossing.limit = limit_x < limit_z ? limit_x : limit_z;
  return crossing;
}

INLINE float held_within(float value, float lo, float hi) {
  return value < lo ? lo : (value > hi ? hi : value);
}

// Returns the point where the ray enters the next period: exactly on the opposite border, so that no error of wrapping
// accumulates.
INLINE vec3 enter_next_period(Ray ray, Crossing crossing, vec2 period) {
  const vec3 at = point_along(ray.origin, ray.direction, crossing.t);
  const float border_x = ray.inverse.x > 0.0f ? 0.0f : period.x;
  const float border_z = ray.inverse.z > 0.0f ? 0.0f : period.y;
  return vec3(crossing.along_x ? border_x : held_within(at.x, 0.0f, period.x), at.y,
              crossing.along_x ? held_within(at.z, 0.0f, period.y) : border_z);
}

// The point where a ray that travels downwards meets the ground, and how far the ray is followed to find elements.
struct Ground {
  float t;
  float limit;  // a little below the ground
};

INLINE Ground meet_ground(Ray ray, GroundMap map) {
  EXACT float t = (map.y - ray.origin.y) * ray.inverse.y;
  EXACT float limit = (map.y - map.depth - ray.origin.y) * ray.inverse.y;
  Ground ground;
  ground.t = t > 0.0f ? t : 0.0f;
  ground.limit = limit;
  return ground;
}

// Returns the point where a ray that travels upwards has left an endless canopy.
INLINE Ground meet_top(Ray ray, float top_y) {
  EXACT float t = (top_y - ray.origin.y) * ray.inverse.y;
  Ground top;
  top.t = t > 0.0f ? t : 0.0f;
  top.limit = top.t;
  return top;
}

// Returns the number of an element's copy as seen from the next period.
INLINE uint image_in_next_period(uint image, Ray ray, bool along_x) {
  const uint step = (along_x ? ray.inverse.x : ray.inverse.z) > 0.0f ? 0xffffu : 1u;  // -1 or +1 in 16 bits
  const uint dx = (image + (along_x ? step : 0u)) & 0xffffu;
  const uint dz = ((image >> 16u) + (along_x ? 0u : step)) & 0xffffu;
  return dx | dz << 16u;
}

// Returns x and z of the ray at t.
INLINE vec2 ground_point(Ray ray, float t) {
  EXACT float x = ray.origin.x + t * ray.direction.x;
  EXACT float z = ray.origin.z + t * ray.direction.z;
  return vec2(x, z);
}

INLINE bool in_plot(GroundMap map, vec2 at) {
  return at.x >= map.plot_lo.x && at.x <= map.plot_hi.x && at.y >= map.plot_lo.y && at.y <= map.plot_hi.y;
}

// Returns whether a ray that travels downwards meets the plot's rectangle of ground. A ray lands on elements down to `depth`
// below the ground, and a packet starts as much again before its element; a ray that starts lower meets no ground.
INLINE bool falls_on_plot(Ray ray, GroundMap map) {
  EXACT float lowest_start = map.y - 2.0f * map.depth;
  if (ray.origin.y < lowest_start) return false;
  return in_plot(map, ground_point(ray, meet_ground(ray, map).t));
}

// Returns the number of the cell of the soil's map, x fastest. Points just outside count in the outermost cells.
INLINE uint soil_cell(GroundMap map, vec2 at) {
  EXACT float column = (held_within(at.x, map.plot_lo.x, map.plot_hi.x) - map.plot_lo.x) * map.cells_per_metre.x;
  EXACT float row = (held_within(at.y, map.plot_lo.y, map.plot_hi.y) - map.plot_lo.y) * map.cells_per_metre.y;
  const uint x = uint(column);
  const uint z = uint(row);
  return (x < map.cells_x ? x : map.cells_x - 1u) + (z < map.cells_z ? z : map.cells_z - 1u) * map.cells_x;
}

// Returns the layer that holds a height; heights below or above all layers count in the nearest one.
INLINE uint layer_of(float y, float base_y, float layers_per_metre, uint layers) {
  EXACT float above = (y - base_y) * layers_per_metre;
  if (!(above > 0.0f)) return 0u;
  const uint layer = uint(held_within(above, 0.0f, 1e6f));
  return layer < layers ? layer : layers - 1u;
}

// Returns the height of a hit, limited to the range between its triangle's lowest and highest corner, so that the triangle
// reaches into its layer.
INLINE float landing_y(float a, float b, float c, float weight_b, float weight_c) {
  EXACT float y = a + (weight_b * (b - a) + weight_c * (c - a));
  return held_among(y, a, b, c);
}

SHARED_END

#endif
