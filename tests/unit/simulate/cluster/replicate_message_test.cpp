#include "simulate/cluster/replicate_message.h"

#include "base/error.h"
#include "physics/transport/indirect/replicate_maker.h"
#include "support/light_mix.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

using Bytes = std::vector<std::byte>;

// Tries every length that is too short, and one byte too many.
template <class Unpack>
void expect_whole_only(const Bytes& good, const Unpack& unpack) {
  EXPECT_NO_THROW(unpack(good));
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 64) {
    EXPECT_THROW(unpack(std::span(good).first(length)), Error) << length << " of " << good.size();
  }
  Bytes longer = good;
  longer.push_back(std::byte{0});
  EXPECT_THROW(unpack(longer), Error);
}

TEST(Orders, ArriveAsTheyWereSent) {
  OrderMessage sent{{3, 17}, 5, {1e6 / 7.0, true, 4096.5, 1U << 22U, 0.003, ~0ULL, (1ULL << 40U) + 17}};
  sent.order.ray_shares = {1.0, 0.25, 1.0 / 3.0};
  sent.order.counts_hits = true;
  const Bytes bytes = pack(sent);
  const OrderMessage got = unpack<OrderMessage>(bytes);
  EXPECT_EQ(got.key.series, 3U);
  EXPECT_EQ(got.key.number, 17U);
  EXPECT_EQ(got.stage, 5U);
  EXPECT_EQ(got.order.beam_rays, sent.order.beam_rays);
  EXPECT_EQ(got.order.aimed, sent.order.aimed);
  EXPECT_EQ(got.order.packets, sent.order.packets);
  EXPECT_EQ(got.order.sky_rays, sent.order.sky_rays);
  EXPECT_EQ(got.order.bound, sent.order.bound);
  EXPECT_EQ(got.order.seed, sent.order.seed);
  EXPECT_EQ(got.order.number, sent.order.number);
  EXPECT_EQ(got.order.ray_shares, sent.order.ray_shares);
  EXPECT_EQ(got.order.counts_hits, sent.order.counts_hits);
  expect_whole_only(bytes, [](std::span<const std::byte> cut) { static_cast<void>(unpack<OrderMessage>(cut)); });
}

TEST(Words, ArriveAsTheyWereSent) {
  const Bytes ready = pack(ReadyMessage{2, "node7", "scene 0123"});
  EXPECT_EQ(unpack<ReadyMessage>(ready).slots, 2U);
  EXPECT_EQ(unpack<ReadyMessage>(ready).host, "node7");
  EXPECT_EQ(unpack<ReadyMessage>(ready).scene, "scene 0123");
  expect_whole_only(ready, [](std::span<const std::byte> cut) { static_cast<void>(unpack<ReadyMessage>(cut)); });
  const Bytes failed = pack(FailedMessage{3, "", "no device (why); cure"});
  EXPECT_EQ(unpack<FailedMessage>(failed).kind, 3);
  EXPECT_EQ(unpack<FailedMessage>(failed).host, "");
  EXPECT_EQ(unpack<FailedMessage>(failed).text, "no device (why); cure");
  expect_whole_only(failed, [](std::span<const std::byte> cut) { static_cast<void>(unpack<FailedMessage>(cut)); });
}

TEST(Words, OfEndlessLengthTakeNoMemory) {
  Bytes bytes = pack(FailedMessage{1, "", ""});
  bytes.back() = std::byte{0x7F};  // the highest byte of the text's length
  EXPECT_THROW(static_cast<void>(unpack<FailedMessage>(bytes)), Error);
}

class Replicates : public ::testing::Test {
 protected:
  // Makes a replicate just as for the scene.
  [[nodiscard]] ReplicateSet make(const ReplicateOrder& order) {
    const Conversion conversion = maker_.conversion(maker_.incidence(order.beam_rays, order.aimed));
    return *maker_.make(order, {&conversion, 1}, [] { return false; });
  }
  [[nodiscard]] ReplicateOrder order(double packets) const {
    ReplicateOrder order{4000.0, true, packets, 500, 0.01, 1, 7};
    order.counts_hits = true;
    return order;
  }

  RadiationModel model_ = test::light_mix();
  test::Prepared prepared_{model_};
  CpuTracer tracer_{prepared_.bvh, test::tracer_scene(model_)};
  ReplicateMaker maker_{model_, prepared_.layout, tracer_};
};

