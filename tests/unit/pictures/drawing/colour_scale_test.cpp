#include "pictures/drawing/colour_scale.h"

#include "pictures/drawing/viridis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

std::array<double, 5> weight_by_rank(const RankScale& scale, const std::vector<double>& values,
                                     const std::vector<double>& weights) {
  std::array<double, 5> sums{};
  for (std::size_t i = 0; i < values.size(); ++i) sums[rank_of(scale, values[i])] += weights[i];
  return sums;
}

std::vector<double> ones(std::size_t count) {
  return std::vector<double>(count, 1.0);
}

// Converts by CIE 15:2004, section 8.2.1, with the D65 white of IEC 61966-2-1.
Colour lab(const Colour& linear) {
  const auto [r, g, b] = linear;
  const Colour relative = {(0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505, 0.2126 * r + 0.7152 * g + 0.0722 * b,
                           (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089};
  Colour f{};
  for (std::size_t i = 0; i < 3; ++i) {
    f[i] = relative[i] > 216.0 / 24389.0 ? std::cbrt(relative[i]) : (24389.0 / 27.0 * relative[i] + 16.0) / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

TEST(RankOf, FollowsTheBounds) {
  const RankScale scale{{0.0, 10.0, 20.0, 30.0, 40.0, 50.0}};
  EXPECT_EQ(rank_of(scale, 0.0), 0);
  EXPECT_EQ(rank_of(scale, std::nextafter(10.0, 0.0)), 0);
  EXPECT_EQ(rank_of(scale, 10.0), 1);
  EXPECT_EQ(rank_of(scale, 20.0), 2);
  EXPECT_EQ(rank_of(scale, 30.0), 3);
  EXPECT_EQ(rank_of(scale, std::nextafter(40.0, 0.0)), 3);
  EXPECT_EQ(rank_of(scale, 40.0), 4);
  EXPECT_EQ(rank_of(scale, 50.0), 4);
}

TEST(RankOf, PutsValuesOutsideInTheNearestClass) {
  const RankScale scale{{5.0, 10.0, 20.0, 30.0, 40.0, 50.0}};
  EXPECT_EQ(rank_of(scale, -1.0), 0);
  EXPECT_EQ(rank_of(scale, 1e9), 4);
}

TEST(RankOf, SkipsEmptyClasses) {
  const RankScale scale{{0.0, 10.0, 10.0, 10.0, 40.0, 50.0}};
  EXPECT_EQ(rank_of(scale, 9.0), 0);
  EXPECT_EQ(rank_of(scale, 10.0), 3);
}

TEST(EqualIntervalRanks, DividesZeroToTheLargestValue) {
  const RankScale scale = equal_interval_ranks(std::vector<double>{3.0, 100.0, 7.0}, ones(3));
  for (int k = 0; k <= 5; ++k) EXPECT_DOUBLE_EQ(scale.bounds[k], 20.0 * k);
  EXPECT_FALSE(scale.open);
}

// With 1, 2, ... 10000 of weight 1 and half as many zeros, the quantile 0.999 of the values above zero is 9990.
TEST(Ranks, EndWhereAThousandthOfTheLitWeightIsBrighter) {
  std::vector<double> values(15000, 0.0);
  std::iota(values.begin() + 5000, values.end(), 1.0);
  for (const RankScale& scale : {equal_interval_ranks(values, ones(15000)), equal_count_ranks(values, ones(15000))}) {
    EXPECT_EQ(scale.bounds.back(), 9990.0);
    EXPECT_TRUE(scale.open);
    EXPECT_EQ(rank_of(scale, 10000.0), 4);
  }
}

TEST(Ranks, KeepTheirOrderWhereAlmostAllIsEqual) {
  std::vector<double> values(2000, 5.0);
  values.push_back(6.0);
  const RankScale scale = equal_count_ranks(values, ones(2001));
  EXPECT_TRUE(std::is_sorted(scale.bounds.begin(), scale.bounds.end()));
  EXPECT_EQ(scale.bounds.back(), 6.0);
  EXPECT_FALSE(scale.open);
}

TEST(WeightedQuantile, IsTheSmallestValueWithEnoughWeightBelow) {
  const std::vector<double> values = {4.0, 1.0, 3.0, 2.0};
  EXPECT_EQ(weighted_quantile(values, ones(4), 0.0), 1.0);
  EXPECT_EQ(weighted_quantile(values, ones(4), 0.5), 2.0);
  EXPECT_EQ(weighted_quantile(values, ones(4), 0.51), 3.0);
  EXPECT_EQ(weighted_quantile(values, ones(4), 1.0), 4.0);
  EXPECT_EQ(weighted_quantile(values, std::vector<double>{1.0, 0.0, 0.0, 0.0}, 0.1), 4.0);
  EXPECT_EQ(weighted_quantile({}, {}, 0.5), 0.0);
}

TEST(MapScale, EndsBelowTheBrightestSlivers) {
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 1.0);
  const MapScale scale = make_map_scale(values, ones(1000));
  EXPECT_EQ(scale.top, 995.0);
  EXPECT_TRUE(scale.open);
  EXPECT_EQ(map_colour(scale, 0.0), viridis(0.0));
  EXPECT_EQ(map_colour(scale, 1000.0), viridis(1.0));
  const MapScale equal = make_map_scale(ones(3), ones(3));
  EXPECT_EQ(equal.top, 1.0);
  EXPECT_FALSE(equal.open);
  const MapScale dark = make_map_scale(std::vector<double>(3, 0.0), ones(3));
  EXPECT_EQ(dark.top, 0.0);
  EXPECT_EQ(map_colour(dark, 0.0), viridis(0.0));
}

// Compares with the published table of 256 colours, at its ends and where five even steps would fall.
TEST(Viridis, IsThePublishedMap) {
  const std::vector<std::pair<double, std::array<int, 3>>> places = {
      {0.0, {68, 1, 84}}, {0.25, {59, 82, 139}}, {0.5, {33, 145, 140}}, {0.75, {93, 200, 99}}, {1.0, {253, 231, 37}}};
  for (const auto& [at, expected] : places) {
    const auto got = to_srgb(viridis(at));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], expected[i], 2) << at;
  }
  EXPECT_EQ(viridis(-1.0), viridis(0.0));
  EXPECT_EQ(viridis(2.0), viridis(1.0));
}

TEST(Viridis, GrowsLighterEvenly) {
  for (int k = 1; k <= 50; ++k) {
    const double step = lab(viridis(k / 50.0))[0] - lab(viridis((k - 1) / 50.0))[0];
    EXPECT_GT(step, 0.8) << k;
    EXPECT_LT(step, 2.4) << k;
  }
}

TEST(EqualIntervalRanks, WithoutLightIsAllDarkestShade) {
  for (const auto& values : {std::vector<double>{}, std::vector<double>{0.0, 0.0}}) {
    const RankScale scale = equal_interval_ranks(values, ones(values.size()));
    EXPECT_EQ(scale.bounds, (std::array<double, 6>{}));
    EXPECT_EQ(rank_of(scale, 0.0), 0);
  }
}

// A boundary falls within the item in which the requested share is reached, on its nearer side: half an item at each end.
TEST(EqualCountRanks, GivesEachClassItsShareToWithinOneItem) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> weight(0.1, 1.0);
  std::lognormal_distribution<double> value(4.0, 1.0);
  for (const std::size_t count : {5U, 17U, 1000U}) {
    std::vector<double> values(count), weights(count);
    for (double& v : values) v = value(random);
    for (double& w : weights) w = weight(random);
    const RankScale scale = equal_count_ranks(values, weights);
    EXPECT_TRUE(std::is_sorted(scale.bounds.begin(), scale.bounds.end()));
    EXPECT_EQ(scale.bounds.front(), *std::min_element(values.begin(), values.end()));
    EXPECT_EQ(scale.bounds.back(), weighted_quantile(values, weights, rank_top_share));
    const double share = std::accumulate(weights.begin(), weights.end(), 0.0) / 5.0;
    const double largest = *std::max_element(weights.begin(), weights.end());
    for (const double sum : weight_by_rank(scale, values, weights)) EXPECT_NEAR(sum, share, largest);
  }
}

