#include "physics/transport/indirect/indirect.h"

#include "base/in_blocks.h"
#include "base/random.h"
#include "physics/transport/indirect/device_rounds.h"
#include "physics/transport/indirect/landing_places.h"
#include "physics/transport/indirect/landing_points.h"
#include "physics/transport/indirect/packet_books.h"
#include "physics/transport/indirect/packet_draw.h"
#include "physics/transport/indirect/packet_starts.h"
#include "physics/transport/model/columns.h"
#include "shared/random.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace sunfleck {
namespace {

// The stop rule leaves this part of the bound unshot, relative to flux taken as at least 1 % of the incident flux.
constexpr double unshot_part_of_bound = 0.1;
constexpr double least_judged_share = 0.01;
// Ends passes that would never end on their own, as in a closed box of perfect mirrors.
constexpr std::uint64_t most_rounds = 20000;
// First stream of random numbers, apart from those of the beam.
constexpr std::uint64_t indirect_stream = std::uint64_t{1} << 48U;
// Where lights share the packets, points where beams landed, per packet of the first round. A ray towards each sun goes out from
// every point. Scaling a column to its exact total is a ratio estimate, whose bias falls as 1 / landings; the second number is the
// least for each light.
constexpr double shared_landings_per_packet = 0.25;
constexpr double least_shared_landings = 64;
// Quanta of a sampled landing are cut off here, far above all that a replicate has.
constexpr auto most_at_point = static_cast<double>(shared::most_at_point);

// Rays and packets are booked in batches of which all that is read several times stays in a processor's own cache.
constexpr std::size_t most_in_batch = 8192;
constexpr std::size_t least_batch = 256;
constexpr std::size_t most_carried_in_batch = std::size_t{1} << 17U;
// Packets whose arrivals a thread finds at a time.
constexpr std::size_t arrivals_per_block = 512;

// Returns a coefficient (shaders/shared/quanta.h), rounded up.
std::uint64_t coefficient_above(double part) {
  return static_cast<std::uint64_t>(std::ceil(std::min(part, 1.0) * 0x1p32));
}

// Returns a number of quanta that may be infinite.
std::int64_t whole_quanta(double quanta) {
  return quanta < 0x1p62 ? static_cast<std::int64_t>(quanta) : std::int64_t{1} << 62U;
}

// The pass of one replicate, with the flux that is still on its way. Random numbers of rounds and packets are functions of the key, the
// round and the packet (shaders/shared/random.h); the first landings are round 0.
class IndirectPass {
 public:
  IndirectPass(const IndirectScene& scene, const ReplicateOrder& order, const LightFromAbove& light, PassArrays& arrays,
               const StopQuestion& stop)
      : scene_(scene),
        order_(order),
        light_(light),
        stop_(stop),
        lights_(scene.lights.size()),
        bands_(scene.model.bands.size()),
        columns_(lights_ * bands_),
        random_(order.seed, indirect_stream + order.number),
        key_(key_of(random_.word())),
        books_(scene, order.counts_hits),
        arrays_(arrays),
        waiting_(arrays.waiting),
        next_(arrays.next),
        incident_(columns_),
        active_(columns_, true) {
    PlaceSums& sides = books_.sums().side_landed;
    sides = PlaceSums(2 * scene.model.canopy.size(), columns_, arrays.sides_landed);
    next_.clear(books_.booked());
    for (std::size_t b = 0; b < bands_; ++b) {
      for (std::size_t k = 0; k < lights_; ++k) quanta_.push_back(&(*light.quanta[k])[b]);
    }
  }

  std::optional<IndirectSums> run() {
    if (!let_sky_in()) return std::nullopt;
    add_lamps();
    const std::vector<std::int64_t> scattered = let_first_landings_wait();
    std::optional<TraceOutcome> outcome = start_on_device(scattered);
    IndirectSums& sums = books_.sums();
    if (!outcome) {
      if (!sample_landings(scene_, light_, wanted_landings(), random_, stop_, arrays_)) return std::nullopt;
      add_points(arrays_.points, scattered);
      sums.first_places = next_.size();
      if (light_.first.front().kept == nullptr) outcome = make_rounds_on_device({}, {});
      if (!outcome) outcome = make_rounds();
    }
    if (*outcome == TraceOutcome::stopped) return std::nullopt;
    books_.close();
    arrays_.sides_landed = sums.side_landed.extent();
    return std::move(sums);
  }

