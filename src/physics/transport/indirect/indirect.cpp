#include "physics/transport/indirect/indirect.h"

#include "base/random.h"
#include "physics/transport/receivers/plane_flux.h"
#include "shared/beam.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sunfleck {
namespace {

// Rounds are scaled up to at least this many packets.
constexpr double least_packets = 256;
// The stop rule leaves this part of the bound unshot, relative to flux taken as at least 1 % of the incident flux.
constexpr double unshot_part_of_bound = 0.1;
constexpr double least_judged_share = 0.01;
// Ends passes that would never end on their own, as in a closed box of perfect mirrors.
constexpr std::uint64_t most_rounds = 20000;
// First stream of random numbers, apart from those of the beam.
constexpr std::uint64_t indirect_stream = std::uint64_t{1} << 48U;
// Drawing order of the first ground cell: the ground comes after all elements, ordered by cells of its map.
constexpr std::uint32_t ground_order = 0x80000000U;

// The pass of one replicate, with the flux that is still on its way.
class IndirectPass {
 public:
  IndirectPass(const IndirectScene& scene, const ReplicateOrder& order, const FirstLandings& first,
               const std::vector<BandQuanta>& quanta, PassArrays& arrays, const StopQuestion& stop)
      : scene_(scene),
        order_(order),
        first_(first),
        quanta_(quanta),
        stop_(stop),
        random_(order.seed, indirect_stream + order.number),
        sums_(scene.model, scene.layout, scene.surfaces),
        arrays_(arrays),
        waiting_(arrays.waiting),
        next_(arrays.next),
        start_(quanta.size()),
        sky_(quanta.size()),
        layers_(static_cast<std::size_t>(scene.layout.layers.count) + 1, quanta.size()),
        receivers_(scene.receivers != nullptr ? scene.receivers->size() : 0, quanta.size()),
        reflected_(quanta.size()),
        transmitted_(quanta.size()) {
    if (scene.receivers != nullptr) sums_.receivers = PlaneSums(*scene.receivers, scene.model);
    arrays_.sources.clear();
    waiting_.clear();
    next_.clear();
  }

  std::optional<IndirectSums> run() {
    if (!let_sky_in()) return std::nullopt;
    for (std::size_t b = 0; b < start_.size(); ++b) {
      start_[b] = static_cast<double>(quanta_[b].lamps + waiting_.total(b));
      for (std::size_t k = b; k < first_.scattered.size(); k += start_.size()) {
        start_[b] += static_cast<double>(first_.scattered[k]);
      }
      sums_.ledger[b].incident += quanta_[b].lamps;
    }
    if (!sample_first_landings()) return std::nullopt;
    add_first_candidates();
    add_lamps();
    sums_.first_candidates = waiting_.size();
    retire_faint_bands();
    while (waiting_.size() > 0 && sums_.rounds < most_rounds) {
      if (!shoot()) return std::nullopt;
      retire_faint_bands();
    }
    for (std::size_t b = 0; b < start_.size(); ++b) sums_.ledger[b].unshot += waiting_.total(b);
    close_planes();
    return std::move(sums_);
  }

 private:
  // The start and the ray that lead to a landing.
  struct Way {
    EmissionPoint from;
    std::size_t from_zone = 0;
    const shared::Packet& packet;
  };

  // Sends the sky rays, each with its share of the sky's flux, and leaves the scattered flux waiting. Returns false if
  // stopped.
  [[nodiscard]] bool let_sky_in() {
    if (first_.sky == nullptr) return true;
    const std::size_t bands = start_.size();
    const std::vector<shared::Packet> rays = first_.sky->draw(order_.sky_rays, random_);
    std::vector<shared::Landing> landings(rays.size());
    if (scene_.tracer.trace(scene_.block, rays, landings, stop_) == TraceOutcome::stopped) return false;
    EmissionPoint above;
    above.surface = shared::left_upwards;
    above.level = scene_.layout.layers.count;
    std::vector<std::int64_t> given(bands), own(bands);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const double share = first_.sky->share_of_first(k + 1, rays.size());
      for (std::size_t b = 0; b < bands; ++b) {
        const auto up_to = static_cast<std::int64_t>(share * static_cast<double>(quanta_[b].sky));
        own[b] = up_to - given[b];
        given[b] = up_to;
      }
      const Way way = way_from(above, rays[k]);
      if (fell_beside_plot(landings[k], rays[k])) {
        pass_receivers(landings[k], way, own);
        continue;
      }
      for (std::size_t b = 0; b < bands; ++b) sky_[b] += own[b];
      land(landings[k], way, own);
    }
    for (std::size_t b = 0; b < bands; ++b) sums_.ledger[b].incident += sky_[b];
    sums_.side_sky = sums_.side_landed;
    sums_.cell_sky = sums_.cell_landed;
    sums_.sky_rays = rays.size();
    std::swap(waiting_, next_);
    return true;
  }

