// The shader of gpu_test.cpp, with one mode per test.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint mode = 0u;    // 0 adds, 1 fetches, 2 writes past the end
layout(constant_id = 1) const uint factor = 1u;  // multiplies the numbers that are added

layout(push_constant, scalar) uniform Push {
  uint count;
  uint addend;
} push;
layout(set = 0, binding = 0, scalar) buffer Words { uint words[]; };
layout(set = 0, binding = 1) uniform usamplerBuffer texels;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  if (mode == 0u) words[i] += factor * push.addend;
  if (mode == 1u) {
    uvec4 texel = texelFetch(texels, int(i));
    for (int k = 0; k < 4; ++k) words[4u * i + uint(k)] = texel[k];
  }
  if (mode == 2u) words[i + push.addend] = 1u;
}
