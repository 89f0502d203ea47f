#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require
// Runs the arithmetic of quanta on a device, for quanta_text_test.cpp.

#include "quanta_text.h"

layout(local_size_x = group_size) in;
layout(set = 0, binding = 0, scalar) readonly buffer Inputs { QuantaInput inputs[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Outputs { QuantaOutput outputs[]; };
layout(push_constant, scalar) uniform Push { QuantaPush push; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < push.count) outputs[i] = all_of_the_quanta(inputs[i]);
}
