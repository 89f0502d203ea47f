// Tests how waiting flux becomes packets, and how a packet's quanta are split where it lands.
#include "physics/bvh/references.h"
#include "physics/transport/indirect/candidates.h"
#include "support/chi_square.h"
#include "support/scattering.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace sunfleck::test {
namespace {

Candidates sorted(const Candidates& candidates) {
  Candidates taken = candidates;
  Candidates result(candidates.totals().size());
  SortSpace space;
  result.take_sorted(taken, space);
  return result;
}

struct SharedDraw : Draw {
  std::vector<std::int64_t> quanta;  // [packet * columns + column]
};

SharedDraw drawn(const Candidates& candidates, std::span<const double> expected, RandomStream& random) {
  SharedDraw draw;
  draw_packets(candidates, expected, random, draw);
  const std::size_t columns = candidates.totals().size();
  draw.quanta.resize(draw.candidate.size() * columns);
  for (std::size_t p = 0; p < draw.candidate.size(); ++p) {
    share_out(candidates, expected, p, draw, std::span(draw.quanta).subspan(p * columns, columns));
  }
  return draw;
}

// Starts the packets in two parts, as long rounds are.
std::vector<shared::Packet> started(const Canopy& canopy, const Candidates& candidates, const Draw& draw,
                                    const EmissionFrame& frame, RandomStream& random) {
  const PacketStarts starts(canopy, candidates, draw, frame, random);
  std::vector<shared::Packet> packets(draw.candidate.size());
  const std::size_t part = packets.size() / 3;
  starts.write(0, std::span(packets).first(part));
  starts.write(part, std::span(packets).subspan(part));
  return packets;
}

// Returns places with quanta of very different sizes in three bands, the last nearly empty, at levels from -1 (soil) upwards.
Candidates scattered_candidates(std::size_t count, std::uint32_t levels, std::uint32_t seed) {
  Random random(seed);
  Candidates candidates(3);
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto size = [&](double decades) { return static_cast<std::int64_t>(std::pow(10.0, random.uniform(0.0, decades))); };
    const std::array<std::int64_t, 3> quanta = {size(9.0), k % 3 == 0 ? 0 : size(3.0), k % 50 == 7 ? size(5.0) : 0};
    candidates.add({2 * k + k % 2, k, 0.0F, 0.0F, static_cast<std::int32_t>(k % levels) - 1}, quanta);
  }
  return candidates;
}

// Returns the solver's expectation: `packets` packets in total, shared out by the mean of the bands' shares.
std::vector<double> expectation(const Candidates& candidates, double packets) {
  std::vector<double> expected(candidates.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    for (std::size_t b = 0; b < 3; ++b) {
      expected[k] += packets / 3.0 * static_cast<double>(candidates.quanta(k)[b]) / static_cast<double>(candidates.totals()[b]);
    }
  }
  return expected;
}

TEST(Packets, APlaceWithoutFluxIsNoCandidate) {
  Candidates candidates(2);
  candidates.add({}, std::array<std::int64_t, 2>{0, 0});
  EXPECT_EQ(candidates.size(), 0U);
  candidates.add({}, std::array<std::int64_t, 2>{2, 1});
  EXPECT_EQ(candidates.size(), 1U);
  candidates.retire({false, true});
  EXPECT_EQ(candidates.totals(), (std::vector<std::int64_t>{2, 0}));
  EXPECT_EQ(candidates.quanta(0)[0], 2);
  EXPECT_EQ(candidates.quanta(0)[1], 0);
}

// Places are sorted by side first: if both sides of one landing were neighbours, every draw would take the same side wherever a
// landing's expectation is one packet (rho + tau = 1). Then they are in leaf order, the ground last.
TEST(Packets, PlacesAreDrawnBySideAndOrder) {
  Candidates candidates(1);
  const std::array<std::int64_t, 1> some = {1};
  float number = 0.0F;
  for (const std::uint32_t order : {700000U, 3U, 3U, 9000U}) {
    for (const std::uint32_t side : {0U, 1U}) {
      candidates.add({2 * order + side, order, number, 0.0F, order == 9000 ? 0 : 5}, some);
      number += 1.0F;
    }
  }
  for (const std::uint32_t cell : {7U, 2U}) {
    candidates.add({shared::landed_on_ground, 0x80000000U + cell, number, 0.0F, -1}, some);
    number += 1.0F;
  }
  candidates = sorted(candidates);
  std::vector<int> added;
  for (std::size_t k = 0; k < candidates.size(); ++k) added.push_back(static_cast<int>(candidates.place(k).a));
  EXPECT_EQ(added, (std::vector<int>{2, 4, 6, 0, 9, 8, 3, 5, 7, 1}));
}