  // Returns true for a ray of an isolated stand that met neither an element nor the plot's ground. Its flux counts only at
  // the receivers that it passed.
  [[nodiscard]] bool fell_beside_plot(const shared::Landing& landing, const shared::Packet& ray) const {
    if (scene_.model.plot.periodic || landing.surface != shared::left_downwards) return false;
    return !shared::falls_on_plot(shared::make_ray(ray.origin, ray.direction), scene_.block.ground);
  }

  // Traces a systematic sample of the beam rays again to find the points where they landed: as many as there are packets or as the
  // order allows, half of them from the first of several parts, or every ray where there are no more. Returns false if stopped.
  [[nodiscard]] bool sample_first_landings() {
    const double most = std::min(order_.packets, order_.sampled_rays);
    double around = 0.0;
    for (std::size_t k = 1; k < first_.beam.size(); ++k) around += weighted_rays(first_.beam[k]);
    for (std::size_t k = 0; k < first_.beam.size(); ++k) {
      const double part = around == 0.0 ? 1.0 : k == 0 ? 0.5 : 0.5 * weighted_rays(first_.beam[k]) / around;
      if (!sample_landings(first_.beam[k], std::max(1.0, part * most))) return false;
    }
    return true;
  }

  [[nodiscard]] static double weighted_rays(const BeamPart& part) {
    return static_cast<double>(part.weight) * static_cast<double>(part.rays());
  }

  // Adds the sources of a sample of at most `most` rays of a part. Returns false if stopped.
  [[nodiscard]] bool sample_landings(const BeamPart& part, double most) {
    const auto count = static_cast<std::size_t>(std::min(most, static_cast<double>(part.rays())));
    const double stride = static_cast<double>(part.rays()) / static_cast<double>(count);
    const double rays_each = first_.beam.size() == 1 ? 1.0 : stride * part.weight;
    const double offset = random_.unit();
    for (std::size_t first = 0; first < count; first += most_at_a_time) {
      std::vector<shared::Packet>& rays = arrays_.packets;
      rays.resize(std::min(most_at_a_time, count - first));
      for (std::size_t k = 0; k < rays.size(); ++k) {
        const std::uint32_t ray = sampled_ray(first + k, offset, stride, part.rays());
        rays[k] = {shared::beam_origin(part.block, ray), shared::no_element, part.block.direction, 0};
      }
      if (!trace_packets()) return false;
      for (const shared::Landing& landing : arrays_.landings) add_sources(landing, rays_each);
    }
    return true;
  }

  // Traces arrays_.packets. Returns false if stopped.
  [[nodiscard]] bool trace_packets() {
    arrays_.landings.resize(arrays_.packets.size());
    return scene_.tracer.trace(scene_.block, arrays_.packets, arrays_.landings, stop_) != TraceOutcome::stopped;
  }

  // Adds the sides that light leaves where a sampled ray landed.
  void add_sources(const shared::Landing& landing, double rays_each) {
    const EmissionPoint place = place_of(landing);
    if (landing.surface == shared::landed_on_ground) arrays_.sources.push_back({place, false, rays_each, nullptr});
    if (landing.surface >= shared::landed_on_ground) return;
    const SurfaceOptics& optics = scene_.model.optics[scene_.model.canopy.optics_of[landing.surface / 2]];
    const auto* face = landing.surface % 2 == 0 ? &optics.upper : &optics.lower;
    EmissionPoint other = place;
    other.surface ^= 1U;
    arrays_.sources.push_back({place, false, rays_each, face});
    arrays_.sources.push_back({other, true, rays_each, face});
  }

