// Tests how waiting flux becomes packets, and how a packet's quanta are split where it lands.
#include "physics/bvh/references.h"
#include "physics/transport/indirect/packet_draw.h"
#include "physics/transport/indirect/packet_starts.h"
#include "support/chi_square.h"
#include "support/scattering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr std::uint32_t mirror_number = 0, leaf_number = 1;

// Two optics in some bands: a mirror, whose sides send all that lands there, and leaves that reflect 0.3 and transmit 0.2.
RadiationModel optics_model(std::size_t bands) {
  RadiationModel model;
  model.bands.resize(bands);
  model.optics.resize(2);
  set_faces(model, mirror_number, std::vector<FaceOptics>(bands, {.reflectance = 1.0, .transmittance = 0.0}));
  set_faces(model, leaf_number, std::vector<FaceOptics>(bands, {.reflectance = 0.3, .transmittance = 0.2}));
  return model;
}

// Places where quanta of a few bands wait, and their draws.
class Places {
 public:
  explicit Places(std::size_t bands) : bands_(bands), scattering_(optics_model(bands), 1), totals_(bands) {
    flux.clear({0, bands});
  }

  // Adds a place on a mirror.
  void add(EmissionPoint place, std::span<const std::int64_t> quanta) {
    place.face = face_of(mirror_number, place.surface % 2);
    flux.add(place, quanta);
    for (std::size_t b = 0; b < bands_; ++b) totals_[b] += quanta[b];
  }
  void sort() {
    WaitingFlux sorted;
    sorted.take_sorted(flux);
    flux = std::move(sorted);
  }

  // Draws `packets` packets in a first round that began with `start`, or with what waits.
  const PacketDraw& draw(double packets, std::uint64_t offset, const std::vector<std::int64_t>& start = {}) {
    draw_.emplace(scattering_, nullptr, packets, start.empty() ? totals_ : start, arrays_);
    draw_->draw(flux, {0, bands_}, totals_, offset);
    return *draw_;
  }
  std::vector<std::int64_t> carried(std::size_t packet) const {
    std::vector<std::int64_t> quanta(bands_);
    draw_->carry(packet, quanta);
    return quanta;
  }
  [[nodiscard]] const std::vector<std::int64_t>& totals() const { return totals_; }
  [[nodiscard]] const Scattering& scattering() const { return scattering_; }

  WaitingFlux flux;

 private:
  std::size_t bands_;
  Scattering scattering_;
  std::vector<std::int64_t> totals_;
  DrawArrays arrays_;
  std::optional<PacketDraw> draw_;
};

// Starts the packets in two parts, as long rounds are.
std::vector<shared::Packet> started(const Canopy& canopy, const WaitingFlux& flux, const PacketDraw& draw,
                                    const EmissionFrame& frame) {
  const PacketStarts starts(canopy, flux, draw, frame, {1U, 2U, 3U, 4U});
  std::vector<shared::Packet> packets(draw.packets());
  const std::size_t part = packets.size() / 3;
  starts.write(0, std::span(packets).first(part));
  starts.write(part, std::span(packets).subspan(part));
  return packets;
}

// Starts one packet from the only place of `places`, with random words of its own.
shared::Packet started_alone(const Canopy& canopy, Places& places, const EmissionFrame& frame, std::uint64_t number) {
  RandomStream random(20, number);
  const auto word = [&] { return static_cast<std::uint32_t>(random.word() >> 32U); };
  const std::uint32_t x = word(), y = word(), z = word();
  shared::Packet packet;
  PacketStarts(canopy, places.flux, places.draw(256.0, 0), frame, {x, y, z, word()}).write(0, std::span(&packet, 1));
  return packet;
}

// Returns places with quanta of very different sizes in three bands, the last nearly empty, at levels from -1 (soil) upwards.
Places scattered_places(std::uint32_t count, std::uint32_t levels, std::uint32_t seed) {
  Random random(seed);
  Places places(3);
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto size = [&](double decades) { return static_cast<std::int64_t>(std::pow(10.0, random.uniform(0.0, decades))); };
    const std::array<std::int64_t, 3> quanta = {size(9.0), k % 3 == 0 ? 0 : size(3.0), k % 50 == 7 ? size(5.0) : 0};
    places.add({2 * k + k % 2, k, 0.0F, 0.0F, static_cast<std::int32_t>(k % levels) - 1}, quanta);
  }
  return places;
}

// Returns the number of packets expected at each place: `packets` in total, shared out by the mean of the bands' shares.
std::vector<double> expectation(const Places& places, double packets) {
  std::vector<double> expected(places.flux.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const auto quanta = places.flux.quanta(k, {0, 3});
    for (std::size_t b = 0; b < 3; ++b) {
      expected[k] += packets / 3.0 * static_cast<double>(quanta[b]) / static_cast<double>(places.totals()[b]);
    }
  }
  return expected;
}

