#pragma once
// The model's elements grouped as the solver tallies them: a surface holds the elements of one organ with the same optics.

#include "physics/transport/model/model.h"

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

  [[nodiscard]] const Surface& at(std::size_t element) const { return of[number_of[element]]; }
};

// Returns true if anything that light can meet reflects, transmits or emits in some band, so that light continues after its
// first landing.
[[nodiscard]] bool scatters(const RadiationModel& model);

// Returns true if the band's light continues after its first landing or starts on a lamp.
[[nodiscard]] bool scatters(const RadiationModel& model, std::size_t band);

}  // namespace sunfleck