  // Distributes the flux scattered by all beam rays over the sampled sources, band by band.
  void add_first_candidates() {
    const std::vector<BeamSource>& sources = arrays_.sources;
    const std::size_t bands = start_.size();
    const Soil* soil = scene_.model.soil ? &*scene_.model.soil : nullptr;
    std::vector<std::int64_t> scattered(bands), given(bands), own(bands);
    for (std::size_t k = 0; k < first_.scattered.size(); ++k) scattered[k % bands] += first_.scattered[k];
    std::vector<double> total(bands), sum(bands);
    for (const BeamSource& source : sources) {
      for (std::size_t b = 0; b < bands; ++b) total[b] += weight_of(source, soil, b);
    }
    for (std::size_t k = 0; k < first_.scattered.size(); ++k) layers_.move(k / bands, k % bands, -first_.scattered[k]);
    for (std::size_t k = 0; k < first_.scattered_by_zone.size(); ++k) {
      receivers_.move(k / bands, k % bands, -first_.scattered_by_zone[k]);
    }
    waiting_.reserve(waiting_.size() + sources.size());
    for (const BeamSource& source : sources) {
      for (std::size_t b = 0; b < bands; ++b) {
        own[b] = 0;
        const double weight = weight_of(source, soil, b);
        if (weight == 0.0) continue;
        sum[b] += weight;
        const auto up_to = static_cast<std::int64_t>(std::min(1.0, sum[b] / total[b]) * static_cast<double>(scattered[b]));
        own[b] = up_to - given[b];
        given[b] = up_to;
      }
      move(source.place, own);
      waiting_.add(source.place, own);
    }
    for (std::size_t b = 0; b < bands; ++b) sums_.ledger[b].unshot += scattered[b] - given[b];
  }

  [[nodiscard]] static double weight_of(const BeamSource& source, const Soil* soil, std::size_t band) {
    if (source.face == nullptr) return soil != nullptr ? source.rays * soil->reflectance[band] : 0.0;
    return source.rays * (source.transmitted ? (*source.face)[band].transmittance : (*source.face)[band].reflectance);
  }

  // Adds the flux that the lamps emit; its packets start anywhere on them.
  void add_lamps() {
    const std::size_t bands = start_.size();
    std::vector<std::int64_t> own(bands);
    for (std::size_t e = 0; e < scene_.model.canopy.size(); ++e) {
      for (std::size_t b = 0; b < bands; ++b) own[b] = quanta_[b].lamp.empty() ? 0 : quanta_[b].lamp[e];
      EmissionPoint place;
      place.surface = static_cast<std::uint32_t>(2 * e);
      place.order = static_cast<std::uint32_t>(e);
      place.a = anywhere;
      if (scene_.surfaces.at(e).soil()) place.level = -1;
      waiting_.add(place, own);
    }
  }

  // Draws packets from the waiting flux, traces them and leaves what they scatter waiting. Returns false if stopped.
  [[nodiscard]] bool shoot() {
    const std::size_t bands = start_.size();
    next_.take_sorted(waiting_, arrays_.sorting);
    std::swap(waiting_, next_);
    find_expected_draws();
    Draw& draw = arrays_.draw;
    draw_packets(waiting_, arrays_.expected, random_, draw);
    move_drawn(draw);
    const PacketStarts starts(scene_.model.canopy, waiting_, draw, scene_.frame, random_);
    const std::size_t count = draw.candidate.size();
    next_.clear();
    next_.reserve(2 * count);
    for (std::size_t first = 0; first < count; first += most_at_a_time) {
      arrays_.packets.resize(std::min(most_at_a_time, count - first));
      starts.write(first, arrays_.packets);
      if (!trace_packets()) return false;
      for (std::size_t p = 0; p < arrays_.packets.size(); ++p) {
        const Way way = way_from(waiting_.place(draw.candidate[first + p]), arrays_.packets[p]);
        land(arrays_.landings[p], way, std::span(draw.quanta).subspan((first + p) * bands, bands));
      }
    }
    if (std::find(draw.kept.begin(), draw.kept.end(), true) != draw.kept.end()) keep_undrawn(draw);
    std::swap(waiting_, next_);
    sums_.most_candidates = std::max<std::uint64_t>(sums_.most_candidates, waiting_.size());
    sums_.packets += count;
    ++sums_.rounds;
    return true;
  }