// Packets carry all of a band's waiting flux, or none of it.
void expect_books_closed(const Candidates& candidates, const SharedDraw& draw) {
  ASSERT_EQ(draw.kept.size(), 3U);
  std::array<std::int64_t, 3> carried{};
  for (std::size_t p = 0; p < draw.candidate.size(); ++p) {
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_GE(draw.quanta[3 * p + b], 0);
      if (candidates.quanta(draw.candidate[p])[b] == 0) {
        EXPECT_EQ(draw.quanta[3 * p + b], 0);
      }
      carried[b] += draw.quanta[3 * p + b];
    }
  }
  for (std::size_t b = 0; b < 3; ++b) EXPECT_EQ(carried[b], draw.kept[b] ? 0 : candidates.totals()[b]);
}

TEST(Packets, DrawingKeepsTotalsAndExpectations) {
  for (const std::uint32_t levels : {1U, 12U}) {
    const Candidates candidates = scattered_candidates(500, levels, 3);
    for (const double packets : {64.0, 1024.0}) {
      const std::vector<double> expected = expectation(candidates, packets);
      for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        RandomStream random(seed, 0);
        const SharedDraw draw = drawn(candidates, expected, random);
        EXPECT_TRUE(std::is_sorted(draw.candidate.begin(), draw.candidate.end()));
        ASSERT_EQ(draw.quanta.size(), 3 * draw.candidate.size());
        EXPECT_LE(std::abs(static_cast<double>(draw.candidate.size()) - packets), 1.0);
        expect_books_closed(candidates, draw);
        std::vector<int> drawn(candidates.size());
        for (const std::uint32_t k : draw.candidate) ++drawn[k];
        for (std::size_t k = 0; k < drawn.size(); ++k) {
          EXPECT_GE(drawn[k], std::floor(expected[k] - 1e-9));
          EXPECT_LE(drawn[k], std::ceil(expected[k] + 1e-9));
        }
      }
    }
  }
}

// A band that no drawn packet carries stays where it is, whole.
TEST(Packets, BandThatIsNotDrawnIsKept) {
  Candidates candidates(2);
  candidates.add({0, 0, 0.0F, 0.0F, -1}, std::array<std::int64_t, 2>{1000, 0});
  candidates.add({2, 1, 0.0F, 0.0F, -1}, std::array<std::int64_t, 2>{0, 7});
  int kept = 0;
  constexpr int draws = 20000;
  for (int k = 0; k < draws; ++k) {
    RandomStream random(9, static_cast<std::uint64_t>(k));
    const SharedDraw draw = drawn(candidates, std::array{3.0, 0.25}, random);
    ASSERT_FALSE(draw.kept[0]);
    kept += draw.kept[1] ? 1 : 0;
    ASSERT_EQ(draw.candidate.size(), draw.kept[1] ? 3U : 4U);
  }
  EXPECT_NEAR(kept, 0.75 * draws, 4.0 * std::sqrt(draws * 0.75 * 0.25));
}

// Places in clusters, each at its level, and the share of each place's flux that reaches a certain spot.
struct Scattered {
  Candidates candidates{3};
  std::vector<double> landing;
};
Scattered clustered_places(std::uint32_t levels) {
  Random random(4);
  Scattered scattered;
  std::int32_t level = 0;
  for (std::uint32_t k = 0; k < 600; ++k) {
    if (random.uniform() < 0.3) level = static_cast<std::int32_t>(levels * std::pow(random.uniform(), 2.0));
    const auto size = [&](double share) {
      return static_cast<std::int64_t>(random.uniform() < share ? random.uniform(0.2, 1.0) * 1e9 : 0.0);
    };
    scattered.candidates.add({2 * k, k, 0.0F, 0.0F, level}, std::array{size(1.0), size(0.7), size(0.2)});
  }
  scattered.candidates = sorted(scattered.candidates);
  for (std::size_t k = 0; k < scattered.candidates.size(); ++k) {
    const double order = scattered.candidates.place(k).order;
    scattered.landing.push_back(0.5 + 0.5 * std::sin(0.013 * order * order));
  }
  return scattered;
}

