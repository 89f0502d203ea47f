#include "agreement/stage_check.h"

#include "physics/transport/indirect/landing_places.h"
#include "shared/random.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace sunfleck::test {
namespace {

std::vector<std::int64_t> starts_of(const RoundsOrder& order) {
  std::vector<std::int64_t> start;
  for (const shared::RoundColumn& column : order.columns) start.push_back(static_cast<std::int64_t>(column.start));
  return start;
}

std::optional<PlaceAim> aim_of(const RoundsOrder& order) {
  if (order.block.stand.radius == 0.0F) return std::nullopt;
  return std::make_optional<PlaceAim>(order.scene, order.block.stand);
}

template <class T>
bool same_bytes(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

StageCheck::Host::Host(const RoundsOrder& of)
    : order(of),
      columns{0, of.columns.size()},
      scattering(of.scene.model, of.scene.lights.size()),
      aim(aim_of(of)),
      draw(scattering, aim ? &*aim : nullptr, of.packets, starts_of(of), arrays),
      side_landed(2 * of.scene.model.canopy.size() * columns.count),
      cell_landed(of.scene.layout.cells() * columns.count),
      plane_cells((of.scene.receivers != nullptr ? of.scene.receivers->cells() : 0) * columns.count),
      element_hits(of.block.counts_hits != 0 ? of.scene.model.canopy.size() : 0) {
  next.clear(columns);
  for (std::size_t k = 0; k < of.places.size(); ++k) next.add(of.places.place(k), of.places.quanta(k, columns));
}

std::optional<TraceOutcome> StageCheck::make_rounds(std::span<const RoundsPass> passes, const StopQuestion&) {
  for (const RoundsPass& pass : passes) {
    if (make_rounds(pass) == TraceOutcome::stopped) return TraceOutcome::stopped;
  }
  return TraceOutcome::finished;
}

std::optional<KeptBeam> StageCheck::keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                              const StopQuestion& stop) {
  Landings landings(std::size_t{beam.columns} * beam.rows);
  const std::optional<TraceOutcome> outcome = cpu_.record_beam(beam, counters, landings, stop);
  std::shared_ptr<const LandingsOnDevice> kept = steps_.keep_landings(landings.size());
  upload(context_, kept->buffer(), std::as_bytes(std::span(landings)));
  return KeptBeam{*outcome, std::move(kept)};
}

void StageCheck::add_landings(Host& host) {
  const RoundsOrder& order = host.order;
  if (order.landings == nullptr) return;
  const shared::BeamSample& sample = order.block.sampled;
  const auto landings = fetch<shared::Landing>(dynamic_cast<const LandingsOnDevice&>(*order.landings).buffer(), sample.rays);
  std::vector<EmissionPoint> points;
  for (std::uint32_t k = 0; k < sample.count; ++k) {
    const shared::Landing& landing = landings[(std::uint64_t{k} * sample.rays + sample.offset) / sample.count];
    if (landing.surface > shared::landed_on_ground) continue;
    points.push_back(place_of(order.scene, landing));
    points.back().u = shared::random_words(order.block.key, order.block.sample_word + k, 0).x;
  }
  std::vector<std::int64_t> own(host.columns.count);
  for (std::size_t c = 0; c < own.size(); ++c) {
    double sent = 0.0;
    for (const EmissionPoint& point : points) {
      sent += static_cast<double>(host.scattering.face(point.face).scattered[c]) * 0x1p-32;
    }
    own[c] = sent > 0.0 ? std::llround(static_cast<double>(order.columns[c].from_beam) / sent) : 0;
  }
  for (const EmissionPoint& point : points) host.next.add(point, own);
  sampled_ += points.size();
}

TraceOutcome StageCheck::make_rounds(const RoundsPass& pass) {
  const std::span<const RoundsPass> passes(&pass, 1);
  EXPECT_EQ(steps_.make_room(passes), 1U);
  submit([&](Submission& submission) { steps_.give(submission, passes); });
  const RoundsOrder& order = *pass.order;
  Host host(order);
  add_landings(host);
  const std::uint64_t first_places = host.next.size();
  auto places = static_cast<std::uint32_t>(order.first_places());
  for (;;) {
    compare_places(host, host.next, places, RoundBuffer::next_places, RoundBuffer::next_quanta);
    shared::RoundState state{};
    submit([&](Submission& submission) {
      steps_.begin(submission);
      steps_.fetch(submission, std::span(&state, 1));
    });
    if (state.done != 0) break;
    submit([&](Submission& submission) { steps_.sort(submission); });
    host.waiting.take_sorted(host.next);
    compare_places(host, host.waiting, places, RoundBuffer::places, RoundBuffer::quanta);
    submit([&](Submission& submission) {
      steps_.draw(submission);
      steps_.fetch(submission, std::span(&state, 1));
    });
    compare_draw(host, state, places);
    if (testing::Test::HasFailure()) return TraceOutcome::stopped;  // what follows could be anything
    submit([&](Submission& submission) { steps_.weigh(submission); });
    compare_weights(host, places);
    host.next.clear(host.columns);
    const PacketStarts starts(order.scene.model.canopy, host.waiting, host.draw, order.scene.frame,
                              shared::random_words(order.block.key, shared::word_of_starts, state.rounds));
    for (std::uint32_t first = 0; first < state.packets; first += at_a_time_) {
      const shared::RoundPush part{first, std::min(at_a_time_, state.packets - first)};
      submit([&](Submission& submission) { steps_.start(submission, part); });
      compare_starts(starts, part);
      landings_ = follow(*this, order.scene.block, packets_);
      upload(context_, steps_.buffer(RoundBuffer::landings), std::as_bytes(std::span(landings_)));
      submit([&](Submission& submission) { steps_.book(submission, part); });
      book(host, state, part);
    }
    places = state.packets;
    ++rounds_;
  }
  steps_.fetch(passes);
  const RoundsSums& sums = *pass.sums;
  EXPECT_EQ(sums.first_places, first_places);
  EXPECT_TRUE(sums.side_landed == host.side_landed);
  EXPECT_TRUE(sums.cell_landed == host.cell_landed);
  EXPECT_TRUE(sums.plane_cells == host.plane_cells);
  EXPECT_TRUE(sums.element_hits == host.element_hits);
  return TraceOutcome::finished;
}

// The host drops places that keep nothing; on the device they stay, without quanta.
void StageCheck::compare_places(const Host& host, const WaitingFlux& expected, std::uint32_t count, RoundBuffer places,
                                RoundBuffer quanta) {
  const std::size_t width = host.columns.count;
  const auto found = fetch<EmissionPoint>(places, count);
  const auto rows = fetch<std::int64_t>(quanta, count * width);
  kept_.clear();
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto row = rows.begin() + static_cast<std::ptrdiff_t>(k * width);
    if (std::any_of(row, row + static_cast<std::ptrdiff_t>(width), [](std::int64_t q) { return q != 0; })) kept_.push_back(k);
  }
  ASSERT_EQ(kept_.size(), expected.size());
  std::size_t apart = 0;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const std::span<const std::int64_t> row = std::span(rows).subspan(kept_[k] * width, width);
    const bool same_row = std::equal(row.begin(), row.end(), expected.quanta(k, host.columns).begin());
    apart += same_row && same_bytes(found[kept_[k]], expected.place(k)) ? 0 : 1;
  }
  EXPECT_EQ(apart, 0U) << "of " << kept_.size() << " places";
}

