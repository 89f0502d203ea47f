#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// Runs the shared text on a device, for shared_text_test.cpp.

#include "shared_text.h"

layout(local_size_x = group_size) in;
layout(set = 0, binding = 0, scalar) readonly buffer Beam { BeamBlock beam; };
layout(set = 0, binding = 1, scalar) readonly buffer View { ViewBlock view; };
layout(set = 0, binding = 2, scalar) readonly buffer Inputs { TextInput inputs[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Outputs { TextOutput outputs[]; };
layout(push_constant, scalar) uniform Push { TextPush push; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < push.count) outputs[i] = all_of_the_text(beam, view, inputs[i]);
}
