#pragma once
// The facts about a scene that a tracer must know besides its tree.

namespace sunfleck {

struct TraceDomain {
  bool periodic = true;  // an endless canopy instead of an isolated stand
  bool has_soil = true;  // there is a soil plane to land on
};

}  // namespace sunfleck