TEST(Packets, APlaceWithoutFluxDoesNotWait) {
  WaitingFlux flux;
  flux.clear({0, 2});
  flux.add({}, std::array<std::int64_t, 2>{0, 0});
  EXPECT_EQ(flux.size(), 0U);
  flux.add({}, std::array<std::int64_t, 2>{2, 1});
  EXPECT_EQ(flux.size(), 1U);
  EXPECT_EQ(flux.quanta(0, {1, 1})[0], 1);
}

// Places are sorted in 240 parts by leaf order and 16 by cell of the ground; within a part they stay in the order in which they
// were added.
TEST(Packets, PlacesWaitPartByPart) {
  for (const std::size_t columns : {1, 40}) {
    WaitingFlux flux, sorted;
    flux.clear({0, columns});
    std::vector<std::int64_t> row(columns);
    for (const std::uint32_t order : {719U, 4U, 2U, 9U, 600U}) {
      row[0] = order;
      flux.add({2 * order, order}, row);
    }
    for (const std::uint32_t cell : {15U, 2U}) {
      row[0] = 1000 + cell;
      flux.add({shared::landed_on_ground, ground_order + cell}, row);
    }
    sorted.take_sorted(flux);
    std::vector<std::int64_t> found;
    for (std::size_t k = 0; k < sorted.size(); ++k) found.push_back(sorted.quanta(k, {0, columns})[0]);
    EXPECT_EQ(found, (std::vector<std::int64_t>{2, 4, 9, 600, 719, 1002, 1015}));
  }
  WaitingFlux flux, sorted;
  flux.clear({0, 1});
  for (const std::uint32_t order : {24000U, 3U, 2U}) flux.add({2 * order, order}, std::array{std::int64_t{order}});
  sorted.take_sorted(flux);
  EXPECT_EQ(sorted.place(0).order, 3U);
  EXPECT_EQ(sorted.place(1).order, 2U);
}

// If both sides of one landing were neighbours, every draw would take the same side wherever a landing's expectation is one
// packet (rho + tau = 1).
TEST(Packets, UpperSidesAreDrawnBeforeLowerOnes) {
  Places places(1);
  for (std::uint32_t k = 0; k < 100; ++k) places.add({2 * k + k % 2, k}, std::array<std::int64_t, 1>{1000});
  const PacketDraw& draw = places.draw(1000.0, 0);
  std::uint32_t last_side = 0, last_place = 0;
  for (std::size_t p = 0; p < draw.packets(); ++p) {
    const PacketSource from = draw.source(p);
    EXPECT_GE(from.side, last_side);
    EXPECT_EQ(places.flux.place(from.place).surface % 2, from.side);
    if (from.side == last_side) {
      EXPECT_GE(from.place, last_place);
    }
    last_side = from.side;
    last_place = from.place;
  }
  EXPECT_EQ(last_side, 1U);
}

// What is reflected leaves from the side on which it landed, what is transmitted from the other one.
TEST(Packets, LeaveFromBothSidesOfALeaf) {
  Places places(1);
  EmissionPoint place{.surface = 5, .order = 2};
  place.face = face_of(leaf_number, 1);
  const std::array<std::int64_t, 1> landed = {1'000'000'000};
  places.flux.add(place, landed);
  const std::vector<std::int64_t> sent = {500'000'000};
  DrawArrays arrays;
  PacketDraw draw(places.scattering(), nullptr, 1000.0, sent, arrays);
  draw.draw(places.flux, {0, 1}, sent, 0);
  ASSERT_NEAR(static_cast<double>(draw.packets()), 1000.0, 2.0);
  std::size_t upper = 0;
  std::int64_t carried = 0;
  for (std::size_t p = 0; p < draw.packets(); ++p) {
    std::array<std::int64_t, 1> quanta{};
    draw.carry(p, quanta);
    carried += quanta[0];
    upper += draw.source(p).side == 0 ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(quanta[0]), 500'000.0, 1000.0);
  }
  EXPECT_NEAR(static_cast<double>(upper), 400.0, 2.0);  // lands from below: 0.2 of 0.5 leaves above
  EXPECT_LE(carried, sent[0]);
  EXPECT_GE(carried, sent[0] - 1001);
}

// Packets carry a band's waiting flux but for at most one quantum each, and nothing of a band that does not wait at their place.
void expect_books_closed(const Places& places, const PacketDraw& draw) {
  std::array<std::int64_t, 3> carried{};
  for (std::size_t p = 0; p < draw.packets(); ++p) {
    const std::vector<std::int64_t> quanta = places.carried(p);
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_GE(quanta[b], 0);
      if (places.flux.quanta(draw.source(p).place, {0, 3})[b] == 0) {
        EXPECT_EQ(quanta[b], 0);
      }
      carried[b] += quanta[b];
    }
  }
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_TRUE(draw.carries(b));
    EXPECT_LE(carried[b], places.totals()[b]);
    EXPECT_GE(carried[b], places.totals()[b] - static_cast<std::int64_t>(draw.packets()));
  }
}

