#include "pictures/drawing/colour_scale.h"

#include "base/check.h"
#include "pictures/drawing/viridis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sunfleck {
namespace {

constexpr int rank_count = 5;

// sRGB. Lightness (CIELAB L*) rises by 13 or more from class to class, so that the order survives greyscale print; the hue runs
// from shade to sun as indigo, blue, green, orange, yellow. Any two colours differ by at least 23 in CIELAB, for normal vision
// as well as under the protanope, deuteranope and tritanope simulations of Machado, Oliveira and Fernandes (2009).
constexpr std::array<std::array<std::uint8_t, 3>, rank_count> rank_srgb = {
    {{0x24, 0x1a, 0x63}, {0x20, 0x64, 0xb4}, {0x17, 0xa2, 0x7f}, {0xe8, 0xa5, 0x3a}, {0xff, 0xef, 0x8a}}};

// Darker than the second class and lighter than the first, and without their hue.
constexpr std::array<std::uint8_t, 3> unlit_srgb = {0x4f, 0x4c, 0x48};

// Equal values and their total weight; no class boundary can separate them.
struct Group {
  double value = 0.0;
  double weight = 0.0;
};

// Returns the groups in ascending order of value. Negative values count as zero; values without weight are left out.
std::vector<Group> groups_by_value(std::span<const double> values, std::span<const double> weights) {
  EXPECT(values.size(), ==, weights.size());
  std::vector<Group> items;
  items.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT(std::isfinite(values[i]), ==, true);
    EXPECT(weights[i], >=, 0.0);
    if (weights[i] > 0.0) items.push_back({std::max(values[i], 0.0), weights[i]});
  }
  std::stable_sort(items.begin(), items.end(), [](const Group& a, const Group& b) { return a.value < b.value; });
  std::vector<Group> groups;
  for (const Group& item : items) {
    if (groups.empty() || groups.back().value < item.value) {
      groups.push_back(item);
    } else {
      groups.back().weight += item.weight;
    }
  }
  return groups;
}

double weight_of(std::span<const Group> groups) {
  double weight = 0.0;
  for (const Group& group : groups) weight += group.weight;
  return weight;
}

// Returns the quantile of groups in ascending order; 0 without groups.
double quantile(std::span<const Group> groups, double share) {
  const double wanted = share * weight_of(groups);
  double below = 0.0;
  for (const Group& group : groups) {
    below += group.weight;
    if (below >= wanted) return group.value;
  }
  return groups.empty() ? 0.0 : groups.back().value;
}

std::span<const Group> above_zero(std::span<const Group> groups) {
  return !groups.empty() && groups.front().value == 0.0 ? groups.subspan(1) : groups;
}

double largest_of(std::span<const double> values) {
  return values.empty() ? 0.0 : std::max(0.0, *std::max_element(values.begin(), values.end()));
}

RankScale even_ranks(double top) {
  RankScale scale;
  for (int k = 0; k <= rank_count; ++k) scale.bounds[k] = top * k / rank_count;
  return scale;
}

RankScale equal_interval_ranks(std::span<const Group> groups, std::span<const double> values) {
  const double top = groups.empty() ? largest_of(values) : quantile(above_zero(groups), rank_top_share);
  RankScale scale = even_ranks(top);
  scale.open = !groups.empty() && groups.back().value > top;
  return scale;
}

// Returns the scale with the bounds between its ends in equal steps of their logarithm.
RankScale in_logarithms(RankScale scale) {
  constexpr double decades_a_class = 0.4;
  for (int k = 1; k < rank_count; ++k)
    scale.bounds[k] = scale.bounds.back() * std::pow(10.0, -decades_a_class * (rank_count - k));
  return scale;
}

