#pragma once
// The canopies that are measured: generated maize at 60 x 60 cm, lit by the paper's sun, with its optics.

#include "support/models.h"

#include <cstddef>

namespace sunfleck::bench {

// Does the plot repeat without end?
enum class Plots { endless, single };

struct Stand {
  explicit Stand(int plants, Plots plots = Plots::endless);

  [[nodiscard]] CpuTracer::Scene tracer_scene() const { return test::tracer_scene(model); }
  [[nodiscard]] std::size_t triangles() const { return model.canopy.size(); }

  RadiationModel model;
  test::Prepared prepared;
};

// Made once and kept; the last one of more than `large` triangles alone.
[[nodiscard]] const Stand& stand_of(int plants, Plots plots = Plots::endless);

inline constexpr std::size_t large = 1'000'000;

// The paper's sparse plot.
inline constexpr int paper_plants = 12;

}  // namespace sunfleck::bench