TEST(Packets, DrawingKeepsTotalsAndExpectations) {
  for (const std::uint32_t levels : {1U, 12U}) {
    Places places = scattered_places(500, levels, 3);
    for (const double wanted : {64.0, 1024.0}) {
      const double packets = std::max(256.0, wanted);
      const std::vector<double> expected = expectation(places, packets);
      for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const PacketDraw& draw = places.draw(wanted, RandomStream(seed, 0).word());
        EXPECT_LE(std::abs(static_cast<double>(draw.packets()) - packets), 1.0);
        expect_books_closed(places, draw);
        std::vector<int> drawn(places.flux.size());
        for (std::size_t p = 0; p < draw.packets(); ++p) ++drawn[draw.source(p).place];
        for (std::size_t k = 0; k < drawn.size(); ++k) {
          EXPECT_GE(drawn[k], std::floor(expected[k] * (1.0 - 1.0 / packets)));
          EXPECT_LE(drawn[k], std::ceil(expected[k] * (1.0 + 1.0 / packets)));
        }
      }
    }
  }
}

// A band of which little is left is still expected in 16 packets, so that all of them hardly ever miss it.
TEST(Packets, FaintBandIsDrawn) {
  Places places(2);
  places.add({0, 0}, std::array<std::int64_t, 2>{1'000'000, 0});
  places.add({2, 1}, std::array<std::int64_t, 2>{0, 7000});
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const PacketDraw& draw = places.draw(1000.0, RandomStream(seed, 0).word(), {1'000'000, 1'000'000'000'000});
    std::size_t of_faint = 0;
    for (std::size_t p = 0; p < draw.packets(); ++p) of_faint += draw.source(p).place;
    EXPECT_GE(of_faint, 15U);
    EXPECT_LE(of_faint, 17U);
    EXPECT_TRUE(draw.carries(0));
    EXPECT_TRUE(draw.carries(1));
  }
}

// Places that all bands share do not get 16 packets for each of them.
TEST(Packets, FaintBandsShareTheirPackets) {
  constexpr std::size_t bands = 40;
  Places places(bands);
  std::vector<std::int64_t> start(bands, std::int64_t{1} << 40U);
  for (std::uint32_t k = 0; k < 50; ++k) places.add({2 * k, k}, std::vector<std::int64_t>(bands, 1000));
  EXPECT_EQ(places.draw(10000.0, 0, start).packets(), 256U);
}

TEST(Packets, NothingIsDrawnFromNothing) {
  Places places(1);
  const PacketDraw& draw = places.draw(1000.0, 5);
  EXPECT_EQ(draw.packets(), 0U);
  EXPECT_FALSE(draw.carries(0));
}

// Places in clusters, each at its level, and the share of each place's flux that reaches a certain spot.
struct Scattered {
  Places places{3};
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
    scattered.places.add({2 * k, k, 0.0F, 0.0F, level}, std::array{size(1.0), size(0.7), size(0.2)});
  }
  scattered.places.sort();
  for (std::size_t k = 0; k < scattered.places.flux.size(); ++k) {
    const double order = scattered.places.flux.place(k).order;
    scattered.landing.push_back(0.5 + 0.5 * std::sin(0.013 * order * order));
  }
  return scattered;
}

