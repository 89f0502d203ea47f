#include "physics/transport/indirect/place_sums.h"

#include "base/each_number.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::size_t width = 2;
constexpr std::size_t wide = 11;

// Adds `landings` rows of random numbers at random places below `reach`, here and to plain sums.
template <std::size_t columns = width>
void land(PlaceSums& sums, std::vector<std::int64_t>& plain, std::size_t landings, std::size_t reach, unsigned seed) {
  std::mt19937_64 random(seed);
  for (std::size_t k = 0; k < landings; ++k) {
    const std::size_t place = random() % reach;
    std::array<std::int64_t, columns> values{static_cast<std::int64_t>(random() >> 20U), -static_cast<std::int64_t>(k)};
    values.back() -= static_cast<std::int64_t>(k);
    sums.add(place, values);
    for (std::size_t j = 0; j < columns; ++j) plain[place * columns + j] += values[j];
  }
}

std::vector<std::int64_t> visited(const PlaceSums& sums) {
  std::vector<std::int64_t> values;
  EachNumber([&](auto value) { values.push_back(value); })(sums);
  return values;
}

class PlaceSumsTest : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PlaceSumsTest, AreTheSameInBothForms) {
  constexpr std::size_t places = 5000;
  std::vector<std::int64_t> plain(places * width), other_plain(places * width);
  PlaceSums sums(places, width), other(places, width);
  land(sums, plain, GetParam(), places, 1);
  EXPECT_EQ(sums.all(), plain);
  EXPECT_EQ(visited(sums), plain);
  for (const std::size_t landings : {std::size_t{3}, 2 * places}) {  // a list, all sums
    land(other, other_plain, landings, places, 2);
    PlaceSums together = sums;
    together.add(other);
    std::vector<std::int64_t> expected = plain;
    for (std::size_t k = 0; k < expected.size(); ++k) expected[k] += other_plain[k];
    EXPECT_EQ(together.all(), expected) << landings;
    EXPECT_EQ(together.take_all(), expected);
    EXPECT_EQ(together.size(), 0U);
  }
}

TEST_P(PlaceSumsTest, TakeAllSumsOfADevice) {
  constexpr std::size_t places = 5000;
  std::vector<std::int64_t> plain(places * width), other_plain(places * width);
  PlaceSums sums(places, width), other(places, width);
  land(sums, plain, GetParam(), places, 1);
  land(other, other_plain, 700, places, 2);
  sums.add_all(other_plain);
  for (std::size_t k = 0; k < plain.size(); ++k) plain[k] += other_plain[k];
  EXPECT_EQ(sums.all(), plain);
}

TEST_P(PlaceSumsTest, AreVisitedInPartsInTheOrderOfTheirPlaces) {
  constexpr std::size_t places = 5000;
  std::vector<std::int64_t> plain(places * width);
  PlaceSums sums(places, width);
  land(sums, plain, GetParam(), places, 3);
  sums.put_in_order();
  using Visits = std::vector<std::pair<std::size_t, std::vector<std::int64_t>>>;
  const auto visit = [&](std::size_t first, std::size_t end, Visits& visits) {
    const auto take = [&](std::size_t place, std::span<const std::int64_t> values) {
      visits.push_back({place, {values.begin(), values.end()}});
    };
    sums.for_each(first, end, take, [](std::size_t) {});
  };
  Visits whole, parts;
  visit(0, places, whole);
  constexpr std::size_t cuts = 7;
  for (std::size_t k = 0; k < cuts; ++k) visit(k * places / cuts, (k + 1) * places / cuts, parts);
  EXPECT_EQ(parts, whole);
  const auto is_after = [](const auto& a, const auto& b) { return a.first >= b.first; };
  EXPECT_EQ(std::adjacent_find(whole.begin(), whole.end(), is_after), whole.end());
  std::vector<std::int64_t> added(places * width);
  for (const auto& [place, values] : whole) {
    for (std::size_t j = 0; j < width; ++j) added[place * width + j] += values[j];
  }
  EXPECT_EQ(added, plain);
}

TEST_P(PlaceSumsTest, AreFoundPlaceByPlace) {
  constexpr std::size_t places = 5000;
  std::vector<std::int64_t> plain(places * width);
  PlaceSums sums(places, width);
  land(sums, plain, GetParam(), places, 4);
  const PlaceSums::Finder finder(sums);
  for (std::size_t place = 0; place < places; ++place) {
    const auto found = finder.at(place);
    for (std::size_t j = 0; j < width; ++j) {
      const std::int64_t expected = plain[place * width + j];
      ASSERT_EQ(found.empty() ? 0 : found[j], expected) << place;
    }
  }
  const PlaceSums none;
  EXPECT_TRUE(PlaceSums::Finder(none).at(3).empty());
}