// Returns the share of a band's flux that lands on the spot with one draw; flux that no packet carries counts with its exact
// share, since it lands in later rounds.
double landed_share(const Scattered& places, const SharedDraw& draw, std::size_t band) {
  double landed = 0.0;
  for (std::size_t p = 0; p < draw.candidate.size(); ++p) {
    landed += static_cast<double>(draw.quanta[3 * p + band]) * places.landing[draw.candidate[p]];
  }
  for (std::size_t k = 0; k < places.candidates.size(); ++k) {
    if (draw.kept[band]) landed += static_cast<double>(places.candidates.quanta(k)[band]) * places.landing[k];
  }
  return landed / static_cast<double>(places.candidates.totals()[band]);
}

// Scaling to the waiting flux is a ratio estimate: the mean of ten thousand draws equals the exact sum within its own error. A
// round has at least 256 packets.
TEST(Packets, DrawingIsUnbiased) {
  constexpr int draws = 10000;
  for (const std::uint32_t levels : {1U, 20U}) {
    const Scattered places = clustered_places(levels);
    for (const double packets : {256.0, 1024.0}) {
      const std::vector<double> expected = expectation(places.candidates, packets);
      std::array<ReplicateMean, 3> means;
      for (int k = 0; k < draws; ++k) {
        RandomStream random(11, static_cast<std::uint64_t>(k));
        const SharedDraw draw = drawn(places.candidates, expected, random);
        for (std::size_t b = 0; b < 3; ++b) means[b].add(landed_share(places, draw, b));
      }
      for (std::size_t b = 0; b < 3; ++b) {
        double exact = 0.0;
        for (std::size_t k = 0; k < places.landing.size(); ++k) {
          exact += static_cast<double>(places.candidates.quanta(k)[b]) * places.landing[k];
        }
        exact /= static_cast<double>(places.candidates.totals()[b]);
        expect_agrees(estimate_of(means[b]), exact, draws, 1e-3, 12, packets < 1000.0 ? "256 packets" : "1024 packets");
      }
    }
  }
}

TEST(Packets, QuantaSplitIntoPartsThatAddUp) {
  struct Row {
    double reflectance, transmittance;
  };
  const std::vector<Row> rows = {{0.12, 0.06}, {0.45, 0.45}, {0.0, 0.3}, {0.3, 0.0}, {1.0, 0.0},
                                 {0.0, 1.0},   {0.7, 0.3},   {0.1, 0.9}, {0.0, 0.0}, {1.0 / 3.0, 2.0 / 3.0}};
  RandomStream random(1, 1);
  for (const Row& row : rows) {
    for (const std::int64_t quanta : {std::int64_t{1}, std::int64_t{7}, std::int64_t{1000003}, (std::int64_t{1} << 46) + 1}) {
      ReplicateMean reflected, transmitted, absorbed;
      for (int k = 0; k < 4000; ++k) {
        const QuantaSplit split = split_quanta(quanta, split_coefficients(row.reflectance, row.transmittance), random.unit());
        EXPECT_EQ(split.absorbed + split.reflected + split.transmitted, quanta);
        const auto share = static_cast<double>(quanta);
        const double absorptance = 1.0 - row.reflectance - row.transmittance;
        for (const auto& [part, coefficient] :
             {std::pair{split.absorbed, absorptance}, std::pair{split.reflected, row.reflectance},
              std::pair{split.transmitted, row.transmittance}}) {
          EXPECT_GE(part, 0);
          EXPECT_LT(std::abs(static_cast<double>(part) - share * coefficient), 1.05);
          if (coefficient < 1e-12) {
            EXPECT_EQ(part, 0);
          }
        }
        reflected.add(static_cast<double>(split.reflected) - share * row.reflectance);
        transmitted.add(static_cast<double>(split.transmitted) - share * row.transmittance);
      }
      constexpr std::size_t comparisons = 80;
      for (const ReplicateMean* mean : {&reflected, &transmitted}) {
        EXPECT_LE(std::abs(mean->mean()), table_quantile(comparisons, 4000) * mean->standard_error() + 0.01);
      }
    }
  }
}

