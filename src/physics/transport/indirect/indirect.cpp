#include "physics/transport/indirect/indirect.h"

#include "base/random.h"
#include "physics/transport/indirect/arrival_batches.h"
#include "physics/transport/indirect/device_rounds.h"
#include "physics/transport/indirect/first_flux.h"
#include "physics/transport/indirect/landing_points.h"
#include "physics/transport/indirect/packet_books.h"
#include "physics/transport/indirect/packet_draw.h"
#include "physics/transport/indirect/packet_starts.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/columns.h"
#include "shared/random.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sunfleck {
namespace {

// The stop rule leaves this part of the bound unshot, relative to flux taken as at least 1 % of the incident flux.
constexpr double unshot_part_of_bound = 0.1;
// Ends passes that would never end on their own, as in a closed box of perfect mirrors.
constexpr std::uint64_t most_rounds = 20000;
// First stream of random numbers, apart from those of the beam.
constexpr std::uint64_t indirect_stream = std::uint64_t{1} << 48U;
// Where lights share the packets, points where beams landed, per packet of the first round. A ray towards each sun goes out from
// every point. Scaling a column to its exact total is a ratio estimate, whose bias falls as 1 / landings; the second number is
// the least for each light.
constexpr double shared_landings_per_packet = 0.25;
constexpr double least_shared_landings = 64;

// Returns a coefficient (shaders/shared/quanta.h), rounded up.
std::uint64_t coefficient_above(double part) {
  return static_cast<std::uint64_t>(std::ceil(std::min(part, 1.0) * 0x1p32));
}

// The pass of one replicate, with the flux that is still on its way. Random numbers of rounds and packets are functions of the
// key, the round and the packet (shaders/shared/random.h); the first landings are round 0.
class IndirectPass {
 public:
  IndirectPass(const IndirectScene& scene, const ReplicateOrder& order, const LightFromAbove& light, PassArrays& arrays,
               const StopQuestion& stop)
      : scene_(scene),
        order_(order),
        light_(light),
        stop_(stop),
        lights_(scene.lights.size()),
        columns_(lights_ * scene.model.bands.size()),
        random_(order.seed, indirect_stream + order.number),
        key_(key_of(random_.word())),
        books_(scene, order.counts_hits),
        arrays_(arrays),
        waiting_(arrays.waiting),
        next_(arrays.next),
        first_flux_(scene, light, key_, books_, arrays),
        active_(columns_, true) {
    IndirectSums& sums = books_.sums();
    sums.side_landed = PlaceSums(2 * scene.model.canopy.size(), columns_, arrays.sides_landed, arrays.memory);
    sums.cell_landed = PlaceSums(scene.layout.cells(), columns_, arrays.cells_landed, arrays.memory);
    next_.clear(books_.booked());
  }

  std::optional<IndirectSums> run() {
    if (!first_flux_.let_sky_in(order_.sky_rays, random_, stop_)) return std::nullopt;
    IndirectSums& sums = books_.sums();
    for (std::size_t c = 0; c < columns_; ++c) sums.sky_landed[c] = landed(sums.ledger[c]);
    first_flux_.add_lamps();
    const std::vector<std::int64_t> scattered = first_flux_.add_landings();
    sums.first_waiting = books_.waiting();
    std::optional<TraceOutcome> outcome = start_on_device(scattered);
    if (!outcome) {
      if (!sample_landings(scene_, light_, wanted_landings(), random_, stop_, arrays_)) return std::nullopt;
      first_flux_.add_points(arrays_.points, scattered);
      sums.first_places = next_.size();
      if (light_.first.front().kept == nullptr) outcome = make_rounds_on_device({}, {});
      if (!outcome) outcome = make_rounds();
    }
    if (*outcome == TraceOutcome::stopped) return std::nullopt;
    books_.close();
    arrays_.sides_landed = sums.side_landed.extent();
    arrays_.cells_landed = sums.cell_landed.extent();
    return std::move(sums);
  }

 private:
  // Returns what has landed of the light that came in.
  [[nodiscard]] static std::int64_t landed(const FluxLedger& ledger) {
    return ledger.incident - ledger.reflected - ledger.transmitted - ledger.unshot;
  }