 private:
  // Makes all rounds on the host.
  [[nodiscard]] TraceOutcome make_rounds() {
    const std::optional<PlaceAim> aim = light_.aim != nullptr ? std::optional<PlaceAim>({scene_, *light_.aim}) : std::nullopt;
    PacketDraw draw(books_.scattering(), aim ? &*aim : nullptr, order_.packets, books_.waiting(), arrays_.draw);
    while (retire_faint_columns() && books_.sums().rounds < most_rounds) {
      if (!shoot(draw)) return TraceOutcome::stopped;
    }
    return TraceOutcome::finished;
  }

  // Makes all rounds where the tracer works, starting from a sample of the landings that it has kept: the one that sample_landings()
  // would take. Does nothing and returns nothing if no landings are kept, or if the tracer cannot make the rounds.
  [[nodiscard]] std::optional<TraceOutcome> start_on_device(std::span<const std::int64_t> scattered) {
    const FirstLandings& first = light_.first.front();
    if (first.kept == nullptr) return std::nullopt;
    RandomStream random = random_;
    return make_rounds_on_device(sample_of(first.beam.front(), wanted_landings(), random), scattered);
  }

  // Lets the tracer make all rounds where it works, if it can; see Tracer::make_rounds. Packets also start from a sample of kept landings,
  // which scatter `scattered` in all, [column]; both are empty if none are kept.
  [[nodiscard]] std::optional<TraceOutcome> make_rounds_on_device(const shared::BeamSample& sample,
                                                                  std::span<const std::int64_t> scattered) {
    if (light_.aim != nullptr || !suits_device(scene_)) return std::nullopt;
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
    return block;
  }

  [[nodiscard]] std::vector<shared::RoundColumn> round_columns(std::span<const std::int64_t> from_beam) const {
    const std::vector<std::int64_t> waiting = books_.waiting();
    std::vector<shared::RoundColumn> all(columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      all[c].start = static_cast<std::uint64_t>(waiting[c]);
      all[c].incident = static_cast<std::uint64_t>(incident_[c]);
      all[c].least_of_vegetation = static_cast<std::uint64_t>(whole_quanta(first(c).least_of_vegetation[band(c)]));
      all[c].is_active = 1;
      if (!from_beam.empty()) all[c].from_beam = static_cast<std::uint64_t>(from_beam[c]);
    }
    return all;
  }

  [[nodiscard]] std::size_t band(std::size_t column) const { return column / lights_; }
  // Returns what the direct pass found in the light of a column.
  [[nodiscard]] const FirstLandings& first(std::size_t column) const { return light_.first[column % lights_]; }

  [[nodiscard]] glm::uvec4 words_of(std::size_t number) const {
    return shared::random_words(key_, static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(books_.sums().rounds));
  }

  // Returns how many landings of beam rays packets start from.
  [[nodiscard]] double wanted_landings() const {
    const double most = std::min(order_.packets, order_.sampled_rays);
    if (lights_ == 1) return most;
    return std::max(shared_landings_per_packet * most, least_shared_landings * static_cast<double>(lights_));
  }

  // Sends the sky rays, each with its share of the skies' flux, and leaves the scattered flux waiting. Returns false if
  // stopped.
  [[nodiscard]] bool let_sky_in() {
    for (std::size_t c = 0; c < columns_; ++c) {
      incident_[c] = quanta_[c]->per_ray * static_cast<std::int64_t>(first(c).met) + quanta_[c]->lamps;
      books_.sums().ledger[c].incident += quanta_[c]->lamps;
    }
    if (light_.sky == nullptr) return true;
    const std::vector<shared::Packet> rays = light_.sky->draw(order_.sky_rays, random_);
    std::vector<shared::Landing> landings(rays.size());
    if (scene_.tracer.trace(scene_.block, rays, landings, stop_) == TraceOutcome::stopped) return false;
    SkyShares shares(*light_.sky, rays);
    std::vector<std::int64_t> given(columns_);
    for_each_batch(rays.size(), [&](std::size_t first, std::span<Arrival> arrivals) {
      find_arrivals(std::span(landings).subspan(first), arrivals, [&](std::size_t k) {
        return arrival_from_above(scene_, rays[first + k], landings[first + k], words_of(first + k).x);
      });
      for (std::size_t k = 0; k < arrivals.size(); ++k) {
        const std::span<std::int64_t> own = std::span(arrays_.carried).subspan(k * columns_, columns_);
        const std::span<const double> up_to_ray = shares.next();
        for (std::size_t c = 0; c < columns_; ++c) {
          const auto up_to = static_cast<std::int64_t>(up_to_ray[c % lights_] * static_cast<double>(quanta_[c]->sky));
          own[c] = up_to - std::exchange(given[c], up_to);
          if (arrivals[k].beside_plot) continue;
          incident_[c] += own[c];
          books_.sums().ledger[c].incident += own[c];
        }
      }
      book(std::span(rays).subspan(first), arrivals);
    });
    IndirectSums& sums = books_.sums();
    sums.side_sky = sums.side_landed;
    sums.cell_sky = sums.cell_landed;
    sums.sky_rays = rays.size();
    return true;
  }