// Sends one packet from each of many starts, so that they are independent. The cosine's square is even over [0, 1), the angle
// about the normal is even over a turn, and so are both together.
TEST(Packets, DirectionsAreCosineDistributedAboutTheSide) {
  const std::vector<glm::dvec3> normals = {{0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.6, 0.0, -0.8}, inclined(1.1, 2.2)};
  for (const glm::dvec3& normal : normals) {
    MeshMaker maker;
    maker.polygon({0.5, 0.5, 0.5}, normal, 0.01, 3);
    const Canopy canopy = black_model(maker.mesh(), {1.0, 1.0, true}, beijing_sun()).canopy;
    const glm::dvec3 own = unit_normal(canopy.corners[0]);
    const glm::dvec3 u = glm::normalize(glm::dvec3(canopy.corners[0][1]) - glm::dvec3(canopy.corners[0][0]));
    const glm::dvec3 v = glm::cross(own, u);
    for (const std::uint32_t side : {0U, 1U}) {
      Candidates candidates(1);
      candidates.add({side, 0, 0.3F, 0.3F, 0}, std::array<std::int64_t, 1>{100});
      constexpr std::size_t cells = 12;
      std::vector<std::uint64_t> bins(cells * cells);
      for (std::uint64_t k = 0; k < 30000; ++k) {
        RandomStream random(20, k);
        Draw draw;
        draw.candidate = {0};
        const shared::Packet packet = started(canopy, candidates, draw, {1e-5, 0.0}, random)[0];
        const glm::dvec3 direction = glm::normalize(glm::dvec3(packet.direction));
        EXPECT_EQ(packet.element, 0U);
        const double cosine = glm::dot(direction, own) * (side == 0 ? 1.0 : -1.0);
        ASSERT_GE(cosine, 0.0);
        const double turn = std::atan2(glm::dot(direction, v), glm::dot(direction, u)) / (2.0 * std::numbers::pi) + 0.5;
        const auto cell = [](double at) { return std::min(cells - 1, static_cast<std::size_t>(at * cells)); };
        ++bins[cell(cosine * cosine) * cells + cell(turn)];
      }
      expect_flat(bins, side == 0 ? "upper side" : "lower side");
    }
  }
}

// A lamp's packets start evenly over its triangle.
TEST(Packets, LampsGlowEvenly) {
  MeshMaker maker;
  maker.triangle({0.1, 0.5, 0.1}, {0.2, 0.5, 0.9}, {0.9, 0.5, 0.3});
  const Canopy canopy = black_model(maker.mesh(), {1.0, 1.0, true}, beijing_sun()).canopy;
  Candidates candidates(1);
  candidates.add({0, 0, anywhere, 0.0F, 0}, std::array<std::int64_t, 1>{100});
  const glm::dvec3 a(canopy.corners[0][0]);
  const glm::dvec3 ab = glm::dvec3(canopy.corners[0][1]) - a;
  const glm::dvec3 ac = glm::dvec3(canopy.corners[0][2]) - a;
  const double twice_m2 = glm::dot(glm::cross(ab, ac), unit_normal(canopy.corners[0]));
  constexpr int cells = 8;
  std::vector<std::uint64_t> bins(cells * cells);
  for (std::uint64_t k = 0; k < 30000; ++k) {
    RandomStream random(21, k);
    Draw draw;
    draw.candidate = {0};
    const shared::Packet packet = started(canopy, candidates, draw, {0.0, 0.0}, random)[0];
    const glm::dvec3 at = glm::dvec3(packet.origin) - a;
    const double b = cells * glm::dot(glm::cross(at, ac), unit_normal(canopy.corners[0])) / twice_m2;
    const double c = cells * glm::dot(glm::cross(ab, at), unit_normal(canopy.corners[0])) / twice_m2;
    // Numbers congruent triangles by row and column of the parallelogram's cell, folded where the cell lies across its
    // diagonal.
    const int i = std::clamp(static_cast<int>(b), 0, cells - 1);
    const int j = std::clamp(static_cast<int>(c), 0, cells - 1);
    ASSERT_LE(b + c, cells * (1.0 + 1e-5));
    const bool beyond = b - i + c - j > 1.0;
    const int place = beyond ? (cells - 1 - i) * cells + (cells - 1 - j) : i * cells + j;
    ASSERT_LT(place, cells * cells);
    ++bins[static_cast<std::size_t>(place)];
  }
  expect_flat(bins, "places on the lamp");
}