  // Makes all rounds on the host.
  [[nodiscard]] TraceOutcome make_rounds() {
    std::optional<PlaceAim> aim;
    if (light_.aim != nullptr) aim.emplace(scene_, light_.aim->sphere());
    PacketDraw draw(books_.scattering(), aim ? &*aim : nullptr, order_.packets, books_.waiting(), arrays_.draw);
    while (retire_faint_columns() && books_.sums().rounds < most_rounds) {
      if (!shoot(draw)) return TraceOutcome::stopped;
    }
    return TraceOutcome::finished;
  }

  // Makes all rounds where the tracer works, starting from a sample of the landings that it has kept: the one that
  // sample_landings() would take. Does nothing and returns nothing if no landings are kept, or if the tracer cannot make the
  // rounds.
  [[nodiscard]] std::optional<TraceOutcome> start_on_device(std::span<const std::int64_t> scattered) {
    const FirstLandings& first = light_.first.front();
    if (first.kept == nullptr) return std::nullopt;
    RandomStream random = random_;
    return make_rounds_on_device(sample_of(first.beam.front(), wanted_landings(), random), scattered);
  }

  // Lets the tracer make all rounds where it works, if it can; see Tracer::make_rounds. Packets also start from a sample of
  // kept landings, which scatter `scattered` in all, [column]; both are empty if none are kept.
  [[nodiscard]] std::optional<TraceOutcome> make_rounds_on_device(const shared::BeamSample& sample,
                                                                  std::span<const std::int64_t> scattered) {
    shared::PassBlock block = pass_block();
    block.sampled = sample;
    const RoundsOrder order{scene_,
                            next_,
                            sample.count > 0 ? light_.first.front().kept : nullptr,
                            block,
                            order_.packets,
                            coefficients_of(books_.scattering()),
                            round_columns(scattered),
                            books_.for_rounds(block)};
    const RoundsPass pass{&order, &arrays_.found};
    const std::optional<TraceOutcome> outcome = scene_.tracer.make_rounds(std::span(&pass, 1), stop_);
    if (outcome == TraceOutcome::finished) books_.add_rounds(order.block, arrays_.found);
    return outcome;
  }

  [[nodiscard]] shared::PassBlock pass_block() const {
    shared::PassBlock block = block_of(scene_);
    block.each = PacketDraw::packets_for_each(order_.packets, books_.waiting());
    block.unshot_part = unshot_part();
    block.least_judged = least_judged();
    block.key = key_;
    block.counts_hits = order_.counts_hits ? 1 : 0;
    block.sample_word = static_cast<std::uint32_t>(books_.sums().sky_rays);
    block.most_rounds = static_cast<std::uint32_t>(most_rounds);
    if (light_.aim != nullptr) block.stand = light_.aim->sphere();
    return block;
  }

  [[nodiscard]] std::vector<shared::RoundColumn> round_columns(std::span<const std::int64_t> from_beam) const {
    const std::vector<std::int64_t> waiting = books_.waiting();
    std::vector<shared::RoundColumn> all(columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      all[c].start = static_cast<std::uint64_t>(waiting[c]);
      all[c].incident = static_cast<std::uint64_t>(first_flux_.incident()[c]);
      all[c].least_of_vegetation = static_cast<std::uint64_t>(first_flux_.least_of_vegetation(c));
      all[c].is_active = 1;
      if (!from_beam.empty()) all[c].from_beam = static_cast<std::uint64_t>(from_beam[c]);
    }
    return all;
  }

  [[nodiscard]] glm::uvec4 words_of(std::size_t number) const {
    return shared::random_words(key_, static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(books_.sums().rounds));
  }

  // Returns how many landings of beam rays packets start from.
  [[nodiscard]] double wanted_landings() const {
    const double most = std::min(order_.packets, order_.sampled_rays);
    if (lights_ == 1) return most;
    return std::max(shared_landings_per_packet * most, least_shared_landings * static_cast<double>(lights_));
  }