TEST(EqualCountRanks, SplitsEvenNumbersExactly) {
  std::vector<double> values(100);
  std::iota(values.begin(), values.end(), 1.0);
  const RankScale scale = equal_count_ranks(values, ones(100));
  EXPECT_EQ(scale.bounds, (std::array<double, 6>{1.0, 21.0, 41.0, 61.0, 81.0, 100.0}));
  EXPECT_EQ(weight_by_rank(scale, values, ones(100)), (std::array<double, 5>{20.0, 20.0, 20.0, 20.0, 20.0}));
}

TEST(EqualCountRanks, DoesNotDependOnTheOrderOrTheUnitOfWeight) {
  const std::vector<double> values = {5.0, 1.0, 4.0, 2.0, 3.0, 6.0, 9.0, 8.0, 7.0, 10.0};
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const RankScale scale = equal_count_ranks(sorted, ones(10));
  EXPECT_EQ(equal_count_ranks(values, ones(10)).bounds, scale.bounds);
  EXPECT_EQ(equal_count_ranks(values, std::vector<double>(10, 0.0078125)).bounds, scale.bounds);
}

TEST(EqualCountRanks, PutsZerosIntoTheDarkestClassAndSharesOutTheRest) {
  std::vector<double> values(900, 0.0);
  for (int i = 1; i <= 100; ++i) values.push_back(i);
  const RankScale scale = equal_count_ranks(values, ones(values.size()));
  EXPECT_EQ(scale.bounds.front(), 0.0);
  EXPECT_EQ(rank_of(scale, 0.0), 0);
  EXPECT_EQ(weight_by_rank(scale, values, ones(values.size())), (std::array<double, 5>{920.0, 20.0, 20.0, 20.0, 20.0}));
}

