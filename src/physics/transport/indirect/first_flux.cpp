#include "physics/transport/indirect/first_flux.h"

#include "physics/transport/indirect/arrival_batches.h"
#include "shared/quanta.h"
#include "shared/random.h"

#include <algorithm>
#include <utility>

namespace sunfleck {
namespace {

// Quanta of a sampled landing are cut off here, far above all that a replicate has.
constexpr auto most_at_point = static_cast<double>(shared::most_at_point);

}  // namespace

FirstFlux::FirstFlux(const IndirectScene& scene, const LightFromAbove& light, glm::uvec2 key, PacketBooks& books,
                     PassArrays& arrays)
    : scene_(scene),
      light_(light),
      key_(key),
      books_(books),
      arrays_(arrays),
      lights_(scene.lights.size()),
      bands_(scene.model.bands.size()),
      columns_(lights_ * bands_) {
  for (std::size_t b = 0; b < bands_; ++b) {
    for (std::size_t k = 0; k < lights_; ++k) quanta_.push_back(&(*light.quanta[k])[b]);
  }
  for (std::size_t c = 0; c < columns_; ++c) {
    incident_.push_back(quanta_[c]->per_ray * static_cast<std::int64_t>(first(c).met) + quanta_[c]->lamps);
    books_.sums().ledger[c].incident += quanta_[c]->lamps;
  }
}

// Returns the random bits by which the quanta of a sky ray or at a sampled point split.
std::uint32_t FirstFlux::random_bits(std::size_t number) const {
  return shared::random_words(key_, static_cast<std::uint32_t>(number), 0).x;
}

std::int64_t FirstFlux::least_of_vegetation(std::size_t column) const {
  const double quanta = first(column).least_of_vegetation[band(column)];
  return quanta < 0x1p62 ? static_cast<std::int64_t>(quanta) : std::int64_t{1} << 62U;
}

bool FirstFlux::let_sky_in(std::size_t number, RandomStream& random, const StopQuestion& stop) {
  if (light_.sky == nullptr) return true;
  const std::vector<shared::Packet> rays = light_.sky->draw(number, random);
  std::vector<shared::Landing> landings(rays.size());
  if (scene_.tracer.trace(scene_.block, rays, landings, stop) == TraceOutcome::stopped) return false;
  share_out(*light_.sky, rays, landings);
  IndirectSums& sums = books_.sums();
  sums.side_sky = sums.side_landed;
  sums.cell_sky = sums.cell_landed;
  sums.sky_rays = rays.size();
  return true;
}

// Books the rays, each with its share of the flux. Shares are differences of rounded sums, so that they add up to all of it.
void FirstFlux::share_out(const SkyRays& sky, std::span<const shared::Packet> rays, std::span<const shared::Landing> landings) {
  SkyShares shares(sky, rays);
  std::vector<std::int64_t> given(columns_);
  for_each_batch(rays.size(), columns_, arrays_, [&](std::size_t first, std::span<Arrival> arrivals) {
    find_arrivals(scene_, landings.subspan(first), arrivals, [&](std::size_t k) {
      return arrival_from_above(scene_, rays[first + k], landings[first + k], random_bits(first + k));
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
    books_.book({rays.subspan(first, arrivals.size()), arrivals, arrays_.carried}, arrays_.next);
  });
}

void FirstFlux::add_lamps() {
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
    arrays_.next.add(place, own);
  }
}

std::vector<std::int64_t> FirstFlux::add_landings() {
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

void FirstFlux::add_points(const LandingPoints& points, std::span<const std::int64_t> scattered) {
  arrays_.next.reserve(arrays_.next.size() + points.places.size());
  if (points.weights.empty()) return add_equal_points(points.places, scattered);
  add_weighted_points(points, scattered);
}

// A device does the same with landings that it keeps (shaders/rounds/first_sum.comp and its neighbours).
void FirstFlux::add_equal_points(std::span<const EmissionPoint> points, std::span<const std::int64_t> scattered) {
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
    point.u = random_bits(books_.sums().sky_rays + point.u);
    arrays_.next.add(point, own);
  }
}

void FirstFlux::add_weighted_points(const LandingPoints& points, std::span<const std::int64_t> scattered) {
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
    arrays_.next.add(place, own);
  });
}

// Calls take(place, weights) for each side on which beams land at the points; [light], 0 for those that land on the other side.
template <class Take>
void FirstFlux::for_each_landing(const LandingPoints& points, const Take& take) const {
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
      place.u = random_bits(books_.sums().sky_rays + point.u);
      take(place, weights);
    }
  }
}

}  // namespace sunfleck