// The leaf lies across the plot's corner: the start lies in the plot, and the image names the copy of the leaf on which it
// lies.
TEST(Packets, StartsAreWrappedIntoThePlot) {
  MeshMaker maker;
  maker.quad({-0.4, 0.3, -0.7}, {-0.4, 0.7, 0.5}, {0.5, 0.9, 0.5}, {0.5, 0.5, -0.7});
  const RadiationModel model = black_model(maker.mesh(), {0.5, 0.75, true}, beijing_sun());
  const Canopy& canopy = model.canopy;
  Random places(5);
  Candidates candidates(1);
  Draw draw;
  for (std::uint32_t k = 0; k < 2000; ++k) {
    const double b = places.uniform();
    const double c = places.uniform() * (1.0 - b);
    candidates.add({k % 4, 0, static_cast<float>(b), static_cast<float>(c), 0}, std::array<std::int64_t, 1>{1});
    draw.candidate.push_back(k);
  }
  const double offset_m = 1e-4;
  RandomStream random(1, 1);
  const std::vector<shared::Packet> packets = started(canopy, candidates, draw, {offset_m, 0.0}, random);
  int wrapped = 0;
  for (std::uint32_t k = 0; k < packets.size(); ++k) {
    const shared::Packet& packet = packets[k];
    const Triangle& corners = canopy.corners[packet.element];
    EXPECT_GE(packet.origin.x, 0.0F);
    EXPECT_LE(packet.origin.x, static_cast<float>(canopy.period_m.x));
    EXPECT_GE(packet.origin.z, 0.0F);
    EXPECT_LE(packet.origin.z, static_cast<float>(canopy.period_m.y));
    const auto dx = static_cast<std::int16_t>(packet.image & 0xffffU);
    const auto dz = static_cast<std::int16_t>(packet.image >> 16U);
    wrapped += packet.image != 0 ? 1 : 0;
    // The copy's plane lies behind the start by the offset.
    const Triangle copy = reference_corners(canopy, {packet.element, dx, dz});
    const double side = candidates.place(k).surface % 2 == 0 ? 1.0 : -1.0;
    const double height_m = glm::dot(glm::dvec3(packet.origin) - glm::dvec3(copy[0]), unit_normal(corners)) * side;
    EXPECT_NEAR(height_m, offset_m, 1e-6);
    const auto weight_b = static_cast<double>(candidates.place(k).a);
    const auto weight_c = static_cast<double>(candidates.place(k).b);
    const glm::dvec3 expected = glm::dvec3(copy[0]) + (glm::dvec3(copy[1]) - glm::dvec3(copy[0])) * weight_b +
                                (glm::dvec3(copy[2]) - glm::dvec3(copy[0])) * weight_c +
                                unit_normal(corners) * (side * offset_m);
    EXPECT_LT(glm::distance(glm::dvec3(packet.origin), expected), 1e-6);
  }
  EXPECT_GT(wrapped, 500);
}

// Packets from the ground rise.
TEST(Packets, GroundSendsLightUp) {
  const Canopy canopy = black_model(Mesh{}, {1.0, 1.0, true}, beijing_sun()).canopy;
  Candidates candidates(1);
  candidates.add({shared::landed_on_ground, 0, 0.25F, 0.75F, -1}, std::array<std::int64_t, 1>{1});
  Draw draw;
  draw.candidate.assign(1000, 0);
  RandomStream random(1, 1);
  for (const shared::Packet& packet : started(canopy, candidates, draw, {1e-4, 0.125}, random)) {
    EXPECT_EQ(packet.element, shared::no_element);
    EXPECT_NEAR(packet.origin.x, 0.25F, 1e-6F);
    EXPECT_NEAR(packet.origin.y, 0.1251F, 1e-6F);
    EXPECT_NEAR(packet.origin.z, 0.75F, 1e-6F);
    EXPECT_GE(packet.direction.y, 0.0F);
  }
}

}  // namespace
}  // namespace sunfleck::test