TEST(EqualCountRanks, TakesNegativeValuesAsZero) {
  const std::vector<double> values = {-3.0, 1.0, 2.0, 3.0, 4.0, 5.0};
  const RankScale scale = equal_count_ranks(values, ones(values.size()));
  EXPECT_EQ(scale.bounds, (std::array<double, 6>{0.0, 2.0, 3.0, 4.0, 5.0, 5.0}));
}

TEST(EqualCountRanks, KeepsEqualValuesTogetherAndTellsDifferentOnesApart) {
  std::vector<double> values(9, 10.0);
  values.push_back(20.0);
  const RankScale scale = equal_count_ranks(values, ones(values.size()));
  EXPECT_EQ(rank_of(scale, 10.0), 2);  // the middle of nine tenths
  EXPECT_EQ(rank_of(scale, 20.0), 4);
}

TEST(EqualCountRanks, ShowsOneValueAboveZeroAsFullSun) {
  const std::vector<double> values = {0.0, 350.0, 350.0};
  const RankScale scale = equal_count_ranks(values, ones(values.size()));
  EXPECT_EQ(rank_of(scale, 0.0), 0);
  EXPECT_EQ(rank_of(scale, 350.0), 4);
}

TEST(EqualCountRanks, LeavesOutWhatHasNoWeight) {
  const std::vector<double> values = {1.0, 2.0, 3.0, 4.0, 5.0, 1e6};
  const std::vector<double> weights = {1.0, 1.0, 1.0, 1.0, 1.0, 0.0};
  EXPECT_EQ(equal_count_ranks(values, weights).bounds, (std::array<double, 6>{1.0, 2.0, 3.0, 4.0, 5.0, 5.0}));
}

