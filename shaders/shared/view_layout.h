// What crosses from the host to the shader that draws pictures.
#ifndef SUNFLECK_SHARED_VIEW_LAYOUT_H
#define SUNFLECK_SHARED_VIEW_LAYOUT_H

#include "shared/layout.h"

SHARED_BEGIN

// How rays leave the camera: through a point; all along `forward`; in the directions that the host has worked out, a fisheye's.
const uint view_perspective = 0u;
const uint view_orthographic = 1u;
const uint view_fisheye = 2u;

// A picture: the camera as view/camera.h has it, in the canopy's local frame. Right and up are scaled by the tangents of half
// the angles of view, in an orthographic picture by half its width and height in the scene.
struct ViewBlock {
  vec3 position;
  uint width;
  vec3 forward;
  uint height;
  vec3 right;
  uint samples;  // a pixel
  vec3 up;
  uint elements;  // surfaces 2 * element + side, then the ground's cells
  GroundMap ground;
  float start;  // depth at which rays begin, set by whoever looks
  uint kind;
  vec2 circle_centre;  // of a fisheye: where forward is seen, 0..1 from the left and from the top
  vec2 per_radius;     // and 1 / radius of its circle, in widths and in heights of the picture
};

// One dispatch of a picture: samples first..first+count-1, counted from the row `first_row` on, of one copy of the plot.
struct ViewPush {
  uint first;
  uint count;
  uint first_row;
  uint copy;
};

// What one sample of a pixel sees.
struct SeenSurface {
  uint surface;  // seen_nothing where there is only sky
  float depth;   // along the camera's forward axis; of a fisheye along the ray
  uint copy;     // of the plot; 0: the plot itself
};
const uint seen_nothing = 0xffffffffu;
const uint seen_unfinished = 0xfffffffeu;  // more steps than a dispatch has: the host looks again

SHARED_END

#endif
