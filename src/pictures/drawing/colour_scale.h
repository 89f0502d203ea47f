#pragma once
// Maps numbers to colours.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

using Colour = std::array<double, 3>;  // linear red, green, blue, 0..1

// Returns the smallest value that no more than 1 - share of the weight exceeds; 0 without weight. values and weights are [item]
// and finite; weights are not negative; share is in 0..1.
[[nodiscard]] double weighted_quantile(std::span<const double> values, std::span<const double> weights, double share);

// Scales end where no more than a thousandth of the lit area is brighter, because the largest of many estimates is the noise of
// the smallest sliver.
inline constexpr double rank_top_share = 0.999;

// Five classes of irradiance for the colour rank chart. A value v belongs to the class k with bounds[k] <= v < bounds[k + 1];
// the last class includes its upper bound, and values outside belong to the nearest class. A class whose two bounds are equal
// is empty. If all bounds are equal (nothing but zeros), every value belongs to class 0. Values below `lit_from` are in none of
// the five, but unlit.
struct RankScale {
  std::array<double, 6> bounds{};
  bool open = false;      // values exceed the last bound, so the last class has no upper bound
  double lit_from = 0.0;  // 0: nothing is unlit
};

// The class of values that are unlit.
inline constexpr int unlit_rank = -1;

// Returns classes that hold equal shares of the weight (areas, for example) of the values above zero. Values below `lit_from` are
// unlit. Without it, zero and negative values are added to class 0 in addition to its share. A class deviates from its share by
// at most the weight of one group of equal values. The scale runs from the smallest value that has weight to the quantile
// rank_top_share of the values above zero. Without any weight, or if all values are equal, the bounds are those of
// equal_interval_ranks. values and weights are [item] and finite; weights are not negative.
[[nodiscard]] RankScale equal_count_ranks(std::span<const double> values, std::span<const double> weights,
                                          double lit_from = 0.0);

// Returns classes of equal width from 0 to the quantile rank_top_share of the values above zero, or to the largest value if
// nothing has weight.
[[nodiscard]] RankScale equal_interval_ranks(std::span<const double> values, std::span<const double> weights);

// Returns classes between 0 and a top as wide as those, each but the first from a bound to 10^0.4 = 2.5 times as much: the
// fifth class ends at the top, the first holds all that is lit up to a fortieth of it.
[[nodiscard]] RankScale logarithmic_ranks(std::span<const double> values, std::span<const double> weights);

// Returns the share of the weight that each class holds, and as the last number that of unlit values; zeros without weight.
[[nodiscard]] std::array<double, 6> rank_shares(const RankScale& scale, std::span<const double> values,
                                                std::span<const double> weights);

[[nodiscard]] int rank_of(const RankScale& scale, double value);

// Returns a colour from class 0, the darkest shade, to class 4, full sun. They differ in hue and in lightness, also without
// colour vision. That of the unlit class is a grey.
[[nodiscard]] Colour rank_colour(int rank);

// The continuous map, from 0 to the quantile map_top_share of all values by weight (the largest value if that is 0). Brighter
// values take the last colour.
inline constexpr double map_top_share = 0.995;
struct MapScale {
  double top = 0.0;
  bool open = false;  // values exceed the top
};
[[nodiscard]] MapScale make_map_scale(std::span<const double> values, std::span<const double> weights);

// Return the same three scales, from 0 to a given top (> 0).
[[nodiscard]] RankScale rank_scale_to(double top, std::span<const double> values);
[[nodiscard]] RankScale logarithmic_ranks_to(double top, std::span<const double> values);
[[nodiscard]] MapScale map_scale_to(double top, std::span<const double> values);

// Returns the colour of a value in the map; the colour of 0 if the scale has no length.
[[nodiscard]] Colour map_colour(const MapScale& scale, double value);

[[nodiscard]] std::array<std::uint8_t, 3> to_srgb(const Colour& linear);
[[nodiscard]] Colour from_srgb(const std::array<std::uint8_t, 3>& srgb);
// Converts encoded values 0..1 that need not be whole 255ths.
[[nodiscard]] Colour from_encoded(const Colour& encoded);

}  // namespace sunfleck