TEST(EqualCountRanks, FallsBackToEqualIntervals) {
  const std::vector<double> values = {1.0, 2.0, 10.0};
  EXPECT_EQ(equal_count_ranks(values, std::vector<double>(3, 0.0)).bounds,
            (std::array<double, 6>{0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  const std::vector<double> same = {4.0, 4.0, 4.0};
  EXPECT_EQ(equal_count_ranks(same, ones(3)).bounds, equal_interval_ranks(same, ones(3)).bounds);
  EXPECT_EQ(equal_count_ranks({}, {}).bounds, (std::array<double, 6>{}));
  const std::vector<double> dark(4, 0.0);
  const RankScale scale = equal_count_ranks(dark, ones(4));
  EXPECT_EQ(scale.bounds, (std::array<double, 6>{}));
  EXPECT_EQ(rank_of(scale, 0.0), 0);
}

TEST(EqualCountRanks, RefusesWhatHasNoRank) {
  const std::vector<double> broken = {1.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(static_cast<void>(equal_count_ranks(broken, ones(2))), std::logic_error);
  EXPECT_THROW(static_cast<void>(equal_count_ranks(ones(2), ones(3))), std::logic_error);
  EXPECT_THROW(static_cast<void>(equal_count_ranks(ones(2), std::vector<double>{1.0, -1.0})), std::logic_error);
}

double difference(const Colour& a, const Colour& b) {
  const Colour p = lab(a);
  const Colour q = lab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(RankColour, GrowsLighterFromShadeToSun) {
  for (int rank = 1; rank < 5; ++rank) EXPECT_GE(lab(rank_colour(rank))[0] - lab(rank_colour(rank - 1))[0], 12.9);
}

// Rows of the matrices for severity 1: Machado, Oliveira and Fernandes 2009, doi 10.1109/TVCG.2009.113, table 1.
TEST(RankColour, IsToldApartWithoutColourVision) {
  using Matrix = std::array<Colour, 3>;
  const std::array<Matrix, 4> visions = {
      {{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
       {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
       {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
       {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};
  for (const Matrix& vision : visions) {
    const auto seen = [&](int rank) {
      const Colour colour = rank_colour(rank);
      Colour result{};
      for (std::size_t i = 0; i < 3; ++i) {
        result[i] = std::clamp(std::inner_product(colour.begin(), colour.end(), vision[i].begin(), 0.0), 0.0, 1.0);
      }
      return result;
    };
    for (int a = 0; a < 5; ++a) {
      for (int b = unlit_rank; b < a; ++b) EXPECT_GE(difference(seen(a), seen(b)), 23.0) << a << " and " << b;
    }
  }
}

TEST(Srgb, RoundTripsEveryValue) {
  for (int i = 0; i < 256; ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    const std::array<std::uint8_t, 3> srgb = {value, static_cast<std::uint8_t>(255 - i), 7};
    EXPECT_EQ(to_srgb(from_srgb(srgb)), srgb);
  }
}

TEST(Srgb, FollowsTheStandard) {
  // 1.055 x 0.5^(1/2.4) - 0.055 = 0.735357 and 12.92 x 0.002 = 0.02584, which are 187.5 and 6.6 of 255.
  EXPECT_EQ(to_srgb({0.5, 0.002, 1.0}), (std::array<std::uint8_t, 3>{188, 7, 255}));
  EXPECT_EQ(to_srgb({-1.0, 2.0, 0.0}), (std::array<std::uint8_t, 3>{0, 255, 0}));
}

TEST(Unlit, IsAClassOfItsOwn) {
  const std::vector<double> values{0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0};
  const RankScale scale = equal_count_ranks(values, ones(7), 1.0);
  EXPECT_EQ(scale.bounds, (std::array<double, 6>{1.0, 2.0, 3.0, 4.0, 5.0, 5.0}));
  EXPECT_EQ(rank_of(scale, 0.99), unlit_rank);
  EXPECT_EQ(rank_of(scale, 1.0), 0);
  const std::array<double, 6> shares = rank_shares(scale, values, ones(7));
  for (int rank = 0; rank < 5; ++rank) EXPECT_NEAR(shares[rank], 1.0 / 7.0, 1e-12);
  EXPECT_NEAR(shares[5], 2.0 / 7.0, 1e-12);
  const RankScale dark = equal_count_ranks(values, ones(7), 10.0);
  EXPECT_EQ(rank_of(dark, 5.0), unlit_rank);
  EXPECT_EQ(rank_shares(dark, values, ones(7))[5], 1.0);
}

TEST(LogarithmicRanks, HaveBoundsInEqualRatios) {
  const RankScale scale = logarithmic_ranks_to(100.0, std::vector<double>{1.0, 120.0});
  for (int k = 2; k <= 5; ++k) EXPECT_NEAR(scale.bounds[k] / scale.bounds[k - 1], std::pow(10.0, 0.4), 1e-12);
  EXPECT_EQ(scale.bounds.front(), 0.0);
  EXPECT_EQ(scale.bounds.back(), 100.0);
  EXPECT_TRUE(scale.open);
  EXPECT_EQ(rank_of(scale, 2.0), 0);
  EXPECT_EQ(rank_of(scale, 3.0), 1);
  EXPECT_EQ(logarithmic_ranks(std::vector<double>{1.0, 50.0}, ones(2)).bounds.back(), 50.0);
}

TEST(GivenTop, EndsBothScalesThere) {
  const std::vector<double> values{0.0, 30.0, 80.0, 120.0};
  const RankScale ranks = rank_scale_to(100.0, values);
  EXPECT_EQ(ranks.bounds, (std::array<double, 6>{0.0, 20.0, 40.0, 60.0, 80.0, 100.0}));
  EXPECT_TRUE(ranks.open) << "120 lies above";
  EXPECT_EQ(rank_of(ranks, 30.0), 1);
  EXPECT_EQ(rank_of(ranks, 120.0), 4);
  EXPECT_FALSE(rank_scale_to(120.0, values).open);
  EXPECT_EQ(map_scale_to(100.0, values).top, 100.0);
  EXPECT_TRUE(map_scale_to(100.0, values).open);
  EXPECT_FALSE(map_scale_to(200.0, values).open);
}

}  // namespace
}  // namespace sunfleck