  // Calls take(first, arrivals) for batches of `count` rays. There is room for what arrivals carry in arrays_.carried.
  template <class Take>
  void for_each_batch(std::size_t count, const Take& take) {
    const std::size_t width = books_.booked().count;
    const std::size_t most = std::clamp(most_carried_in_batch / width, least_batch, most_in_batch);
    for (std::size_t first = 0; first < count; first += most) {
      arrays_.arrivals.resize(std::min(most, count - first));
      arrays_.carried.resize(arrays_.arrivals.size() * width);
      take(first, std::span(arrays_.arrivals));
    }
  }

  // Calls take(place, weights) for each side on which beams land at the points; [light], 0 for those that land on the other side.
  template <class Take>
  void for_each_landing(const LandingPoints& points, const Take& take) const {
    std::vector<double> weights(lights_);
    for (std::size_t p = 0; p < points.places.size(); ++p) {
      const EmissionPoint& point = points.places[p];
      for (const double sign : {1.0, -1.0}) {
        bool any = false;
        for (std::size_t k = 0; k < lights_; ++k) {
          weights[k] = std::max(0.0, sign * points.weights[p * lights_ + k]);
          any = any || weights[k] > 0.0;
        }
        if (!any) continue;
        EmissionPoint place = point;
        if (sign < 0.0) {  // faces are numbered side by side, as sides are
          place.surface ^= 1U;
          place.face ^= 1U;
        }
        place.u = random_bits(point);
        take(place, weights);
      }
    }
  }

  // Returns the random bits by which the quanta at a sampled point split.
  [[nodiscard]] std::uint32_t random_bits(const EmissionPoint& point) const {
    return words_of(books_.sums().sky_rays + point.u).x;
  }

  // Lets the flux scattered by all beam rays wait, where it is known to be; returns it for each column.
  std::vector<std::int64_t> let_first_landings_wait() {
    std::vector<std::int64_t> scattered(columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      const FirstLandings& landings = first(c);
      for (std::size_t k = band(c); k < landings.scattered.size(); k += bands_) {
        scattered[c] += landings.scattered[k];
        books_.add_waiting(k / bands_, c, landings.scattered[k]);
      }
      for (std::size_t k = band(c); k < landings.scattered_by_zone.size(); k += bands_) {
        books_.add_waiting_in_zone(k / bands_, c, landings.scattered_by_zone[k]);
      }
    }
    return scattered;
  }

  // Adds the sampled points, of which packets are to carry what is scattered in all.
  void add_points(const LandingPoints& points, std::span<const std::int64_t> scattered) {
    next_.reserve(next_.size() + points.places.size());
    if (points.weights.empty()) return add_equal_points(points.places, scattered);
    add_weighted_points(points, scattered);
  }

  // A device does the same with landings that it keeps (shaders/rounds/first_sum.comp and its neighbours).
  void add_equal_points(std::span<const EmissionPoint> points, std::span<const std::int64_t> scattered) {
    std::vector<std::uint64_t> coefficients(columns_);
    for (const EmissionPoint& point : points) {
      const FaceColumns& face = books_.scattering().face(point.face);
      for (std::size_t c = 0; c < columns_; ++c) coefficients[c] += face.scattered[c];
    }
    std::vector<std::int64_t> own(columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      own[c] = static_cast<std::int64_t>(shared::quanta_at_point(static_cast<std::uint64_t>(scattered[c]), coefficients[c]));
    }
    for (EmissionPoint point : points) {
      point.u = random_bits(point);
      next_.add(point, own);
    }
  }

