// Everything that is passed from the host to the shader that draws pictures.
#ifndef SUNFLECK_SHARED_VIEW_LAYOUT_H
#define SUNFLECK_SHARED_VIEW_LAYOUT_H

#include "shared/layout.h"

SHARED_BEGIN

// How rays leave the camera: through one point; all along `forward`; in directions computed by the host, for a fisheye.
const uint view_perspective = 0u;
const uint view_orthographic = 1u;
const uint view_fisheye = 2u;

// The camera of a picture, as in pictures/drawing/camera.h, in the canopy's local frame. Right and up are scaled by the
// tangents of half the angles of view or, in an orthographic picture, by half its width and height in the scene.
struct ViewBlock {
  vec3 position;
  uint width;
  vec3 forward;
  uint height;
  vec3 right;
  uint samples;  // per pixel
  vec3 up;
  uint elements;  // elements have surfaces 2 * element + side; the ground's cells follow
  GroundMap ground;
  float start;  // depth at which rays begin, set by the caller
  uint kind;
  vec2 circle_centre;  // of a fisheye: the point where forward is seen, 0..1 from the left and from the top
  vec2 per_radius;     // 1 / radius of its circle, in widths and in heights of the picture
};

// One dispatch of a picture: samples first..first+count-1, counted from the row `first_row` on, of one copy of the plot.
struct ViewPush {
  uint first;
  uint count;
  uint first_row;
  uint copy;
};

// The surface that one sample of a pixel sees.
struct SeenSurface {
  uint surface;  // seen_nothing for the sky
  float depth;   // along the camera's forward axis; along the ray for a fisheye
  uint copy;     // number of the plot's copy; 0 is the plot itself
};
const uint seen_nothing = 0xffffffffu;
const uint seen_unfinished = 0xfffffffeu;  // the steps exceed those of a dispatch, so the host looks again

SHARED_END

#endif
