// Tests that columns are computed in vectors as one by one, on every kind of processor.

#include "physics/transport/model/columns.h"

#include "base/random.h"
#include "support/processor_kinds.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace sunfleck::test {
namespace {

// Rows of 0 to 37 columns end anywhere in a vector.
constexpr std::size_t widest = 37;

// Returns quanta of all sizes up to 2^47, many of them 0.
std::vector<std::int64_t> some_quanta(std::size_t count, RandomStream& random) {
  std::vector<std::int64_t> quanta(count);
  for (std::int64_t& q : quanta) {
    const auto bits = static_cast<unsigned>(48.0 * random.unit());
    q = random.unit() < 0.3 ? 0 : static_cast<std::int64_t>(random.word() >> (63U - bits));
  }
  return quanta;
}

std::vector<double> some_numbers(std::size_t count, RandomStream& random) {
  std::vector<double> numbers(count);
  for (double& number : numbers) number = random.unit();
  return numbers;
}

// Calls test(count, random numbers) for rows of each width, on each kind of processor.
template <class Test>
void for_each_width(const Test& test) {
  for_each_processor_kind([&] {
    RandomStream random(5, 1);
    for (std::size_t count = 0; count <= widest; ++count) test(count, random);
  });
}

std::vector<FaceOptics> some_faces(std::size_t bands, RandomStream& random) {
  std::vector<FaceOptics> faces;
  for (std::size_t b = 0; b < bands; ++b) {
    FaceOptics face;
    face.reflectance = b % 4 == 0 ? 0.0 : b % 7 == 1 ? 1.0 : random.unit();
    face.transmittance = b % 3 == 0 ? 0.0 : (1.0 - face.reflectance) * (b % 5 == 1 ? 1.0 : random.unit());
    faces.push_back(face);
  }
  return faces;
}

TEST(Columns, AreSplitAsSingleQuantaAre) {
  for_each_width([](std::size_t count, RandomStream& random) {
    const std::vector<FaceOptics> faces = some_faces(count, random);
    const FaceColumns face(faces, 1);
    const std::vector<std::int64_t> landed = some_quanta(count, random);
    const auto u = static_cast<std::uint32_t>(random.word());
    std::vector<std::int64_t> absorbed(count, 7), scattered(count, 9);
    columns::split(landed, face.scattered.data(), u, absorbed.data(), scattered.data());
    for (std::size_t c = 0; c < count; ++c) {
      const QuantaSplit parts = split_quanta(landed[c], split_coefficients(faces[c].reflectance, faces[c].transmittance), u);
      ASSERT_EQ(absorbed[c], 7 + parts.absorbed);
      ASSERT_EQ(scattered[c], parts.scattered());
    }
  });
}

TEST(Columns, OfEachLightHaveTheFaceOfTheirBand) {
  const FaceColumns face({{.reflectance = 0.125, .transmittance = 0.25}, {.reflectance = 1.0, .transmittance = 0.0}}, 2);
  constexpr std::uint64_t all = std::uint64_t{1} << 32U;
  EXPECT_EQ(face.reflected, (std::vector<std::uint64_t>{all / 8, all / 8, all, all}));
  EXPECT_EQ(face.scattered, (std::vector<std::uint64_t>{3 * all / 8, 3 * all / 8, all, all}));
  EXPECT_TRUE(face.transmits);
  EXPECT_FALSE(FaceColumns({{.reflectance = 1.0, .transmittance = 0.0}}, 2).transmits);
}

// Rows begin at a column of their own among all columns.
TEST(Columns, AreWeighedAndCarriedAsOneByOne) {
  constexpr std::size_t first = 3;
  for_each_width([](std::size_t count, RandomStream& random) {
    const FaceColumns face(some_faces(first + count, random), 1);
    const std::vector<std::int64_t> landed = some_quanta(count, random);
    const auto u = static_cast<std::uint32_t>(random.word());
    FactorColumns scales(first + count);
    FactorColumns loads(first + count);
    for (std::size_t c = 0; c < first + count; ++c) {
      const std::uint64_t total = (random.word() >> 20U) + 1;
      scales.set(c, shared::scale_of(random.word() >> 24U, total + (std::uint64_t{1} << 47U)));
      loads.set(c, shared::load_of(total, random.word() >> 20U));
    }
    for (const std::uint64_t* scattered : {face.scattered.data(), static_cast<const std::uint64_t*>(nullptr)}) {
      const ScatteredParts parts{face.reflected.data(), scattered, u};
      const OfBothParts sum = columns::sum_scaled(landed, parts, scales, first);
      const OfBothParts sum_singly = columns::singly::sum_scaled(0, landed, parts, scales, first);
      ASSERT_EQ(sum.reflected, sum_singly.reflected);
      ASSERT_EQ(sum.transmitted, sum_singly.transmitted);
      const OfBothParts largest = columns::largest_scaled(landed, parts, scales, first);
      const OfBothParts largest_singly = columns::singly::largest_scaled(0, landed, parts, scales, first);
      ASSERT_EQ(largest.reflected, largest_singly.reflected);
      ASSERT_EQ(largest.transmitted, largest_singly.transmitted);
    }
    const OfBothParts all = columns::sum_scaled(landed, {face.reflected.data(), face.scattered.data(), u}, scales, first);
    for (const auto& [spare_bits, reflects] : {std::pair{0U, true}, {0U, false}, {10U, true}, {10U, false}}) {
      const SentPart sent =
          reflects ? SentPart{nullptr, face.reflected.data(), u} : SentPart{face.reflected.data(), face.scattered.data(), u};
      const shared::Sharing sharing = shared::sharing_of((reflects ? all.reflected : all.transmitted) + 1, spare_bits);
      std::vector<std::uint32_t> weights(count), weights_singly(count);
      std::vector<std::uint64_t> sums(first + count, 5), sums_singly(first + count, 5);
      columns::weigh(landed, sent, scales, first, sharing, weights.data(), sums.data());
      columns::singly::weigh(0, landed, sent, scales, first, sharing, weights_singly.data(), sums_singly.data());
      ASSERT_EQ(weights, weights_singly);
      ASSERT_EQ(sums, sums_singly);
      for (std::uint32_t& weight : weights) weight = static_cast<std::uint32_t>(random.word() >> 33U);
      std::vector<std::int64_t> quanta(count), quanta_singly(count);
      columns::carry(weights, loads, first, quanta.data());
      columns::singly::carry(0, weights, loads, first, quanta_singly.data());
      ASSERT_EQ(quanta, quanta_singly);
    }
  });
}

TEST(Columns, AreAddedAndSubtracted) {
  for_each_width([](std::size_t count, RandomStream& random) {
    const std::vector<std::int64_t> quanta = some_quanta(count, random);
    std::vector<std::int64_t> sums(count + 1, 3);
    columns::add(quanta, sums.data());
    for (std::size_t c = 0; c < count; ++c) ASSERT_EQ(sums[c], 3 + quanta[c]);
    columns::subtract(quanta, sums.data());
    columns::subtract(quanta, sums.data());
    for (std::size_t c = 0; c < count; ++c) ASSERT_EQ(sums[c], 3 - quanta[c]);
    EXPECT_EQ(sums[count], 3);
  });
}

TEST(Columns, OfRealNumbersAreScaledAndAdded) {
  for_each_width([](std::size_t count, RandomStream& random) {
    const std::vector<std::int64_t> quanta = some_quanta(count, random);
    const std::vector<double> a = some_numbers(count, random);
    const std::vector<double> b = some_numbers(count, random);
    const std::vector<double> other = some_numbers(count, random);
    std::vector<double> products(count), scaled(count, 0.1);
    std::vector<double> shares(count, 0.1), by_b(count, 0.2), by_other(count, 0.3);
    columns::scale(quanta, a, 0.7, b, products);
    columns::add_scaled(0.3, a, scaled);
    columns::add_share(0.9, a, std::array{b.data(), other.data()}, std::array{shares.data(), by_b.data(), by_other.data()});
    for (std::size_t c = 0; c < count; ++c) {
      ASSERT_EQ(products[c], static_cast<double>(quanta[c]) * a[c] * 0.7 * b[c]);
      ASSERT_EQ(shares[c], 0.1 + 0.9 * a[c]);
      ASSERT_EQ(by_b[c], 0.2 + b[c] * (0.9 * a[c]));
      ASSERT_EQ(by_other[c], 0.3 + other[c] * (0.9 * a[c]));
      ASSERT_EQ(scaled[c], 0.1 + 0.3 * a[c]);
    }
  });
}

}  // namespace
}  // namespace sunfleck::test
