// The start of the indirect pass: the sky's first landings, a sample of the beam's, and lamps.

#include "shared/beam.h"
#include "transport/indirect_round.h"

#include <algorithm>

namespace sunfleck {

// Sends the sky rays, each with its share of the sky's flux, and leaves the scattered flux waiting. Returns false if
// stopped.
bool IndirectPass::let_sky_in(Round& round, const StopQuestion& stop) const {
  if (sky_ == nullptr) return true;
  const std::size_t bands = round.start.size();
  const std::vector<shared::Packet> rays = sky_->draw(round.settings.sky_rays, round.random);
  std::vector<shared::Landing> landings(rays.size());
  if (tracer_.trace(scene_, rays, landings, stop) == TraceOutcome::stopped) return false;
  EmissionPoint above;
  above.surface = shared::left_upwards;
  above.level = layout_.layers.count;
  std::vector<std::int64_t> given(bands), own(bands);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(rays.size());
    for (std::size_t b = 0; b < bands; ++b) {
      const auto up_to = static_cast<std::int64_t>(share * static_cast<double>(round.quanta[b].sky));
      own[b] = up_to - given[b];
      given[b] = up_to;
    }
    const Way way = way_from(above, rays[k]);
    if (fell_beside_plot(landings[k], rays[k])) {
      pass_receivers_alone(round, landings[k], way, own);
      continue;
    }
    for (std::size_t b = 0; b < bands; ++b) round.sky[b] += own[b];
    land(round, landings[k], way, own);
  }
  for (std::size_t b = 0; b < bands; ++b) round.sums.ledger[b].incident += round.sky[b];
  round.sums.side_sky = round.sums.side_landed;
  round.sums.cell_sky = round.sums.cell_landed;
  round.sums.sky_rays = rays.size();
  std::swap(round.waiting, round.next);
  return true;
}

// Returns true for a ray of an isolated stand that met neither an element nor the plot's ground. Its flux counts only at the
// receivers that it passed.
bool IndirectPass::fell_beside_plot(const shared::Landing& landing, const shared::Packet& ray) const {
  if (model_.plot.periodic || landing.surface != shared::left_downwards) return false;
  return !shared::falls_on_plot(shared::make_ray(ray.origin, ray.direction), scene_.ground);
}

// Traces a systematic sample of the beam rays again to find the points where they landed. If there are no more rays than
// packets, every ray is taken. Returns nothing if stopped.
std::optional<std::vector<IndirectPass::Source>> IndirectPass::sample_first_landings(Round& round,
                                                                                     const StopQuestion& stop) const {
  const FirstLandings& first = round.first;
  std::vector<Source> sources;
  if (first.beam == nullptr) return sources;
  const auto count = static_cast<std::size_t>(std::min(round.settings.packets, static_cast<double>(first.rays)));
  const double stride = static_cast<double>(first.rays) / static_cast<double>(count);
  const double offset = round.random.unit();
  std::vector<shared::Packet> rays(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t ray = sampled_ray(k, offset, stride, first.rays);
    rays[k] = {shared::beam_origin(*first.beam, ray), shared::no_element, first.beam->direction, 0};
  }
  std::vector<shared::Landing> landings(count);
  if (tracer_.trace(scene_, rays, landings, stop) == TraceOutcome::stopped) return std::nullopt;
  for (const shared::Landing& landing : landings) {
    const EmissionPoint place = place_of(landing);
    if (landing.surface == shared::landed_on_ground) sources.push_back({place, nullptr, false});
    if (landing.surface >= shared::landed_on_ground) continue;
    const SurfaceOptics& optics = model_.optics[model_.canopy.optics_of[landing.surface / 2]];
    const auto* face = landing.surface % 2 == 0 ? &optics.upper : &optics.lower;
    EmissionPoint other = place;
    other.surface ^= 1U;
    sources.push_back({place, face, false});
    sources.push_back({other, face, true});
  }
  return sources;
}

// Distributes the flux scattered by all beam rays over the sampled sources, band by band.
void IndirectPass::add_first_candidates(Round& round, const std::vector<Source>& sources) const {
  const std::size_t bands = round.start.size();
  const Soil* soil = model_.soil ? &*model_.soil : nullptr;
  std::vector<std::int64_t> scattered(bands), given(bands), own(bands);
  for (std::size_t k = 0; k < round.first.scattered.size(); ++k) scattered[k % bands] += round.first.scattered[k];
  std::vector<double> total(bands), sum(bands);
  for (const Source& source : sources) {
    for (std::size_t b = 0; b < bands; ++b) total[b] += source.weight(soil, b);
  }
  Moves moves{round.first.scattered, round.first.scattered_by_zone};
  for (auto* moved : {&moves.by_level, &moves.by_zone}) {
    for (std::int64_t& quanta : *moved) quanta = -quanta;
  }
  for (const Source& source : sources) {
    const std::size_t zone = receivers_ != nullptr ? static_cast<std::size_t>(zone_of(source.place)) : 0;
    for (std::size_t b = 0; b < bands; ++b) {
      own[b] = 0;
      const double weight = source.weight(soil, b);
      if (weight == 0.0) continue;
      sum[b] += weight;
      const auto up_to = static_cast<std::int64_t>(std::min(1.0, sum[b] / total[b]) * static_cast<double>(scattered[b]));
      own[b] = up_to - given[b];
      given[b] = up_to;
      moves.by_level[level_index(source.place.level) * bands + b] += own[b];
      if (!moves.by_zone.empty()) moves.by_zone[zone * bands + b] += own[b];
    }
    round.waiting.add(source.place, own);
  }
  for (std::size_t b = 0; b < bands; ++b) round.sums.ledger[b].unshot += scattered[b] - given[b];
  book(round, moves);
}

void IndirectPass::add_lamps(Round& round) const {
  const std::size_t bands = round.start.size();
  std::vector<std::int64_t> own(bands);
  for (std::size_t e = 0; e < model_.canopy.size(); ++e) {
    for (std::size_t b = 0; b < bands; ++b) own[b] = round.quanta[b].lamp.empty() ? 0 : round.quanta[b].lamp[e];
    EmissionPoint place;
    place.surface = static_cast<std::uint32_t>(2 * e);
    place.order = static_cast<std::uint32_t>(e);
    place.a = anywhere;
    if (surfaces_.of[surfaces_.number_of[e]].soil) place.level = -1;
    round.waiting.add(place, own);
  }
}

}  // namespace sunfleck
