#pragma once
// The measured canopies: generated maize at 60 x 60 cm, lit by the paper's sun, with its optics.

#include "support/models.h"

#include <cstddef>

namespace sunfleck::bench {

// Selects whether the plot repeats without end.
enum class Plots { endless, single };

struct Stand {
  explicit Stand(int plants, Plots plots = Plots::endless);

  [[nodiscard]] TraceDomain tracer_scene() const { return test::tracer_scene(model); }
  [[nodiscard]] std::size_t triangles() const { return model.canopy.size(); }

  RadiationModel model;
  test::Prepared prepared;
};

// Returns a stand, which is made once and kept; of the stands with more than `large` triangles only the last one is kept.
[[nodiscard]] const Stand& stand_of(int plants, Plots plots = Plots::endless);

inline constexpr std::size_t large = 1'000'000;

// Number of plants in the paper's sparse plot.
inline constexpr int paper_plants = 12;

}  // namespace sunfleck::bench