TEST_P(PlaceSumsTest, AreReadAsTheyWereWritten) {
  constexpr std::size_t places = 5000;
  std::vector<std::int64_t> plain(places * width);
  PlaceSums sums(places, width);
  land(sums, plain, GetParam(), places, 3);
  PlaceSums read(places, width);
  auto next = plain.begin();
  EachNumber([&](std::int64_t& value) { value = *next++; })(read);
  EXPECT_EQ(read.all(), plain);
}

INSTANTIATE_TEST_SUITE_P(Landings, PlaceSumsTest, ::testing::Values(0, 1, 900, 1100, 20000));

TEST(PlaceSums, TakeLittleMemoryWhereLittleLands) {
  constexpr std::size_t places = 100000;
  constexpr std::size_t all_bytes = places * width * sizeof(std::int64_t);
  std::vector<std::int64_t> plain(places * width);
  PlaceSums few(places, width), repeated(places, width), many(places, width);
  land(few, plain, 1000, places, 4);
  EXPECT_LT(few.bytes(), 64000U);
  land(repeated, plain, 200000, 100, 5);  // often on the same places
  EXPECT_LE(repeated.bytes(), all_bytes / 2);
  land(many, plain, 200000, places, 6);
  EXPECT_EQ(many.bytes(), all_bytes);
}

TEST_P(PlaceSumsTest, OfManyColumnsAreTheSame) {
  constexpr std::size_t places = 5000;
  std::vector<std::int64_t> plain(places * wide), other_plain(places * wide);
  PlaceSums sums(places, wide), other(places, wide);
  land<wide>(sums, plain, GetParam(), places, 1);
  EXPECT_EQ(sums.all(), plain);
  EXPECT_EQ(visited(sums), plain);
  const PlaceSums::Finder finder(sums);
  std::vector<std::int64_t> found, in_turn(places * wide);
  for (std::size_t place = 0; place < places; ++place) {
    const auto at = finder.at(place);
    for (std::size_t j = 0; j < wide; ++j) found.push_back(at.empty() ? 0 : at[j]);
  }
  EXPECT_EQ(found, plain);
  std::size_t next = 0;
  sums.for_each([&](std::size_t place, std::span<const std::int64_t> values) {
    EXPECT_GE(place, next);  // each place once, in ascending order
    next = place + 1;
    std::copy(values.begin(), values.end(), in_turn.begin() + static_cast<std::ptrdiff_t>(place * wide));
  });
  EXPECT_EQ(in_turn, plain);
  land<wide>(other, other_plain, 700, places, 2);
  sums.add(other);
  for (std::size_t k = 0; k < plain.size(); ++k) plain[k] += other_plain[k];
  EXPECT_EQ(sums.take_all(), plain);
  EXPECT_EQ(sums.size(), 0U);
}

TEST(PlaceSums, OfManyColumnsTakeRowsOfThePlacesReached) {
  constexpr std::size_t places = 100000;
  constexpr std::size_t index_bytes = places * sizeof(std::uint32_t);
  constexpr std::size_t all_bytes = places * wide * sizeof(std::int64_t);
  std::vector<std::int64_t> plain(places * wide);
  PlaceSums none(places, wide), few(places, wide), many(places, wide);
  EXPECT_EQ(none.bytes(), 0U);
  land<wide>(few, plain, 200000, 100, 5);
  EXPECT_LT(few.bytes(), index_bytes + 30000U);
  land<wide>(many, plain, 2000000, places, 6);
  EXPECT_LE(many.bytes(), all_bytes + 3 * index_bytes);
}

TEST(PlaceSums, OfManyColumnsGetTheRowsOfOthers) {
  constexpr std::size_t places = 1000;
  std::vector<std::int64_t> plain(places * wide), other_plain(places * wide);
  PlaceSums sums(places, wide), other(places, wide);
  EXPECT_FALSE(sums.has_rows());
  land<wide>(sums, plain, 50, places, 1);
  land<wide>(other, other_plain, 50, places, 2);
  EXPECT_TRUE(sums.has_rows() && other.has_rows());
  sums.append_rows_of(other);
  EXPECT_EQ(sums.all(), plain);
  const std::size_t bytes = sums.bytes();
  EXPECT_GT(bytes, other.bytes());
  sums.add(other);
  EXPECT_EQ(sums.bytes(), bytes) << "each place had a row";
}

TEST(PlaceSums, WithoutPlacesTakeTheSizeOfOthers) {
  PlaceSums sums;
  sums.add(PlaceSums());
  EXPECT_EQ(sums.size(), 0U);
  sums.add(PlaceSums(7, width));
  EXPECT_EQ(sums.all(), std::vector<std::int64_t>(7 * width));
}

}  // namespace
}  // namespace sunfleck
