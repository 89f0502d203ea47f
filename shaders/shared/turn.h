// Copies of a mesh: each stands somewhere, turned about the vertical and scaled. Rays are turned into the frame of the mesh, so
// that one set of triangles serves all copies.
#ifndef SUNFLECK_SHARED_TURN_H
#define SUNFLECK_SHARED_TURN_H

#include "shared/intersect.h"

SHARED_BEGIN

// Where a copy stands. Lengths in metres.
struct CopyTurn {
  vec3 shift;      // the place of the mesh's origin in the canopy's local frame
  float cos_out;   // cosine of the heading times the scale
  float sin_out;   // sine of the heading times the scale
  float scale;     // > 0
  float cos_back;  // cosine of the heading divided by the scale
  float sin_back;  // sine of the heading divided by the scale
  float per_scale;
};

// Returns the height in the canopy of a point of the mesh.
INLINE float placed_height(CopyTurn turn, float y) {
  EXACT float height = y * turn.scale + turn.shift.y;
  return height;
}

// Returns the place in the canopy of a point of the mesh. Clockwise as seen from above means that +x turns towards +z.
INLINE vec3 placed_point(CopyTurn turn, vec3 point) {
  EXACT float x = (point.x * turn.cos_out - point.z * turn.sin_out) + turn.shift.x;
  EXACT float z = (point.x * turn.sin_out + point.z * turn.cos_out) + turn.shift.z;
  return vec3(x, placed_height(turn, point.y), z);
}

INLINE vec3 turned_back(CopyTurn turn, vec3 direction) {
  EXACT float x = direction.x * turn.cos_back + direction.z * turn.sin_back;
  EXACT float y = direction.y * turn.per_scale;
  EXACT float z = direction.z * turn.cos_back - direction.x * turn.sin_back;
  return vec3(x, y, z);
}

// Returns a ray of the canopy as the mesh of the copy sees it. Distances along it, in lengths of its direction, stay the same.
INLINE Ray turned_ray(CopyTurn turn, Ray ray) {
  EXACT vec3 from = ray.origin - turn.shift;
  return make_ray(turned_back(turn, from), turned_back(turn, ray.direction));
}

SHARED_END

#endif