void StageCheck::compare_draw(Host& host, const shared::RoundState& state, std::uint32_t places) {
  std::vector<std::int64_t> totals;
  for (const auto& column : fetch<shared::RoundColumn>(RoundBuffer::columns, host.columns.count)) {
    totals.push_back(static_cast<std::int64_t>(column.total));
  }
  host.draw.draw(host.waiting, host.columns, totals, state.offset);
  EXPECT_EQ(state.packets, host.draw.packets());
  const auto sums = fetch<std::uint64_t>(RoundBuffer::sums, 2 * std::size_t{places});
  std::size_t apart = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      apart += sums[side * places + kept_[k]] == host.arrays.up_to[side * kept_.size() + k] ? 0 : 1;
    }
  }
  EXPECT_EQ(apart, 0U) << "of " << 2 * kept_.size() << " sums";
}

void StageCheck::compare_weights(Host& host, std::uint32_t places) {
  const std::size_t packets = host.draw.packets();
  const std::size_t width = host.columns.count;
  const auto numbers = fetch<std::uint32_t>(RoundBuffer::numbers, packets);
  const auto weights = fetch<std::uint32_t>(RoundBuffer::weights, packets * width);
  const auto columns = fetch<shared::RoundColumn>(RoundBuffer::columns, width);
  std::vector<std::uint32_t> host_number(places);
  for (std::uint32_t k = 0; k < kept_.size(); ++k) host_number[kept_[k]] = k;
  std::vector<std::int64_t> carried(width);
  std::size_t apart = 0;
  for (std::size_t p = 0; p < packets; ++p) {
    const PacketSource from = host.draw.source(p);
    const std::span<const std::uint32_t> own = std::span(weights).subspan(p * width, width);
    host.draw.carry(p, carried);
    bool same = host_number[numbers[p] / 2] == from.place && numbers[p] % 2 == from.side;
    for (std::size_t c = 0; c < width; ++c) {
      same = same && own[c] == host.arrays.weight[p * width + c];
      same = same && shared::carried(own[c], shared::column_load(columns[c])) == static_cast<std::uint64_t>(carried[c]);
    }
    apart += same ? 0 : 1;
  }
  EXPECT_EQ(apart, 0U) << "of " << packets << " packets";
}

