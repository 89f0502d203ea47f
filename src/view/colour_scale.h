#pragma once
// Numbers to colours.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

using Colour = std::array<double, 3>;  // linear red, green, blue, 0..1

// Five classes of irradiance: the colour rank chart. A value v belongs to the class k with bounds[k] <= v < bounds[k + 1];
// the last class includes its upper bound, and values outside are put in the nearest class. A class whose two bounds are
// equal is empty. Where all bounds are equal (nothing but zeros) every value belongs to class 0.
struct RankScale {
  std::array<double, 6> bounds{};
};

// Classes that hold equal shares of the weight (weights: areas, say) of the values above zero; zeros and negative values come
// into class 0 on top of its share, so that a canopy mostly in shade still shows its sunlit part in five colours. A class is
// off its share by no more than the weight of one group of equal values. The scale runs from the smallest to the largest
// value that has weight. Without any weight, or where all values are equal, the bounds are those of equal_interval_ranks.
// values, weights: [item], finite, weights not negative.
[[nodiscard]] RankScale equal_count_ranks(std::span<const double> values, std::span<const double> weights);

// Classes of equal width between 0 and the largest value.
[[nodiscard]] RankScale equal_interval_ranks(std::span<const double> values);

[[nodiscard]] int rank_of(const RankScale& scale, double value);

// From class 0, the darkest shade, to class 4, full sun: distinct in hue and in lightness, also without colour vision.
[[nodiscard]] Colour rank_colour(int rank);

[[nodiscard]] std::array<std::uint8_t, 3> to_srgb(const Colour& linear);
[[nodiscard]] Colour from_srgb(const std::array<std::uint8_t, 3>& srgb);

}  // namespace sunfleck
