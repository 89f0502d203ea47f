#pragma once
// The model's elements grouped by what the solver tallies: surfaces of one organ with the same optics.

#include "transport/model.h"

#include <cstdint>
#include <vector>

namespace sunfleck {

struct Surface {
  std::uint32_t organ = 0;
  std::uint16_t optics = 0;
  bool soil = false;
};

struct Surfaces {
  explicit Surfaces(const RadiationModel& model);

  std::vector<Surface> of;               // [surface]
  std::vector<std::uint32_t> number_of;  // [element], index into `of`
};

// True if anything that light can meet reflects or transmits in some band, or glows: then light goes on after its first
// landing.
[[nodiscard]] bool scatters(const RadiationModel& model);

// True if the band's light goes on after its first landing or starts on a lamp.
[[nodiscard]] bool scatters(const RadiationModel& model, std::size_t band);

}  // namespace sunfleck
