#include "physics/transport/indirect/indirect.h"

#include "base/random.h"
#include "physics/transport/indirect/expected_draws.h"
#include "physics/transport/indirect/landing_points.h"
#include "physics/transport/indirect/scattering.h"
#include "physics/transport/model/columns.h"
#include "physics/transport/receivers/plane_flux.h"
#include "shared/beam.h"

#include <algorithm>
#include <cmath>
#include <span>

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

// The pass of one replicate, with the flux that is still on its way.
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
        sums_(scene.model, scene.layout, scene.surfaces, lights_),
        arrays_(arrays),
        waiting_(arrays.waiting),
        next_(arrays.next),
        sky_(columns_),
        layers_(static_cast<std::size_t>(scene.layout.layers.count) + 1, columns_),
        receivers_(scene.receivers != nullptr ? scene.receivers->size() : 0, columns_),
        shot_(columns_),
        scattering_(scene.model, lights_) {
    sums_.side_landed.reserve(arrays.sides_landed);
    if (scene.receivers != nullptr) sums_.receivers = PlaneSums(*scene.receivers, scene.model, columns_);
    waiting_.clear();
    next_.clear();
    for (std::size_t b = 0; b < bands_; ++b) {
      for (std::size_t k = 0; k < lights_; ++k) quanta_.push_back(&(*light.quanta[k])[b]);
    }
  }

  std::optional<IndirectSums> run() {
    if (!let_sky_in()) return std::nullopt;
    const std::vector<std::int64_t>& from_sky = waiting_.totals();
    std::vector<double> start(columns_);  // flux after the first landings, lamps included
    for (std::size_t c = 0; c < columns_; ++c) {
      start[c] = static_cast<double>(quanta_[c]->lamps + from_sky[c]);
      const std::vector<std::int64_t>& scattered = first(c).scattered;
      for (std::size_t k = band(c); k < scattered.size(); k += bands_) start[c] += static_cast<double>(scattered[k]);
      sums_.ledger[c].incident += quanta_[c]->lamps;
    }
    ExpectedDraws draws(scene_, light_, order_.packets, start);
    if (!sample_landings(scene_, light_, wanted_landings(), random_, stop_, arrays_)) return std::nullopt;
    add_first_candidates(arrays_.points);
    add_lamps();
    sums_.first_candidates = waiting_.size();
    retire_faint_columns();
    while (waiting_.size() > 0 && sums_.rounds < most_rounds) {
      if (!shoot(draws)) return std::nullopt;
      retire_faint_columns();
    }
    for (std::size_t c = 0; c < columns_; ++c) sums_.ledger[c].unshot += waiting_.totals()[c];
    scattering_.add_to(sums_.ledger);
    close_planes();
    arrays_.sides_landed = sums_.side_landed.entries();
    return std::move(sums_);
  }

 private:
  // The start and the ray that lead to a landing.
  struct Way {
    EmissionPoint from;
    std::size_t from_zone = 0;
    const shared::Packet& packet;
  };

  [[nodiscard]] std::size_t band(std::size_t column) const { return column / lights_; }
  // Returns what the direct pass found in the light of a column.
  [[nodiscard]] const FirstLandings& first(std::size_t column) const { return light_.first[column % lights_]; }

  // Returns how many landings of beam rays packets start from.
  [[nodiscard]] double wanted_landings() const {
    const double most = std::min(order_.packets, order_.sampled_rays);
    if (lights_ == 1) return most;
    return std::max(shared_landings_per_packet * most, least_shared_landings * static_cast<double>(lights_));
  }

  // Sends the sky rays, each with its share of the skies' flux, and leaves the scattered flux waiting. Returns false if
  // stopped.
  [[nodiscard]] bool let_sky_in() {
    if (light_.sky == nullptr) return true;
    const std::vector<shared::Packet> rays = light_.sky->draw(order_.sky_rays, random_);
    std::vector<shared::Landing> landings(rays.size());
    if (scene_.tracer.trace(scene_.block, rays, landings, stop_) == TraceOutcome::stopped) return false;
    EmissionPoint above;
    above.surface = shared::left_upwards;
    above.level = scene_.layout.layers.count;
    SkyShares shares(*light_.sky, rays);
    std::vector<std::int64_t> given(columns_), own(columns_);
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const std::span<const double> up_to_ray = shares.next();
      for (std::size_t c = 0; c < columns_; ++c) {
        const auto up_to = static_cast<std::int64_t>(up_to_ray[c % lights_] * static_cast<double>(quanta_[c]->sky));
        own[c] = up_to - given[c];
        given[c] = up_to;
      }
      const Way way = way_from(above, rays[r]);
      if (fell_beside_plot(landings[r], rays[r])) {
        pass_receivers(landings[r], way, own);
        continue;
      }
      for (std::size_t c = 0; c < columns_; ++c) sky_[c] += own[c];
      land(landings[r], way, own);
    }
    for (std::size_t c = 0; c < columns_; ++c) sums_.ledger[c].incident += sky_[c];
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

  // The flux that leaves both sides of an element at a point, or the ground, [column], relative to all points.
  struct PointFlux {
    explicit PointFlux(std::size_t columns) : landed_side(columns), other_side(columns) {}
    std::vector<double> landed_side, other_side;
  };

  void set_flux(const LandingPoints& points, std::size_t point, PointFlux& flux) const {
    const std::uint32_t landed = points.places[point].surface;
    const double* const weights = &points.weights[point * lights_];
    for (std::size_t b = 0; b < bands_; ++b) {
      FaceOptics front, back;
      if (landed == shared::landed_on_ground) {
        front = scattering_.soil_face()[b];
      } else {
        const SurfaceOptics& optics = scene_.model.optics[scene_.model.canopy.optics_of[landed / 2]];
        front = (landed % 2 == 0 ? optics.upper : optics.lower)[b];
        back = (landed % 2 == 0 ? optics.lower : optics.upper)[b];
      }
      for (std::size_t k = 0; k < lights_; ++k) {
        const double weight = weights[k];
        const std::size_t c = column_of(b, k, lights_);
        flux.landed_side[c] = weight >= 0.0 ? weight * front.reflectance : -weight * back.transmittance;
        flux.other_side[c] = weight >= 0.0 ? weight * front.transmittance : -weight * back.reflectance;
      }
    }
  }

  // Calls take(place, flux) for every side that light leaves at the points.
  template <class Take>
  void for_each_source(const LandingPoints& points, const Take& take) const {
    PointFlux flux(columns_);
    for (std::size_t p = 0; p < points.places.size(); ++p) {
      set_flux(points, p, flux);
      EmissionPoint place = points.places[p];
      take(place, flux.landed_side);
      if (place.surface == shared::landed_on_ground) continue;
      place.surface ^= 1U;
      take(place, flux.other_side);
    }
  }

  // Distributes the flux scattered by all beam rays over the sampled points, column by column.
  void add_first_candidates(const LandingPoints& points) {
    std::vector<std::int64_t> scattered(columns_), given(columns_), own(columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      const FirstLandings& landings = first(c);
      for (std::size_t k = band(c); k < landings.scattered.size(); k += bands_) {
        scattered[c] += landings.scattered[k];
        layers_.move(k / bands_, c, -landings.scattered[k]);
      }
      for (std::size_t k = band(c); k < landings.scattered_by_zone.size(); k += bands_) {
        receivers_.move(k / bands_, c, -landings.scattered_by_zone[k]);
      }
    }
    waiting_.reserve(waiting_.size() + 2 * points.places.size());
    std::vector<double> total(columns_), sum(columns_);
    for_each_source(points, [&](const EmissionPoint&, std::span<const double> flux) {
      for (std::size_t c = 0; c < columns_; ++c) total[c] += flux[c];
    });
    for_each_source(points, [&](const EmissionPoint& place, std::span<const double> flux) {
      for (std::size_t c = 0; c < columns_; ++c) {
        own[c] = 0;
        if (flux[c] == 0.0) continue;
        sum[c] += flux[c];
        const auto up_to = static_cast<std::int64_t>(std::min(1.0, sum[c] / total[c]) * static_cast<double>(scattered[c]));
        own[c] = up_to - given[c];
        given[c] = up_to;
      }
      move(place, own);
      waiting_.add(place, own);
    });
    for (std::size_t c = 0; c < columns_; ++c) sums_.ledger[c].unshot += scattered[c] - given[c];
  }

  // Adds the flux that the lamps emit; its packets start anywhere on them.
  void add_lamps() {
    const auto has_lamps = [](const BandQuanta* quanta) { return !quanta->lamp.empty(); };
    if (std::none_of(quanta_.begin(), quanta_.end(), has_lamps)) return;
    std::vector<std::int64_t> own(columns_);
    for (std::size_t e = 0; e < scene_.model.canopy.size(); ++e) {
      for (std::size_t c = 0; c < columns_; ++c) own[c] = has_lamps(quanta_[c]) ? quanta_[c]->lamp[e] : 0;
      EmissionPoint place;
      place.surface = static_cast<std::uint32_t>(2 * e);
      place.order = static_cast<std::uint32_t>(e);
      place.a = anywhere;
      if (scene_.surfaces.at(e).soil()) place.level = -1;
      waiting_.add(place, own);
    }
  }

  // Draws packets from the waiting flux, traces them and leaves what they scatter waiting. Returns false if stopped.
  [[nodiscard]] bool shoot(ExpectedDraws& draws) {
    next_.take_sorted(waiting_, arrays_.sorting);
    std::swap(waiting_, next_);
    leave_places(draws);
    draws.scale(waiting_, arrays_.expected);
    Draw& draw = arrays_.draw;
    draw_packets(waiting_, arrays_.expected, random_, draw);
    const PacketStarts starts(scene_.model.canopy, waiting_, draw, scene_.frame, random_);
    const std::size_t count = draw.candidate.size();
    next_.clear();
    next_.reserve(2 * count);
    for (std::size_t first = 0; first < count; first += most_at_a_time) {
      arrays_.packets.resize(std::min(most_at_a_time, count - first));
      starts.write(first, arrays_.packets);
      if (!trace_packets()) return false;
      for (std::size_t p = 0; p < arrays_.packets.size(); ++p) {
        const EmissionPoint& place = waiting_.place(draw.candidate[first + p]);
        share_out(waiting_, arrays_.expected, first + p, draw, shot_);
        move(place, shot_);
        land(arrays_.landings[p], way_from(place, arrays_.packets[p]), shot_);
      }
    }
    if (std::find(draw.kept.begin(), draw.kept.end(), true) != draw.kept.end()) keep_undrawn(draw);
    std::swap(waiting_, next_);
    sums_.most_candidates = std::max<std::uint64_t>(sums_.most_candidates, waiting_.size());
    sums_.packets += count;
    ++sums_.rounds;
    return true;
  }

  // Traces arrays_.packets. Returns false if stopped.
  [[nodiscard]] bool trace_packets() {
    arrays_.landings.resize(arrays_.packets.size());
    return scene_.tracer.trace(scene_.block, arrays_.packets, arrays_.landings, stop_) != TraceOutcome::stopped;
  }

  // Takes the waiting flux off its places, and finds the part of it that waits at each candidate.
  void leave_places(ExpectedDraws& draws) {
    constexpr std::size_t at_once = 64;  // few enough to be found in a cache the second time
    arrays_.expected.resize(waiting_.size());
    for (std::size_t first = 0; first < waiting_.size(); first += at_once) {
      const std::size_t count = std::min(at_once, waiting_.size() - first);
      draws.set_parts(waiting_, first, count, arrays_.expected);
      for (std::size_t k = first; k < first + count; ++k) {
        layers_.leave(level_index(waiting_.place(k).level), waiting_.quanta(k));
        if (scene_.receivers != nullptr) receivers_.leave(zone_of(waiting_.place(k)), waiting_.quanta(k));
      }
    }
  }

  // Books quanta that are shot from a place although they waited elsewhere.
  void move(const EmissionPoint& place, std::span<const std::int64_t> quanta) {
    layers_.move(level_index(place.level), quanta);
    if (scene_.receivers != nullptr) receivers_.move(zone_of(place), quanta);
  }

  // Leaves the flux that no packet carried where it waited, for the next round.
  void keep_undrawn(const Draw& draw) {
    std::vector<bool> drawn = draw.kept;
    drawn.flip();
    waiting_.retire(drawn);
    for (std::size_t k = 0; k < waiting_.size(); ++k) {
      move(waiting_.place(k), waiting_.quanta(k));
      next_.add(waiting_.place(k), waiting_.quanta(k));
    }
  }

  // Ends the columns with too little flux left to matter.
  void retire_faint_columns() {
    bool any = false;
    std::vector<bool> faint(columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      const std::int64_t unshot = waiting_.totals()[c];
      if (unshot == 0) continue;
      const double incident = static_cast<double>(quanta_[c]->per_ray) * static_cast<double>(first(c).met) +
                              static_cast<double>(quanta_[c]->lamps + sky_[c]);
      const double vegetation =
          std::max(first(c).least_of_vegetation[band(c)], static_cast<double>(scattering_.vegetation()[c]));
      const double judged =
          std::min(vegetation, std::max(least_judged_share * incident, static_cast<double>(scattering_.soil()[c])));
      if (static_cast<double>(unshot) < unshot_part_of_bound * order_.bound * judged) {
        sums_.ledger[c].unshot += unshot;
        faint[c] = true;
      } else {
        any = true;
      }
    }
    if (any) {
      waiting_.retire(faint);
    } else {
      waiting_.clear();
    }
  }

  // Books what a ray or packet carries to its end.
  void land(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
    if (landing.surface < shared::landed_on_ground) return land_on_element(landing, way, quanta);
    if (landing.surface == shared::landed_on_ground) return land_on_soil(landing, way, quanta);
    for (std::size_t c = 0; c < columns_; ++c) {
      FluxLedger& ledger = sums_.ledger[c];
      if (landing.surface == shared::left_upwards) ledger.reflected += quanta[c];
      if (landing.surface == shared::left_downwards) ledger.transmitted += quanta[c];
      if (landing.surface == shared::lost_on_its_way) ledger.unshot += quanta[c];
    }
    if (landing.surface == shared::lost_on_its_way) {
      ++sums_.lost;
    } else {
      pass(landing, way, landing.surface == shared::left_upwards ? scene_.layout.layers.count : -1, quanta);
    }
  }

  void land_on_element(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
    const std::uint32_t element = landing.surface / 2;
    const std::uint32_t side = landing.surface % 2;
    const std::uint32_t surface_number = scene_.surfaces.number_of[element];
    const Surface& surface = scene_.surfaces.of[surface_number];
    const EmissionPoint place = place_of(scene_, landing);
    ++sums_.element_hits[element];
    sums_.side_landed.add(landing.surface, quanta);
    add_to(sums_.surface_landed, surface_number * 2 + side, quanta);
    if (!surface.soil()) {
      const std::size_t layer = static_cast<std::size_t>(place.level);
      add_to(sums_.layer_landed, (layer * scene_.model.optics.size() + surface.optics) * 2 + side, quanta);
    }
    scattering_.on_element(surface.optics, side, surface.role, quanta, random_);
    pass(landing, way, place.level, quanta);
    next_.add(place, scattering_.reflected());
    EmissionPoint other = place;
    other.surface ^= 1U;
    next_.add(other, scattering_.transmitted());
  }

  void land_on_soil(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
    add_to(sums_.cell_landed, shared::soil_cell(scene_.block.ground, {landing.place_a, landing.place_b}), quanta);
    scattering_.on_soil(quanta, random_);
    pass(landing, way, -1, quanta);
    next_.add(place_of(scene_, landing), scattering_.reflected());
  }

  // Adds a place's quanta to its sums, [place * columns + column].
  void add_to(std::vector<std::int64_t>& sums, std::size_t place, std::span<const std::int64_t> quanta) const {
    columns::add(quanta, &sums[place * columns_]);
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
      add_to(sums_.receivers.down, cell, quanta);
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
  const LightFromAbove& light_;
  const StopQuestion& stop_;
  std::size_t lights_, bands_, columns_;
  std::vector<const BandQuanta*> quanta_;  // [column]
  RandomStream random_;
  IndirectSums sums_;
  PassArrays& arrays_;
  Candidates &waiting_, &next_;
  std::vector<std::int64_t> sky_;   // [column], sky flux that met something
  PlaneFlux layers_, receivers_;    // through the planes of the layers, and the horizontal receivers
  std::vector<std::int64_t> shot_;  // [column], carried by the current packet
  Scattering scattering_;
};

}  // namespace

std::optional<IndirectSums> run_indirect_pass(const IndirectScene& scene, const ReplicateOrder& order,
                                              const LightFromAbove& light, PassArrays& arrays, const StopQuestion& stop) {
  return IndirectPass(scene, order, light, arrays, stop).run();
}

}  // namespace sunfleck
