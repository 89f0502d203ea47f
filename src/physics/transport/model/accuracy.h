#pragma once
// The error bounds that a run must reach.

#include <cstddef>

namespace sunfleck {

// The finest figures that a bound holds for. It always holds for the canopy.
enum class ErrorTarget { canopy, organ, triangle, sensors };

// Selects the elements whose spread between replicates is recorded in addition to that of bands, organs and layers; this costs
// memory and time.
enum class ElementErrors {
  skip,
  refine,      // instead, the light of each element is estimated at the end, from the halves of the run
  keep,        // of the flux that each element absorbs
  keep_sides,  // and also of the flux incident on each of its sides
  keep_sides_and_refine,
};

// What a figure is judged against at least, lest a run never end where it is next to nothing: this share of the incident flux,
// or, for the light that vegetation absorbs after the first landings, of all that it absorbs. Organs are judged if they receive
// at least the second share of the mean organ's flux.
inline constexpr double least_judged_share = 0.01;
inline constexpr double least_judged_organ = 0.1;

// Number of replicates after which errors are compared with the bounds for the first time; those of fewer are too uncertain.
inline constexpr std::size_t first_check = 12;

// Returns whether the light of each element is estimated at the end.
[[nodiscard]] constexpr bool refines(ElementErrors errors) {
  return errors == ElementErrors::refine || errors == ElementErrors::keep_sides_and_refine;
}

// Returns whether the spread of each element is kept.
[[nodiscard]] constexpr bool keeps_spreads(ElementErrors errors) {
  return errors != ElementErrors::skip && errors != ElementErrors::refine;
}

// Selects the groups whose light is divided between sunlit and shaded area: organs, the leaves in layers and all leaves, or all
// leaves alone, which takes less time.
enum class ShadeGroups { all, leaves };

// Relative half-widths of the confidence intervals, and the figures to which they apply.
struct Accuracy {
  double direct = 0.001;  // > 0
  double indirect = 0.003;
  double confidence = 0.95;  // 0.5..0.9999
  ErrorTarget of = ErrorTarget::canopy;
};

}  // namespace sunfleck