// Scaling to the waiting flux is a ratio estimate: the mean of ten thousand draws equals the exact sum within its own error. A
// round has at least 256 packets.
TEST(Packets, DrawingIsUnbiased) {
  constexpr int draws = 10000;
  for (const std::uint32_t levels : {1U, 20U}) {
    Scattered scattered = clustered_places(levels);
    Places& places = scattered.places;
    for (const double packets : {256.5, 1024.0}) {
      std::array<ReplicateMean, 3> means;
      for (int k = 0; k < draws; ++k) {
        const PacketDraw& draw = places.draw(packets, RandomStream(11, static_cast<std::uint64_t>(k)).word());
        std::array<double, 3> landed{};
        for (std::size_t p = 0; p < draw.packets(); ++p) {
          const std::vector<std::int64_t> quanta = places.carried(p);
          for (std::size_t b = 0; b < 3; ++b) {
            landed[b] += static_cast<double>(quanta[b]) * scattered.landing[draw.source(p).place];
          }
        }
        for (std::size_t b = 0; b < 3; ++b) means[b].add(landed[b] / static_cast<double>(places.totals()[b]));
      }
      for (std::size_t b = 0; b < 3; ++b) {
        double exact = 0.0;
        for (std::size_t k = 0; k < scattered.landing.size(); ++k) {
          exact += static_cast<double>(places.flux.quanta(k, {0, 3})[b]) * scattered.landing[k];
        }
        exact /= static_cast<double>(places.totals()[b]);
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
      // Coefficients are rounded to 2^-32.
      const double tolerance = static_cast<double>(quanta) * 0x1p-32;
      ReplicateMean reflected, transmitted, absorbed;
      for (int k = 0; k < 4000; ++k) {
        const QuantaSplit split = split_quanta(quanta, split_coefficients(row.reflectance, row.transmittance),
                                               static_cast<std::uint32_t>(random.word() >> 32U));
        EXPECT_EQ(split.absorbed + split.reflected + split.transmitted, quanta);
        const auto share = static_cast<double>(quanta);
        const double absorptance = 1.0 - row.reflectance - row.transmittance;
        for (const auto& [part, coefficient] :
             {std::pair{split.absorbed, absorptance}, std::pair{split.reflected, row.reflectance},
              std::pair{split.transmitted, row.transmittance}}) {
          EXPECT_GE(part, 0);
          EXPECT_LT(std::abs(static_cast<double>(part) - share * coefficient), 1.05 + tolerance);
          if (coefficient < 1e-12) {
            EXPECT_EQ(part, 0);
          }
        }
        reflected.add(static_cast<double>(split.reflected) - share * row.reflectance);
        transmitted.add(static_cast<double>(split.transmitted) - share * row.transmittance);
      }
      constexpr std::size_t comparisons = 80;
      for (const ReplicateMean* mean : {&reflected, &transmitted}) {
        EXPECT_LE(std::abs(mean->mean()), table_quantile(comparisons, 4000) * mean->standard_error() + 0.01 + tolerance);
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
      Places places(1);
      places.add({side, 0, 0.3F, 0.3F, 0}, std::array<std::int64_t, 1>{100});
      constexpr std::size_t cells = 12;
      std::vector<std::uint64_t> bins(cells * cells);
      for (std::uint64_t k = 0; k < 30000; ++k) {
        const shared::Packet packet = started_alone(canopy, places, {1e-5F, 0.0F}, k);
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
  Places places(1);
  places.add({0, 0, anywhere, 0.0F, 0}, std::array<std::int64_t, 1>{100});
  const glm::dvec3 a(canopy.corners[0][0]);
  const glm::dvec3 ab = glm::dvec3(canopy.corners[0][1]) - a;
  const glm::dvec3 ac = glm::dvec3(canopy.corners[0][2]) - a;
  const double twice_m2 = glm::dot(glm::cross(ab, ac), unit_normal(canopy.corners[0]));
  constexpr int cells = 8;
  std::vector<std::uint64_t> bins(cells * cells);
  for (std::uint64_t k = 0; k < 30000; ++k) {
    const shared::Packet packet = started_alone(canopy, places, {}, k);
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
  Random random(5);
  Places places(1);
  for (std::uint32_t k = 0; k < 2000; ++k) {
    const double b = random.uniform();
    const double c = random.uniform() * (1.0 - b);
    places.add({k % 4, 0, static_cast<float>(b), static_cast<float>(c), 0}, std::array<std::int64_t, 1>{1000});
  }
  const float offset_m = 1e-4F;
  const PacketDraw& draw = places.draw(2000.0, std::uint64_t{1} << 63U);
  const std::vector<shared::Packet> packets = started(canopy, places.flux, draw, {offset_m, 0.0F});
  ASSERT_EQ(packets.size(), 2000U);
  int wrapped = 0;
  for (std::uint32_t k = 0; k < packets.size(); ++k) {
    const shared::Packet& packet = packets[k];
    const EmissionPoint& place = places.flux.place(draw.source(k).place);
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
    const double side = place.surface % 2 == 0 ? 1.0 : -1.0;
    const double height_m = glm::dot(glm::dvec3(packet.origin) - glm::dvec3(copy[0]), unit_normal(corners)) * side;
    EXPECT_NEAR(height_m, offset_m, 1e-6);
    const auto weight_b = static_cast<double>(place.a);
    const auto weight_c = static_cast<double>(place.b);
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
  Places places(1);
  places.add({shared::landed_on_ground, ground_order, 0.25F, 0.75F, -1}, std::array<std::int64_t, 1>{1000});
  for (const shared::Packet& packet : started(canopy, places.flux, places.draw(1000.0, 0), {1e-4F, 0.125F})) {
    EXPECT_EQ(packet.element, shared::no_element);
    EXPECT_NEAR(packet.origin.x, 0.25F, 1e-6F);
    EXPECT_NEAR(packet.origin.y, 0.1251F, 1e-6F);
    EXPECT_NEAR(packet.origin.z, 0.75F, 1e-6F);
    EXPECT_GE(packet.direction.y, 0.0F);
  }
}

}  // namespace
}  // namespace sunfleck::test