// Packed again, they give the same bytes, which contain the whole replicate.
TEST_F(Replicates, ArriveAsTheyWereMade) {
  for (const double packets : {0.0, 1000.0}) {
    const ReplicateSet all_made = make(order(packets));
    const Bytes bytes = pack(ReplicateKey{1, 7}, all_made);
    EXPECT_EQ(unpack_key(bytes).number, 7U);
    const ReplicateSet all_got = unpack_replicates(bytes, maker_.blank(order(packets)));
    EXPECT_TRUE(pack(ReplicateKey{1, 7}, all_got) == bytes);
    const Replicate& made = all_made.front();
    const Replicate& got = all_got.front();
    EXPECT_EQ(got.counters, made.counters);
    EXPECT_EQ(got.passed.reached, made.passed.reached);
    ASSERT_EQ(got.packets.has_value(), packets > 0.0);
    if (!got.packets) continue;
    EXPECT_EQ(got.packets->side_landed.all(), made.packets->side_landed.all());
    EXPECT_EQ(got.packets->side_sky.all(), made.packets->side_sky.all());
    EXPECT_EQ(got.packets->receivers.through_up, made.packets->receivers.through_up);
    EXPECT_EQ(got.packets->ledger[1].unshot, made.packets->ledger[1].unshot);
    EXPECT_EQ(got.packets->lost, made.packets->lost);
    EXPECT_EQ(got.packets->first_waiting, made.packets->first_waiting);
    EXPECT_EQ(got.packets->sky_landed, made.packets->sky_landed);
    std::vector<std::int64_t> from_sky(made.packets->bands);
    for (const PlaceSums* sums : {&made.packets->side_sky, &made.packets->cell_sky}) {
      sums->for_each([&](std::size_t, std::span<const std::int64_t> quanta) {
        for (std::size_t b = 0; b < from_sky.size(); ++b) from_sky[b] += quanta[b];
      });
    }
    EXPECT_EQ(made.packets->sky_landed, from_sky);
    EXPECT_FALSE(got.packets->element_hits.empty());
    EXPECT_EQ(got.packets->element_hits, made.packets->element_hits);
  }
}

TEST_F(Replicates, AreRefusedUnlessWhole) {
  const Bytes good = pack(ReplicateKey{1, 7}, make(order(1000.0)));
  const ReplicateSet blank = maker_.blank(order(1000.0));
  expect_whole_only(good, [&](std::span<const std::byte> cut) { static_cast<void>(unpack_replicates(cut, blank)); });
}

TEST_F(Replicates, OfOtherSizesAreRefused) {
  const Bytes good = pack(ReplicateKey{1, 7}, make(order(1000.0)));
  const auto expect_refused = [&](const auto& change) {
    ReplicateSet blank = maker_.blank(order(1000.0));
    change(blank.front());
    EXPECT_THROW(static_cast<void>(unpack_replicates(good, blank)), Error);
  };
  expect_refused([](Replicate& r) { r.counters.pop_back(); });
  expect_refused([](Replicate& r) { r.passed.down.push_back(0); });
  expect_refused([](Replicate& r) { r.packets.reset(); });
  expect_refused([](Replicate& r) { r.packets->side_sky = PlaceSums(); });
  expect_refused([](Replicate& r) { r.packets->ledger.emplace_back(); });
  ReplicateSet of_two_lights = maker_.blank(order(1000.0));
  of_two_lights.push_back(of_two_lights.front());
  EXPECT_THROW(static_cast<void>(unpack_replicates(good, of_two_lights)), Error);
  EXPECT_THROW(static_cast<void>(unpack_replicates(pack(ReplicateKey{1, 7}, make(order(0.0))), maker_.blank(order(1000.0)))),
               Error);
}

// A replicate in several lights arrives with the sums of each.
TEST_F(Replicates, ArriveInAllTheirLights) {
  std::vector<RadiationModel> lights(3, model_);
  for (std::size_t k = 0; k < lights.size(); ++k) lights[k].bands[0].direct_w_m2 *= 1.0 + static_cast<double>(k);
  ReplicateMaker maker(lights, prepared_.layout, tracer_);
  ReplicateOrder of_all = order(1000.0);
  of_all.ray_shares = {1.0, 0.5, 0.25};
  std::vector<Conversion> conversions;
  conversions.reserve(lights.size());
  for (std::size_t k = 0; k < lights.size(); ++k) {
    conversions.push_back(maker.conversion(maker.incidence(of_all.rays_of(k), of_all.aimed, k), k));
  }
  const ReplicateSet made = *maker.make(of_all, conversions, [] { return false; });
  const ReplicateSet got = unpack_replicates(pack(ReplicateKey{1, 7}, made), maker.blank(of_all));
  ASSERT_EQ(got.size(), lights.size());
  for (std::size_t k = 0; k < lights.size(); ++k) {
    EXPECT_EQ(got[k].counters, made[k].counters);
    EXPECT_EQ(got[k].packets->side_landed.all(), made[k].packets->side_landed.all());
    EXPECT_EQ(got[k].packets->receivers.down, made[k].packets->receivers.down);
    EXPECT_EQ(got[k].packets->ledger[0].absorbed_vegetation, made[k].packets->ledger[0].absorbed_vegetation);
  }
}

}  // namespace
}  // namespace sunfleck
