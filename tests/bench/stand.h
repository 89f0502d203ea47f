#pragma once
// The measured canopies: generated maize at 60 x 60 cm, lit by the paper's sun, with its optics.

#include "support/models.h"

#include <cstddef>
#include <utility>

namespace sunfleck::bench {

// Selects whether the plot repeats without end.
enum class Plots { endless, single };

struct Stand {
  explicit Stand(int plants, Plots plots = Plots::endless);
  explicit Stand(RadiationModel given) : model(std::move(given)), prepared(model) {}

  [[nodiscard]] TraceDomain tracer_scene() const { return test::tracer_scene(model); }
  [[nodiscard]] std::size_t triangles() const { return model.canopy.size(); }

  RadiationModel model;
  test::Prepared prepared;
};

// Returns a stand, which is made once and kept; of the stands with more than `large` triangles only the last one is kept.
[[nodiscard]] const Stand& stand_of(int plants, Plots plots = Plots::endless);

// Whether the copies of a plant share its triangles.
enum class Copies { own, shared };

// Returns an endless stand of 64 copies of one plant, turned at random, which is made once and kept: a million triangles.
[[nodiscard]] const Stand& stand_of_copies(Copies copies);

inline constexpr std::size_t large = 1'000'000;

// Number of plants in the paper's sparse plot.
inline constexpr int paper_plants = 12;

}  // namespace sunfleck::bench
