#pragma once
// A box along the axes, for the tests of cameras that are to show one.

#include <glm/vec3.hpp>

namespace sunfleck::test {

struct ViewedBox {
  glm::dvec3 lo_m, hi_m;
};

}  // namespace sunfleck::test
