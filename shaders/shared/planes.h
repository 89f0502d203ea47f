// Horizontal receivers: where rays cross them, and which of them lie below a place.
#ifndef SUNFLECK_SHARED_PLANES_H
#define SUNFLECK_SHARED_PLANES_H

#include "shared/exact.h"

SHARED_BEGIN

// A receiver, which covers the plot with a grid of cells. Lengths in metres in the canopy's local frame.
struct ReceiverPlane {
  float y;
  float threshold_y;  // places at or above this height lie above the plane
  uint first_cell;    // number of its first cell among those of all planes
  uint cells_x;
  uint cells_z;
};

// Thresholds that all places lie above, and below. (A device may not know infinity.)
const float below_everything = -3.4028234e38f;
const float above_everything = 3.4028234e38f;

// The plot under the receivers.
struct ReceiverPlot {
  vec2 lo;  // x and z
  vec2 per_size;
  uint is_endless;  // 1: cells repeat in every period
};

// Number of a cell where a ray crosses a plane beside an isolated plot.
const uint no_cell = 0xffffffffu;

// Returns where a line crosses a plane along x or z, as a part of the plot's size; `way` is the distance in units of `direction`.
INLINE float crossing_along(float origin, float direction, float way, float lo, float per_size) {
  EXACT float at = ((origin + way * direction) - lo) * per_size;
  return at;
}

// Returns the cell of `cells` that holds a part from 0 to 1 of the plot's size.
INLINE uint cell_along(float part, uint cells) {
  EXACT float cell = part * float(cells);
  if (cell <= 0.0f) return 0u;
  const uint number = cell < 4294967040.0f ? uint(cell) : cells;
  return number < cells ? number : cells - 1u;
}

// Returns the number, over all planes, of the cell where the line through `origin` crosses a plane; no_cell beside an isolated
// plot.
INLINE uint cell_at(ReceiverPlane plane, ReceiverPlot plot, vec3 origin, vec3 direction) {
  EXACT float way = (plane.y - origin.y) * direction_reciprocal(direction.y);
  const float x = crossing_along(origin.x, direction.x, way, plot.lo.x, plot.per_size.x);
  const float z = crossing_along(origin.z, direction.z, way, plot.lo.y, plot.per_size.y);
  if (plot.is_endless == 0u && !(x >= 0.0f && x < 1.0f && z >= 0.0f && z < 1.0f)) return no_cell;
  EXACT float in_x = x - floor(x);
  EXACT float in_z = z - floor(z);
  return plane.first_cell + cell_along(in_x, plane.cells_x) + cell_along(in_z, plane.cells_z) * plane.cells_x;
}

SHARED_END

#endif
