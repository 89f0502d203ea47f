// The few macros that let the files beside this one compile as GLSL and as C++; nothing else.
// Rules of the shared text: 32-bit float, uint, uint64_t, vectors and free functions; suffixes f and u always; no overloads,
// references, doubles or library calls that are not named here. Lines that decide hit or miss store into EXACT variables: no
// contraction of a*b+c. Division of floats, roots, trigonometry, min and max are not used, because devices may differ in their
// last bit, nor is the product of a vector and a number, which is written v * vec3(x); floor is exact everywhere.
#ifndef SUNFLECK_SHARED_BRIDGE_H
#define SUNFLECK_SHARED_BRIDGE_H

#ifdef __cplusplus

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace sunfleck::shared {
using uint = std::uint32_t;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using std::floor;
using std::uint64_t;
inline uint floatBitsToUint(float value) {
  return std::bit_cast<uint>(value);
}
inline float uintBitsToFloat(uint bits) {
  return std::bit_cast<float>(bits);
}
// Returns the number of the highest bit that is set, -1 if there is none.
inline int findMSB(uint bits) {
  return std::bit_width(bits) - 1;
}
}  // namespace sunfleck::shared

#define EXACT const
#define INLINE inline
#define SHARED_BEGIN namespace sunfleck::shared {
#define SHARED_END }

#else

#define EXACT precise
#define INLINE
#define SHARED_BEGIN
#define SHARED_END

#endif

#endif