  void add_weighted_points(const LandingPoints& points, std::span<const std::int64_t> scattered) {
    std::vector<std::int64_t> own(columns_);
    std::vector<double> sent(columns_), scale(columns_);  // by all points for a weight of one, and quanta for it
    for_each_landing(points, [&](const EmissionPoint& place, std::span<const double> weights) {
      const FaceColumns& face = books_.scattering().face(place.face);
      for (std::size_t c = 0; c < columns_; ++c) {
        sent[c] += weights[c % lights_] * static_cast<double>(face.scattered[c]) * 0x1p-32;
      }
    });
    for (std::size_t c = 0; c < columns_; ++c) scale[c] = sent[c] > 0.0 ? static_cast<double>(scattered[c]) / sent[c] : 0.0;
    for_each_landing(points, [&](const EmissionPoint& place, std::span<const double> weights) {
      for (std::size_t c = 0; c < columns_; ++c) {
        own[c] = static_cast<std::int64_t>(std::min(most_at_point, weights[c % lights_] * scale[c] + 0.5));
      }
      next_.add(place, own);
    });
  }

  // Adds the flux that the lamps emit; its packets start anywhere on them.
  void add_lamps() {
    const auto has_lamps = [](const BandQuanta* quanta) { return !quanta->lamp.empty(); };
    if (std::none_of(quanta_.begin(), quanta_.end(), has_lamps)) return;
    std::vector<std::int64_t> own(columns_);
    for (std::size_t e = 0; e < scene_.model.canopy.size(); ++e) {
      EmissionPoint place;
      place.surface = static_cast<std::uint32_t>(2 * e);
      place.order = static_cast<std::uint32_t>(e);
      place.a = anywhere;
      place.face = lamp_face(scene_.model);
      if (scene_.surfaces.at(e).soil()) place.level = -1;
      for (std::size_t c = 0; c < columns_; ++c) {
        own[c] = has_lamps(quanta_[c]) ? quanta_[c]->lamp[e] : 0;
        if (own[c] == 0) continue;
        books_.add_waiting(level_index(place.level), c, own[c]);
        if (scene_.receivers != nullptr) books_.add_waiting_in_zone(zone_of(scene_, place), c, own[c]);
      }
      next_.add(place, own);
    }
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
    for_each_batch(arrays_.packets.size(), [&](std::size_t first, std::span<Arrival> arrivals) {
      find_arrivals(std::span(arrays_.landings).subspan(first), arrivals, [&](std::size_t k) {
        const std::size_t packet = first_packet + first + k;
        draw.carry(packet, std::span(arrays_.carried).subspan(k * width, width));
        return arrival_from(scene_, waiting_.place(draw.source(packet).place), arrays_.packets[first + k],
                            arrays_.landings[first + k], words_of(packet).x);
      });
      book(std::span(arrays_.packets).subspan(first), arrivals);
    });
  }

  // Sets each arrival to find(k). The threads of the run share the work.
  template <class Find>
  void find_arrivals(std::span<const shared::Landing> landings, std::span<Arrival> arrivals, const Find& find) const {
    each_in_blocks(
        arrivals.size(), arrivals_per_block, [&](std::size_t k) { prefetch_place_of(scene_, landings[k]); },
        [&](std::size_t k) { arrivals[k] = find(k); });
  }

  // Books the first rays, as many as there are arrivals; arrays_.carried holds what they carry.
  void book(std::span<const shared::Packet> rays, std::span<const Arrival> arrivals) {
    books_.book({rays.first(arrivals.size()), arrivals, arrays_.carried}, next_);
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
      const std::int64_t vegetation =
          std::max(whole_quanta(first(c).least_of_vegetation[band(c)]), books_.scattering().vegetation()[c]);
      const std::int64_t least = part_of(incident_[c], least_judged(), 0);
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
  std::size_t lights_, bands_, columns_;
  std::vector<const BandQuanta*> quanta_;  // [column]
  RandomStream random_;                    // for sky rays and the sample of beam rays
  glm::uvec2 key_;
  PacketBooks books_;
  PassArrays& arrays_;
  WaitingFlux &waiting_, &next_;        // from which packets are drawn, and where they land
  std::vector<std::int64_t> incident_;  // [column], flux that met something, lamps included
  std::vector<bool> active_;            // [column], not retired
};

}  // namespace

std::optional<IndirectSums> run_indirect_pass(const IndirectScene& scene, const ReplicateOrder& order,
                                              const LightFromAbove& light, PassArrays& arrays, const StopQuestion& stop) {
  return IndirectPass(scene, order, light, arrays, stop).run();
}

}  // namespace sunfleck