  // Draws packets from the waiting flux, traces them and leaves what they scatter waiting. Returns false if stopped.
  [[nodiscard]] bool shoot(PacketDraw& draw) {
    IndirectSums& sums = books_.sums();
    ++sums.rounds;
    waiting_.take_sorted(next_);
    const glm::uvec4 offset = words_of(shared::word_of_offset);
    draw.draw(waiting_, books_.booked(), books_.waiting(), std::uint64_t{offset.y} << 32U | offset.x);
    for (std::size_t c = 0; c < columns_; ++c) {
      if (active_[c] && !draw.carries(c)) retire(c);
    }
    const PacketStarts starts(scene_.model.canopy, waiting_, draw, scene_.frame, words_of(shared::word_of_starts));
    next_.clear(books_.booked());
    next_.reserve(draw.packets());
    books_.begin_round();
    for (std::size_t first = 0; first < draw.packets(); first += most_at_a_time) {
      arrays_.packets.resize(std::min(most_at_a_time, draw.packets() - first));
      starts.write(first, arrays_.packets);
      if (!trace_packets()) return false;
      book_packets(draw, first);
    }
    books_.end_round();
    sums.most_places = std::max<std::uint64_t>(sums.most_places, next_.size());
    sums.packets += draw.packets();
    return true;
  }

  // Traces arrays_.packets. Returns false if stopped.
  [[nodiscard]] bool trace_packets() {
    arrays_.landings.resize(arrays_.packets.size());
    return scene_.tracer.trace(scene_.block, arrays_.packets, arrays_.landings, stop_) != TraceOutcome::stopped;
  }

  // Books arrays_.packets, which begin with number `first_packet`.
  void book_packets(const PacketDraw& draw, std::size_t first_packet) {
    const std::size_t width = books_.booked().count;
    for_each_batch(arrays_.packets.size(), width, arrays_, [&](std::size_t first, std::span<Arrival> arrivals) {
      find_arrivals(scene_, std::span(arrays_.landings).subspan(first), arrivals, [&](std::size_t k) {
        const std::size_t packet = first_packet + first + k;
        draw.carry(packet, std::span(arrays_.carried).subspan(k * width, width));
        return arrival_from(scene_, waiting_.place(draw.source(packet).place), arrays_.packets[first + k],
                            arrays_.landings[first + k], words_of(packet).x);
      });
      books_.book({std::span(arrays_.packets).subspan(first, arrivals.size()), arrivals, arrays_.carried}, next_);
    });
  }

  void retire(std::size_t column) {
    books_.retire(column);
    active_[column] = false;
  }

  [[nodiscard]] std::uint64_t unshot_part() const { return coefficient_above(unshot_part_of_bound * order_.bound); }
  [[nodiscard]] static std::uint64_t least_judged() { return coefficient_above(least_judged_share); }

  // Ends the columns with too little flux left to matter. Returns false if none is left.
  [[nodiscard]] bool retire_faint_columns() {
    const std::vector<std::int64_t> waiting = books_.waiting();
    const std::uint64_t part = unshot_part();
    std::size_t begin = columns_, end = 0;
    for (std::size_t c = 0; c < columns_; ++c) {
      if (!active_[c]) continue;
      const std::int64_t vegetation = std::max(first_flux_.least_of_vegetation(c), books_.scattering().vegetation()[c]);
      const std::int64_t least = part_of(first_flux_.incident()[c], least_judged(), 0);
      const std::int64_t judged = std::min(vegetation, std::max(least, books_.scattering().soil()[c]));
      if (waiting[c] == 0 || waiting[c] < part_of(judged, part, 0)) {
        retire(c);
        continue;
      }
      begin = std::min(begin, c);
      end = c + 1;
    }
    if (columns_ >= PlaceSums::least_indexed_width && begin < end) books_.book_only({begin, end - begin});
    return begin < end;
  }

  const IndirectScene& scene_;
  const ReplicateOrder& order_;
  const LightFromAbove& light_;
  const StopQuestion& stop_;
  std::size_t lights_, columns_;
  RandomStream random_;  // for sky rays and the sample of beam rays
  glm::uvec2 key_;
  PacketBooks books_;
  PassArrays& arrays_;
  WaitingFlux &waiting_, &next_;  // from which packets are drawn, and where they land
  FirstFlux first_flux_;
  std::vector<bool> active_;  // [column], not retired
};

}  // namespace

std::optional<IndirectSums> run_indirect_pass(const IndirectScene& scene, const ReplicateOrder& order,
                                              const LightFromAbove& light, PassArrays& arrays, const StopQuestion& stop) {
  return IndirectPass(scene, order, light, arrays, stop).run();
}

}  // namespace sunfleck