// IEC 61966-2-1:1999, section 5.2.
double from_encoded(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

double weighted_quantile(std::span<const double> values, std::span<const double> weights, double share) {
  EXPECT(share, >=, 0.0);
  EXPECT(share, <=, 1.0);
  return quantile(groups_by_value(values, weights), share);
}

RankScale equal_count_ranks(std::span<const double> values, std::span<const double> weights, double lit_from) {
  std::vector<Group> groups = groups_by_value(values, weights);
  const auto unlit =
      std::find_if(groups.begin(), groups.end(), [lit_from](const Group& group) { return group.value >= lit_from; });
  groups.erase(groups.begin(), unlit);
  if (groups.size() < 2) {
    RankScale scale = equal_interval_ranks(groups, values);
    scale.lit_from = lit_from;
    return scale;
  }
  const std::span<const Group> lit = above_zero(groups);
  const double lit_weight = weight_of(lit);

  RankScale scale;
  scale.lit_from = lit_from;
  scale.bounds.fill(quantile(lit, rank_top_share));
  scale.bounds[0] = groups.front().value;
  // A group belongs to the class that contains its middle, so that a boundary is off by at most half a group.
  int next = 1;
  double below = 0.0;
  for (const Group& group : lit) {
    const double middle = below + 0.5 * group.weight;
    while (next < rank_count && middle * rank_count >= next * lit_weight) scale.bounds[next++] = group.value;
    below += group.weight;
  }
  scale.bounds.back() = std::max(scale.bounds.back(), scale.bounds[rank_count - 1]);
  scale.open = groups.back().value > scale.bounds.back();
  return scale;
}

RankScale equal_interval_ranks(std::span<const double> values, std::span<const double> weights) {
  return equal_interval_ranks(groups_by_value(values, weights), values);
}

RankScale logarithmic_ranks(std::span<const double> values, std::span<const double> weights) {
  return in_logarithms(equal_interval_ranks(values, weights));
}

RankScale logarithmic_ranks_to(double top, std::span<const double> values) {
  return in_logarithms(rank_scale_to(top, values));
}

std::array<double, 6> rank_shares(const RankScale& scale, std::span<const double> values, std::span<const double> weights) {
  EXPECT(values.size(), ==, weights.size());
  std::array<double, 6> shares{};
  double all = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int rank = rank_of(scale, values[i]);
    shares[rank == unlit_rank ? 5 : static_cast<std::size_t>(rank)] += weights[i];
    all += weights[i];
  }
  for (double& share : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
}

RankScale rank_scale_to(double top, std::span<const double> values) {
  EXPECT(top, >, 0.0);
  RankScale scale = even_ranks(top);
  scale.open = largest_of(values) > top;
  return scale;
}

MapScale map_scale_to(double top, std::span<const double> values) {
  EXPECT(top, >, 0.0);
  return {top, largest_of(values) > top};
}

MapScale make_map_scale(std::span<const double> values, std::span<const double> weights) {
  const std::vector<Group> groups = groups_by_value(values, weights);
  MapScale scale{quantile(groups, map_top_share)};
  if (scale.top == 0.0) scale.top = groups.empty() ? 0.0 : groups.back().value;
  scale.open = !groups.empty() && groups.back().value > scale.top;
  return scale;
}

Colour map_colour(const MapScale& scale, double value) {
  return viridis(scale.top > 0.0 ? value / scale.top : 0.0);
}

int rank_of(const RankScale& scale, double value) {
  if (scale.lit_from > 0.0 && value < scale.lit_from) return unlit_rank;
  if (!(scale.bounds.front() < scale.bounds.back())) return 0;
  int rank = 0;
  while (rank + 1 < rank_count && value >= scale.bounds[rank + 1]) ++rank;
  return rank;
}

Colour rank_colour(int rank) {
  EXPECT(rank, >=, unlit_rank);
  EXPECT(rank, <, rank_count);
  if (rank == unlit_rank) return from_srgb(unlit_srgb);
  return from_srgb(rank_srgb[rank]);
}

// IEC 61966-2-1:1999, section 5.2.
std::array<std::uint8_t, 3> to_srgb(const Colour& linear) {
  std::array<std::uint8_t, 3> srgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::clamp(linear[i], 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    srgb[i] = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
  }
  return srgb;
}

Colour from_srgb(const std::array<std::uint8_t, 3>& srgb) {
  static const std::array<double, 256> decoded = [] {
    std::array<double, 256> of_byte{};
    for (std::size_t k = 0; k < of_byte.size(); ++k) of_byte[k] = from_encoded(static_cast<double>(k) / 255.0);
    return of_byte;
  }();
  return {decoded[srgb[0]], decoded[srgb[1]], decoded[srgb[2]]};
}

Colour from_encoded(const Colour& encoded) {
  return {from_encoded(encoded[0]), from_encoded(encoded[1]), from_encoded(encoded[2])};
}

}  // namespace sunfleck
