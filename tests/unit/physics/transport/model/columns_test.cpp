// Tests that columns are computed in vectors as one by one, on every kind of processor.

#include "physics/transport/model/columns.h"

#include "base/random.h"
#include "support/processor_kinds.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
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
    const std::vector<std::int64_t> landed = some_quanta(count, random);
    const std::vector<double> u = some_numbers(count, random);
    std::vector<std::int64_t> absorbed(count, 7), reflected(count, -1), transmitted(count, -1);
    columns::split(FaceColumns(faces, 1), {landed, u, absorbed, reflected, transmitted});
    for (std::size_t c = 0; c < count; ++c) {
      const QuantaSplit parts = split_quanta(landed[c], split_coefficients(faces[c].reflectance, faces[c].transmittance), u[c]);
      ASSERT_EQ(absorbed[c], 7 + parts.absorbed);
      ASSERT_EQ(reflected[c], parts.reflected);
      ASSERT_EQ(transmitted[c], parts.transmitted);
      ASSERT_EQ(absorbed[c] - 7 + reflected[c] + transmitted[c], landed[c]);
    }
  });
}

TEST(Columns, OfEachLightHaveTheFaceOfTheirBand) {
  const FaceColumns face({{.reflectance = 0.1, .transmittance = 0.2}, {.reflectance = 1.0, .transmittance = 0.0}}, 3);
  EXPECT_EQ(face.reflected, (std::vector<double>{0.1, 0.1, 0.1, 2.0, 2.0, 2.0}));
  EXPECT_EQ(face.scattered, (std::vector<double>{0.1 + 0.2, 0.1 + 0.2, 0.1 + 0.2, 2.0, 2.0, 2.0}));
}

TEST(Columns, AreSharedOutAsOneByOne) {
  constexpr std::int64_t packets = 30;
  for_each_width([](std::size_t count, RandomStream& random) {
    std::vector<std::int64_t> totals(count);
    std::vector<std::vector<std::int64_t>> rows;
    for (std::int64_t p = 0; p < packets; ++p) {
      rows.push_back(some_quanta(count, random));
      if (count > 8) rows.back()[8] = 0;  // a column that no packet carries
      for (std::size_t c = 0; c < count; ++c) totals[c] += rows.back()[c];
    }
    SharedOut together(totals), singly(totals);
    for (std::int64_t p = 0; p < packets; ++p) {
      const auto& row = rows[static_cast<std::size_t>(p)];
      const double expected = 0.5 + 0.1 * static_cast<double>(p);
      columns::weigh(row, expected, p, together);
      columns::singly::weigh(0, row, expected, p, singly);
    }
    std::vector<std::int64_t> own(count), own_singly(count), carried(count);
    for (std::int64_t p = 0; p < packets; ++p) {
      const auto& row = rows[static_cast<std::size_t>(p)];
      const double expected = 0.5 + 0.1 * static_cast<double>(p);
      columns::share(row, expected, p, together, own);
      columns::singly::share(0, row, expected, p, singly, own_singly);
      ASSERT_EQ(own, own_singly);
      for (std::size_t c = 0; c < count; ++c) carried[c] += own[c];
    }
    EXPECT_EQ(carried, totals);
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

TEST(Columns, SumRatiosInTheirOrder) {
  for (const std::size_t rows : {0, 1, 8, 19}) {
    for_each_width([&](std::size_t count, RandomStream& random) {
      const std::vector<std::int64_t> quanta = some_quanta(rows * count, random);
      std::vector<double> by = some_numbers(count, random);
      if (count > 2) by[2] = std::numeric_limits<double>::infinity();
      std::vector<double> sums(rows, -1.0);
      std::vector<std::span<const std::int64_t>> parts;
      for (std::size_t row = 0; row < rows; ++row) parts.push_back(std::span(quanta).subspan(row * count, count));
      columns::sum_ratios(parts, by, sums);
      for (std::size_t row = 0; row < rows; ++row) {
        double sum = 0.0;
        for (std::size_t c = 0; c < count; ++c) sum += static_cast<double>(quanta[row * count + c]) / by[c];
        ASSERT_EQ(sums[row], sum);
      }
    });
  }
}

TEST(Columns, OfRealNumbersAreScaledAndAdded) {
  for_each_width([](std::size_t count, RandomStream& random) {
    const std::vector<std::int64_t> quanta = some_quanta(count, random);
    const std::vector<double> a = some_numbers(count, random);
    const std::vector<double> b = some_numbers(count, random);
    std::vector<double> products(count), sums(count, 0.1), scaled(count, 0.1);
    columns::scale(quanta, a, 0.7, b, products);
    columns::add_products(a, b, sums);
    columns::add_scaled(0.3, a, scaled);
    for (std::size_t c = 0; c < count; ++c) {
      ASSERT_EQ(products[c], static_cast<double>(quanta[c]) * a[c] * 0.7 * b[c]);
      ASSERT_EQ(sums[c], 0.1 + a[c] * b[c]);
      ASSERT_EQ(scaled[c], 0.1 + 0.3 * a[c]);
    }
  });
}

}  // namespace
}  // namespace sunfleck::test
