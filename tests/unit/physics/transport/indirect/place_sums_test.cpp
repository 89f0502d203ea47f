#include "physics/transport/indirect/place_sums.h"

#include "base/each_number.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace sunfleck {
namespace {

constexpr std::size_t width = 2;

// Adds `landings` pairs of random numbers at random places below `reach`, here and to plain sums.
void land(PlaceSums& sums, std::vector<std::int64_t>& plain, std::size_t landings, std::size_t reach, unsigned seed) {
  std::mt19937_64 random(seed);
  for (std::size_t k = 0; k < landings; ++k) {
    const std::size_t place = random() % reach;
    const std::array<std::int64_t, width> values{static_cast<std::int64_t>(random() >> 20U), -static_cast<std::int64_t>(k)};
    sums.add(place, values);
    for (std::size_t j = 0; j < width; ++j) plain[place * width + j] += values[j];
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

TEST(PlaceSums, WithoutPlacesTakeTheSizeOfOthers) {
  PlaceSums sums;
  sums.add(PlaceSums());
  EXPECT_EQ(sums.size(), 0U);
  sums.add(PlaceSums(7, width));
  EXPECT_EQ(sums.all(), std::vector<std::int64_t>(7 * width));
}

}  // namespace
}  // namespace sunfleck