void StageCheck::compare_starts(const PacketStarts& starts, shared::RoundPush part) {
  packets_.resize(part.count);
  starts.write(part.first, packets_);
  const auto found = fetch<shared::Packet>(RoundBuffer::packets, part.count);
  std::size_t apart = 0;
  for (std::size_t k = 0; k < part.count; ++k) apart += same_bytes(found[k], packets_[k]) ? 0 : 1;
  EXPECT_EQ(apart, 0U) << "of " << part.count << " packets";
  auto order = fetch<std::uint32_t>(RoundBuffer::order, part.count + 1);
  EXPECT_EQ(order.front(), part.count);
  order.erase(order.begin());
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> all(part.count);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_TRUE(order == all);
}

void StageCheck::book(Host& host, const shared::RoundState& state, shared::RoundPush part) {
  const std::size_t width = host.columns.count;
  std::vector<std::int64_t> carried(width);
  const auto add = [&](std::vector<std::int64_t>& sums, std::size_t place) {
    for (std::size_t c = 0; c < width; ++c) sums[place * width + c] += carried[c];
  };
  for (std::uint32_t k = 0; k < part.count; ++k) {
    const std::uint32_t packet = part.first + k;
    const EmissionPoint& source = host.waiting.place(host.draw.source(packet).place);
    const std::uint32_t u = shared::random_words(host.order.block.key, packet, state.rounds).x;
    const Arrival arrival = arrival_from(host.order.scene, source, packets_[k], landings_[k], u);
    const EmissionPoint& place = arrival.place;
    host.draw.carry(packet, carried);
    for (std::uint32_t plane = arrival.to_zone; plane < arrival.from_zone; ++plane) {
      const std::uint32_t cell = host.order.scene.receivers->cell_at(plane, packets_[k].origin, packets_[k].direction);
      if (cell != shared::no_cell && place.surface != shared::lost_on_its_way) add(host.plane_cells, cell);
    }
    if (place.surface > shared::landed_on_ground) continue;
    if (place.surface == shared::landed_on_ground) {
      add(host.cell_landed, place.order - ground_order);
    } else {
      add(host.side_landed, place.surface);
      if (!host.element_hits.empty()) ++host.element_hits[place.surface / 2];
    }
    const std::vector<std::uint64_t>& scattered = host.scattering.face(place.face).scattered;
    bool any = false;
    for (std::size_t c = 0; c < width; ++c) any = any || part_of(carried[c], scattered[c], place.u) != 0;
    if (any) host.next.add(place, carried);
  }
}

}  // namespace sunfleck::test
