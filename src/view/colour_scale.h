#pragma once
// Numbers to colours.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

using Colour = std::array<double, 3>;  // linear red, green, blue, 0..1

// The smallest value that no more than 1 - share of the weight exceeds; 0 without weight. values, weights: [item], finite,
// weights not negative; share in 0..1.
[[nodiscard]] double weighted_quantile(std::span<const double> values, std::span<const double> weights, double share);

// Scales end where no more than a thousandth of the lit area is brighter: the very largest of many estimates is the noise of
// the smallest sliver.
inline constexpr double rank_top_share = 0.999;

// Five classes of irradiance: the colour rank chart. A value v belongs to the class k with bounds[k] <= v < bounds[k + 1];
// the last class includes its upper bound, and values outside are put in the nearest class. A class whose two bounds are
// equal is empty. Where all bounds are equal (nothing but zeros) every value belongs to class 0.
struct RankScale {
  std::array<double, 6> bounds{};
  bool open = false;  // values lie above the last bound: the last class has no upper one
};

// Classes that hold equal shares of the weight (weights: areas, say) of the values above zero; zeros and negative values come
// into class 0 on top of its share, so that a canopy mostly in shade still shows its sunlit part in five colours. A class is
// off its share by no more than the weight of one group of equal values. The scale runs from the smallest value that has
// weight to the quantile rank_top_share of those above zero. Without any weight, or where all values are equal, the bounds are
// those of equal_interval_ranks. values, weights: [item], finite, weights not negative.
[[nodiscard]] RankScale equal_count_ranks(std::span<const double> values, std::span<const double> weights);

// Classes of equal width between 0 and the quantile rank_top_share of the values above zero; and the largest value where
// nothing has weight.
[[nodiscard]] RankScale equal_interval_ranks(std::span<const double> values, std::span<const double> weights);

[[nodiscard]] int rank_of(const RankScale& scale, double value);

// From class 0, the darkest shade, to class 4, full sun: distinct in hue and in lightness, also without colour vision.
[[nodiscard]] Colour rank_colour(int rank);

// The continuous map: from 0 to the quantile map_top_share of all values by weight (the largest value where that is 0). What is
// brighter takes the last colour.
inline constexpr double map_top_share = 0.995;
struct MapScale {
  double top = 0.0;
  bool open = false;  // values lie above the top
};
[[nodiscard]] MapScale make_map_scale(std::span<const double> values, std::span<const double> weights);

// The same two scales, from 0 to a top that is given (> 0).
[[nodiscard]] RankScale rank_scale_to(double top, std::span<const double> values);
[[nodiscard]] MapScale map_scale_to(double top, std::span<const double> values);

// The colour of a value in the map; of 0 where the scale has no length.
[[nodiscard]] Colour map_colour(const MapScale& scale, double value);

[[nodiscard]] std::array<std::uint8_t, 3> to_srgb(const Colour& linear);
[[nodiscard]] Colour from_srgb(const std::array<std::uint8_t, 3>& srgb);
// The same for encoded values 0..1 that are no whole 255ths.
[[nodiscard]] Colour from_encoded(const Colour& encoded);

}  // namespace sunfleck