  // Finds how many packets are drawn from each candidate on average.
  void find_expected_draws() {
    const std::size_t bands = start_.size();
    double lit = 0.0;
    for (const double start : start_) lit += start > 0.0 ? 1.0 : 0.0;
    std::vector<double>& expected = arrays_.expected;
    expected.assign(waiting_.size(), 0.0);
    double total = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const auto quanta = waiting_.quanta(k);
      for (std::size_t b = 0; b < bands; ++b) {
        if (start_[b] > 0.0) expected[k] += static_cast<double>(quanta[b]) / start_[b];
      }
      expected[k] *= order_.packets / lit;
      total += expected[k];
    }
    if (first_.aim != nullptr) total = aim_draws(expected, total);
    if (total < least_packets && total > 0.0) {
      for (double& e : expected) e *= least_packets / total;
    }
  }

  // Draws more packets near the stand and fewer far away, as many as before in the first round. Returns the new total.
  double aim_draws(std::vector<double>& expected, double before) {
    double after = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      expected[k] *= packets_per_flux(waiting_.place(k)) * aimed_draws_;
      after += expected[k];
    }
    if (sums_.rounds > 0 || after == 0.0) return after;
    aimed_draws_ = before / after;
    for (double& e : expected) e *= aimed_draws_;
    return before;
  }

  [[nodiscard]] double packets_per_flux(const EmissionPoint& place) const {
    if (place.surface == shared::landed_on_ground)
      return first_.aim->packets_per_flux({place.a, scene_.frame.ground_y_m, place.b});
    const std::uint32_t element = place.surface / 2;
    if (!scene_.surfaces.at(element).soil()) return 1.0;
    const Triangle corners = scene_.model.canopy.corners[element];
    const double b = place.a == anywhere ? 1.0 / 3.0 : place.a;
    const double c = place.a == anywhere ? 1.0 / 3.0 : place.b;
    const glm::dvec3 corner(corners[0]);
    return first_.aim->packets_per_flux(corner + (glm::dvec3(corners[1]) - corner) * b + (glm::dvec3(corners[2]) - corner) * c);
  }

  // Books the flux that packets carry away and takes off the flux that waited, for the bands that are drawn.
  void move_drawn(const Draw& draw) {
    const std::size_t bands = start_.size();
    std::vector<std::int64_t> own(bands);
    const auto move_own = [&](const EmissionPoint& place, std::span<const std::int64_t> quanta, std::int64_t sign) {
      for (std::size_t b = 0; b < bands; ++b) own[b] = draw.kept[b] ? 0 : sign * quanta[b];
      move(place, own);
    };
    for (std::size_t k = 0; k < waiting_.size(); ++k) move_own(waiting_.place(k), waiting_.quanta(k), -1);
    for (std::size_t p = 0; p < draw.candidate.size(); ++p) {
      move_own(waiting_.place(draw.candidate[p]), std::span(draw.quanta).subspan(p * bands, bands), 1);
    }
  }

  // Books quanta that are shot from a place although they waited elsewhere.
  void move(const EmissionPoint& place, std::span<const std::int64_t> quanta) {
    const std::size_t zone = scene_.receivers != nullptr ? zone_of(place) : 0;
    for (std::size_t b = 0; b < quanta.size(); ++b) {
      layers_.move(level_index(place.level), b, quanta[b]);
      receivers_.move(zone, b, quanta[b]);
    }
  }

  // Leaves the flux that no packet carried in place for the next round.
  void keep_undrawn(const Draw& draw) {
    for (std::size_t b = 0; b < draw.kept.size(); ++b) {
      if (!draw.kept[b]) waiting_.retire(b);
    }
    for (std::size_t k = 0; k < waiting_.size(); ++k) next_.add(waiting_.place(k), waiting_.quanta(k));
  }

  // Ends the bands with too little flux left to matter.
  void retire_faint_bands() {
    bool any = false;
    for (std::size_t b = 0; b < start_.size(); ++b) {
      const std::int64_t unshot = waiting_.total(b);
      if (unshot == 0) continue;
      const double incident = static_cast<double>(quanta_[b].per_ray) * static_cast<double>(first_.met) +
                              static_cast<double>(quanta_[b].lamps + sky_[b]);
      const FluxLedger& ledger = sums_.ledger[b];
      const double vegetation = std::max(first_.least_of_vegetation[b], static_cast<double>(ledger.absorbed_vegetation));
      const double judged =
          std::min(vegetation, std::max(least_judged_share * incident, static_cast<double>(ledger.absorbed_soil)));
      if (static_cast<double>(unshot) < unshot_part_of_bound * order_.bound * judged) {
        sums_.ledger[b].unshot += unshot;
        waiting_.retire(b);
      } else {
        any = true;
      }
    }
    if (!any) waiting_.clear();
  }

  // Books what a ray or packet carries to its end.
  void land(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
    if (landing.surface < shared::landed_on_ground) return land_on_element(landing, way, quanta);
    if (landing.surface == shared::landed_on_ground) return land_on_soil(landing, way, quanta);
    for (std::size_t b = 0; b < quanta.size(); ++b) {
      FluxLedger& ledger = sums_.ledger[b];
      if (landing.surface == shared::left_upwards) ledger.reflected += quanta[b];
      if (landing.surface == shared::left_downwards) ledger.transmitted += quanta[b];
      if (landing.surface == shared::lost_on_its_way) ledger.unshot += quanta[b];
    }
    if (landing.surface == shared::lost_on_its_way) {
      ++sums_.lost;
    } else {
      pass(landing, way, landing.surface == shared::left_upwards ? scene_.layout.layers.count : -1, quanta);
    }
  }

  void land_on_element(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
    const std::size_t bands = quanta.size();
    const std::uint32_t element = landing.surface / 2;
    const std::uint32_t side = landing.surface % 2;
    const std::uint32_t surface_number = scene_.surfaces.number_of[element];
    const Surface& surface = scene_.surfaces.of[surface_number];
    const SurfaceOptics& optics = scene_.model.optics[surface.optics];
    const std::vector<FaceOptics>& face = side == 0 ? optics.upper : optics.lower;
    const EmissionPoint place = place_of(landing);
    ++sums_.element_hits[element];
    sums_.side_landed.add(landing.surface, quanta);
    std::fill(reflected_.begin(), reflected_.end(), 0);
    std::fill(transmitted_.begin(), transmitted_.end(), 0);
    for (std::size_t b = 0; b < bands; ++b) {
      if (quanta[b] == 0) continue;
      sums_.surface_landed[(surface_number * 2 + side) * bands + b] += quanta[b];
      if (!surface.soil()) {
        const std::size_t layer = static_cast<std::size_t>(place.level);
        sums_.layer_landed[((layer * scene_.model.optics.size() + surface.optics) * 2 + side) * bands + b] += quanta[b];
      }
      const QuantaSplit split = split_quanta(quanta[b], face[b].reflectance, face[b].transmittance, random_.unit());
      FluxLedger& ledger = sums_.ledger[b];
      ledger.absorbed_by(surface.role) += split.absorbed;
      reflected_[b] = split.reflected;
      transmitted_[b] = split.transmitted;
    }
    pass(landing, way, place.level, quanta);
    next_.add(place, reflected_);
    EmissionPoint other = place;
    other.surface ^= 1U;
    next_.add(other, transmitted_);
  }

  void land_on_soil(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
    const std::size_t bands = quanta.size();
    const std::size_t cell = shared::soil_cell(scene_.block.ground, {landing.place_a, landing.place_b});
    std::fill(reflected_.begin(), reflected_.end(), 0);
    for (std::size_t b = 0; b < bands; ++b) {
      if (quanta[b] == 0) continue;
      sums_.cell_landed[cell * bands + b] += quanta[b];
      const QuantaSplit split = split_quanta(quanta[b], scene_.model.soil->reflectance[b], 0.0, random_.unit());
      sums_.ledger[b].absorbed_soil += split.absorbed;
      reflected_[b] = split.reflected;
    }
    pass(landing, way, -1, quanta);
    next_.add(place_of(landing), reflected_);
  }

  // Adds the flux that passes the planes of the layers and the receivers.
  void pass(const shared::Landing& landing, const Way& way, int to_level, std::span<const std::int64_t> quanta) {
    pass_receivers(landing, way, quanta);
    layers_.pass(level_index(way.from.level), level_index(to_level), quanta);
  }

  void pass_receivers(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
    if (scene_.receivers == nullptr) return;
    const std::size_t to_zone = scene_.receivers->zone_of(landing);
    receivers_.pass(way.from_zone, to_zone, quanta);
    for (std::size_t p = to_zone; p < way.from_zone; ++p) {
      const std::size_t cell = scene_.receivers->cell_at(p, way.packet.origin, way.packet.direction);
      if (cell == PlaneReceivers::no_cell) continue;
      for (std::size_t b = 0; b < quanta.size(); ++b) sums_.receivers.down[cell * quanta.size() + b] += quanta[b];
    }
  }

  void close_planes() {
    layers_.close([](std::size_t plane) { return plane == 0; });
    sums_.down = layers_.down();
    sums_.up = layers_.up();
    if (scene_.receivers == nullptr) return;
    receivers_.close([this](std::size_t plane) { return scene_.receivers->at_ground(plane); });
    sums_.receivers.through_down = receivers_.down();
    sums_.receivers.through_up = receivers_.up();
  }

  [[nodiscard]] EmissionPoint place_of(const shared::Landing& landing) const {
    EmissionPoint place{landing.surface, landing.triangle, landing.place_a, landing.place_b, -1};
    if (landing.surface < shared::landed_on_ground) {
      const std::uint32_t element = landing.surface / 2;
      if (scene_.surfaces.at(element).soil()) return place;
      const Triangle& corners = scene_.model.canopy.corners[element];
      const float y_m = shared::landing_y(corners[0].y, corners[1].y, corners[2].y, landing.place_a, landing.place_b);
      place.level = static_cast<int>(layer_at(scene_.layout.layers, y_m));
    } else if (landing.surface == shared::landed_on_ground) {
      place.order = ground_order + shared::soil_cell(scene_.block.ground, {landing.place_a, landing.place_b});
    } else if (landing.surface == shared::left_upwards) {
      place.level = scene_.layout.layers.count;
    }
    return place;
  }

  [[nodiscard]] std::size_t zone_of(const EmissionPoint& place) const {
    if (place.a == anywhere && place.level >= 0) {  // a lamp: counted in the lowest zone, as it is in the lowest layer
      std::size_t zone = 0;
      while (zone < scene_.receivers->size() && scene_.receivers->at_ground(zone)) ++zone;
      return zone;
    }
    return scene_.receivers->zone_of({place.surface, place.order, place.a, place.b});
  }

  [[nodiscard]] Way way_from(const EmissionPoint& place, const shared::Packet& packet) const {
    Way way{place, 0, packet};
    const bool from_lamp = place.a == anywhere && place.level >= 0;
    if (from_lamp) way.from.level = static_cast<int>(layer_at(scene_.layout.layers, packet.origin.y));
    if (scene_.receivers != nullptr) way.from_zone = from_lamp ? scene_.receivers->zone_at(packet.origin.y) : zone_of(place);
    return way;
  }

  const IndirectScene& scene_;
  const ReplicateOrder& order_;
  const FirstLandings& first_;
  const std::vector<BandQuanta>& quanta_;
  const StopQuestion& stop_;
  RandomStream random_;
  IndirectSums sums_;
  PassArrays& arrays_;
  Candidates &waiting_, &next_;
  // Flux after the first landings, lamps included, [band]; the shares of a round are relative to it.
  std::vector<double> start_;
  std::vector<std::int64_t> sky_;                      // [band], sky flux that met something
  double aimed_draws_ = 1.0;                           // factor that makes up for what aim_draws takes from the first round
  PlaneFlux layers_, receivers_;                       // through the planes of the layers, and the horizontal receivers
  std::vector<std::int64_t> reflected_, transmitted_;  // [band], of the current landing
};

}  // namespace

IndirectScene::IndirectScene(const RadiationModel& of_model, const CounterLayout& of_layout, const Surfaces& of_surfaces,
                             Tracer& by_tracer, const PlaneReceivers* plane_receivers)
    : model(of_model),
      layout(of_layout),
      surfaces(of_surfaces),
      tracer(by_tracer),
      receivers(plane_receivers),
      block(make_packet_block(of_model, of_layout)),
      frame{std::ldexp(of_layout.box.extent_m(), -17), block.ground.y} {}

std::optional<IndirectSums> run_indirect_pass(const IndirectScene& scene, const ReplicateOrder& order,
                                              const FirstLandings& first, const std::vector<BandQuanta>& quanta,
                                              PassArrays& arrays, const StopQuestion& stop) {
  return IndirectPass(scene, order, first, quanta, arrays, stop).run();
}

std::uint32_t sampled_ray(std::size_t k, double offset, double stride, std::uint64_t rays) {
  return static_cast<std::uint32_t>(std::min((static_cast<double>(k) + offset) * stride, static_cast<double>(rays - 1)));
}

}  // namespace sunfleck
