#include "transport/indirect.h"

#include "base/check.h"
#include "shared/beam.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

// Fewer packets than this are not worth a round.
constexpr double least_packets = 256;
// The stop rule leaves this part of the bound unshot, of flux judged as at least 1 % of the incident.
constexpr double unshot_part_of_bound = 0.1;
constexpr double least_judged_share = 0.01;
// A closed box of perfect mirrors would never end.
constexpr std::uint64_t most_rounds = 20000;
// Streams of random numbers, apart from those of the beam.
constexpr std::uint64_t indirect_stream = std::uint64_t{1} << 48U;

// The ground comes after all elements, by blocks of its map.
constexpr std::uint32_t ground_order = 0x80000000U;

}  // namespace

IndirectSums::IndirectSums(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces)
    : bands(model.bands.size()),
      surface_landed(surfaces.of.size() * 2 * bands),
      layer_landed(static_cast<std::size_t>(layout.layers.count) * model.optics.size() * 2 * bands),
      side_landed(model.canopy.size() * 2 * bands),
      element_hits(model.canopy.size()),
      cell_landed(std::size_t{layout.cells()} * bands),
      down((static_cast<std::size_t>(layout.layers.count) + 1) * bands),
      up(down.size()),
      ledger(bands) {}

shared::PacketBlock make_packet_block(const RadiationModel& model, const CounterLayout& layout) {
  shared::PacketBlock scene;
  scene.period = model.canopy.period_m;
  scene.overlap = 0.5F * border_margin_m(model.canopy);
  scene.ground = make_ground_map(layout);
  scene.top_y = static_cast<float>(layout.box.above_m());
  return scene;
}

struct IndirectPass::Round {
  Round(const RadiationModel& model, const Surfaces& surfaces, const CounterLayout& layout, const IndirectSettings& how,
        const std::vector<BandQuanta>& band_quanta, const FirstLandings& first_landings)
      : settings(how),
        quanta(band_quanta),
        first(first_landings),
        random(how.seed, indirect_stream + how.replicate),
        sums(model, layout, surfaces),
        waiting(model.bands.size()),
        next(model.bands.size()),
        start(model.bands.size()),
        moved_down(sums.down.size()),
        reflected(model.bands.size()),
        transmitted(model.bands.size()) {}

  const IndirectSettings& settings;
  const std::vector<BandQuanta>& quanta;
  const FirstLandings& first;
  RandomStream random;
  IndirectSums sums;
  Candidates waiting, next;
  std::vector<double> start;  // [band], flux after the first landings, lamps included; a round's share is relative to it
  std::vector<std::int64_t> moved_down;              // [plane * bands + band], net flux that sampling moved through it
  std::vector<std::int64_t> reflected, transmitted;  // [band], of the landing in hand
};

IndirectPass::IndirectPass(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, Tracer& tracer)
    : model_(model), layout_(layout), surfaces_(surfaces), tracer_(tracer), scene_(make_packet_block(model, layout)) {
  frame_.offset_m = std::ldexp(layout.box.extent_m(), -17);
  frame_.ground_y_m = scene_.ground.y;
}

std::optional<IndirectSums> IndirectPass::run(const FirstLandings& first, const std::vector<BandQuanta>& quanta,
                                              const IndirectSettings& settings, const StopQuestion& stop) {
  Round round(model_, surfaces_, layout_, settings, quanta, first);
  for (std::size_t b = 0; b < round.start.size(); ++b) {
    round.start[b] = static_cast<double>(quanta[b].lamps);
    for (std::size_t k = b; k < first.scattered.size(); k += round.start.size()) {
      round.start[b] += static_cast<double>(first.scattered[k]);
    }
    round.sums.ledger[b].incident = quanta[b].lamps;
  }
  const std::optional<std::vector<Source>> sources = sample_first_landings(round, stop);
  if (!sources) return std::nullopt;
  add_first_candidates(round, *sources);
  add_lamps(round);
  retire_faint_bands(round);
  while (round.waiting.size() > 0 && round.sums.rounds < most_rounds) {
    if (!shoot(round, stop)) return std::nullopt;
    retire_faint_bands(round);
  }
  for (std::size_t b = 0; b < round.start.size(); ++b) round.sums.ledger[b].unshot += round.waiting.total(b);
  // Differences between neighbouring planes become the planes' own flux.
  for (auto* planes : {&round.sums.down, &round.sums.up}) {
    for (std::size_t k = round.start.size(); k < planes->size(); ++k) (*planes)[k] += (*planes)[k - round.start.size()];
  }
  for (std::size_t k = 0; k < round.moved_down.size(); ++k) {
    const std::int64_t half = k < round.start.size() ? 0 : round.moved_down[k] / 2;
    round.sums.down[k] += half;
    round.sums.up[k] -= round.moved_down[k] - half;
  }
  return std::move(round.sums);
}

// A systematic sample of the beam's rays, traced again for the points where they landed. Without a packet's worth of rays
// every ray is taken. None if stopped.
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
    const auto ray = static_cast<std::uint32_t>((static_cast<double>(k) + offset) * stride);
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

// Shares out what all rays scattered, band by band, among the sampled sources.
void IndirectPass::add_first_candidates(Round& round, const std::vector<Source>& sources) const {
  const std::size_t bands = round.start.size();
  const Soil* soil = model_.soil ? &*model_.soil : nullptr;
  std::vector<std::int64_t> scattered(bands), given(bands), own(bands);
  for (std::size_t k = 0; k < round.first.scattered.size(); ++k) scattered[k % bands] += round.first.scattered[k];
  std::vector<double> total(bands), sum(bands);
  for (const Source& source : sources) {
    for (std::size_t b = 0; b < bands; ++b) total[b] += source.weight(soil, b);
  }
  std::vector<std::int64_t> moved(round.first.scattered.size());
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] = -round.first.scattered[k];
  for (const Source& source : sources) {
    for (std::size_t b = 0; b < bands; ++b) {
      own[b] = 0;
      const double weight = source.weight(soil, b);
      if (weight == 0.0) continue;
      sum[b] += weight;
      const auto up_to = static_cast<std::int64_t>(std::min(1.0, sum[b] / total[b]) * static_cast<double>(scattered[b]));
      own[b] = up_to - given[b];
      given[b] = up_to;
      moved[level_index(source.place.level) * bands + b] += own[b];
    }
    round.waiting.add(source.place, own);
  }
  for (std::size_t b = 0; b < bands; ++b) round.sums.ledger[b].unshot += scattered[b] - given[b];
  book_moves(round, moved);
}

// Sampling moves flux between levels: what waits at one is shot from another, on average none. For the planes between them to
// keep their books to the last quantum, half of the net flux through a plane counts as gone down, and half as not come up; at
// the lowest all of it as not come up, since what goes down there is what lands on the soil.
// `moved` is [level index * bands + band], what is shot from a level less what waited there.
void IndirectPass::book_moves(Round& round, const std::vector<std::int64_t>& moved) const {
  const std::size_t bands = round.start.size();
  std::vector<std::int64_t> below(bands);
  for (std::size_t k = 0; k < moved.size() && k < round.moved_down.size(); ++k) {
    below[k % bands] += moved[k];
    round.moved_down[k] += below[k % bands];
  }
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

void IndirectPass::retire_faint_bands(Round& round) const {
  bool any = false;
  for (std::size_t b = 0; b < round.start.size(); ++b) {
    const std::int64_t unshot = round.waiting.total(b);
    if (unshot == 0) continue;
    const double incident = static_cast<double>(round.quanta[b].per_ray) * static_cast<double>(round.first.met) +
                            static_cast<double>(round.quanta[b].lamps);
    const FluxLedger& ledger = round.sums.ledger[b];
    const double judged = std::max(least_judged_share * incident,
                                   static_cast<double>(std::min(ledger.absorbed_vegetation, ledger.absorbed_soil)));
    if (static_cast<double>(unshot) < unshot_part_of_bound * round.settings.bound * judged) {
      round.sums.ledger[b].unshot += unshot;
      round.waiting.retire(b);
    } else {
      any = true;
    }
  }
  if (!any) round.waiting.clear();
}

std::vector<double> IndirectPass::expected_draws(const Round& round) const {
  const std::size_t bands = round.start.size();
  double lit = 0.0;
  for (const double start : round.start) lit += start > 0.0 ? 1.0 : 0.0;
  std::vector<double> expected(round.waiting.size());
  double total = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const auto quanta = round.waiting.quanta(k);
    for (std::size_t b = 0; b < bands; ++b) {
      if (round.start[b] > 0.0) expected[k] += static_cast<double>(quanta[b]) / round.start[b];
    }
    expected[k] *= round.settings.packets / lit;
    total += expected[k];
  }
  if (total < least_packets && total > 0.0) {
    for (double& e : expected) e *= least_packets / total;
  }
  return expected;
}

// What no packet carried waits on where it is.
void IndirectPass::keep_undrawn(Round& round, const Draw& draw) const {
  for (std::size_t b = 0; b < draw.kept.size(); ++b) {
    if (!draw.kept[b]) round.waiting.retire(b);
  }
  for (std::size_t k = 0; k < round.waiting.size(); ++k) round.next.add(round.waiting.place(k), round.waiting.quanta(k));
}

// Per level, what the packets carry away less what waited, for the bands that are drawn.
std::vector<std::int64_t> IndirectPass::moved_by(const Round& round, const Draw& draw) const {
  const std::size_t bands = round.start.size();
  std::vector<std::int64_t> moved(round.moved_down.size());
  const auto add = [&](const EmissionPoint& place, std::span<const std::int64_t> quanta, std::int64_t sign) {
    for (std::size_t b = 0; b < bands; ++b) {
      if (!draw.kept[b]) moved[level_index(place.level) * bands + b] += sign * quanta[b];
    }
  };
  for (std::size_t k = 0; k < round.waiting.size(); ++k) add(round.waiting.place(k), round.waiting.quanta(k), -1);
  for (std::size_t p = 0; p < draw.candidate.size(); ++p) {
    add(round.waiting.place(draw.candidate[p]), std::span(draw.quanta).subspan(p * bands, bands), 1);
  }
  return moved;
}

bool IndirectPass::shoot(Round& round, const StopQuestion& stop) const {
  const std::size_t bands = round.start.size();
  round.waiting.sort();
  const Draw draw = draw_packets(round.waiting, expected_draws(round), round.random);
  book_moves(round, moved_by(round, draw));
  const std::vector<shared::Packet> packets = start_packets(model_.canopy, round.waiting, draw, frame_, round.random);
  std::vector<shared::Landing> landings(packets.size());
  if (tracer_.trace(scene_, packets, landings, stop) == TraceOutcome::stopped) return false;
  round.next.clear();
  for (std::size_t p = 0; p < packets.size(); ++p) {
    EmissionPoint from = round.waiting.place(draw.candidate[p]);
    if (from.a == anywhere && from.level >= 0) from.level = static_cast<int>(layer_at(layout_.layers, packets[p].origin.y));
    land(round, landings[p], from, std::span(draw.quanta).subspan(p * bands, bands));
  }
  if (std::find(draw.kept.begin(), draw.kept.end(), true) != draw.kept.end()) keep_undrawn(round, draw);
  std::swap(round.waiting, round.next);
  round.sums.packets += packets.size();
  ++round.sums.rounds;
  return true;
}

EmissionPoint IndirectPass::place_of(const shared::Landing& landing) const {
  EmissionPoint place{landing.surface, landing.triangle, landing.place_a, landing.place_b, -1};
  if (landing.surface < shared::landed_on_ground) {
    const std::uint32_t element = landing.surface / 2;
    if (surfaces_.of[surfaces_.number_of[element]].soil) return place;
    const Triangle& corners = model_.canopy.corners[element];
    const float y_m = shared::landing_y(corners[0].y, corners[1].y, corners[2].y, landing.place_a, landing.place_b);
    place.level = static_cast<int>(layer_at(layout_.layers, y_m));
  } else if (landing.surface == shared::landed_on_ground) {
    place.order = ground_order + shared::soil_cell(scene_.ground, {landing.place_a, landing.place_b});
  } else if (landing.surface == shared::left_upwards) {
    place.level = layout_.layers.count;
  }
  return place;
}

void IndirectPass::pass_planes(Round& round, int from_level, int to_level, std::span<const std::int64_t> quanta) const {
  if (from_level == to_level) return;
  const std::size_t bands = quanta.size();
  std::vector<std::int64_t>& planes = from_level > to_level ? round.sums.down : round.sums.up;
  const auto first = level_index(std::min(from_level, to_level));
  const auto end = level_index(std::max(from_level, to_level));
  for (std::size_t b = 0; b < bands; ++b) {
    planes[first * bands + b] += quanta[b];
    if (end * bands < planes.size()) planes[end * bands + b] -= quanta[b];
  }
}

void IndirectPass::land(Round& round, const shared::Landing& landing, const EmissionPoint& from,
                        std::span<const std::int64_t> quanta) const {
  if (landing.surface < shared::landed_on_ground) return land_on_element(round, landing, from, quanta);
  if (landing.surface == shared::landed_on_ground) return land_on_soil(round, landing, from, quanta);
  for (std::size_t b = 0; b < quanta.size(); ++b) {
    FluxLedger& ledger = round.sums.ledger[b];
    if (landing.surface == shared::left_upwards) ledger.reflected += quanta[b];
    if (landing.surface == shared::left_downwards) ledger.transmitted += quanta[b];
    if (landing.surface == shared::lost_on_its_way) ledger.unshot += quanta[b];
  }
  if (landing.surface == shared::lost_on_its_way) {
    ++round.sums.lost;
  } else {
    pass_planes(round, from.level, landing.surface == shared::left_upwards ? layout_.layers.count : -1, quanta);
  }
}

void IndirectPass::land_on_element(Round& round, const shared::Landing& landing, const EmissionPoint& from,
                                   std::span<const std::int64_t> quanta) const {
  const std::size_t bands = quanta.size();
  const std::uint32_t element = landing.surface / 2;
  const std::uint32_t side = landing.surface % 2;
  const std::uint32_t surface_number = surfaces_.number_of[element];
  const Surface& surface = surfaces_.of[surface_number];
  const SurfaceOptics& optics = model_.optics[surface.optics];
  const std::vector<FaceOptics>& face = side == 0 ? optics.upper : optics.lower;
  const EmissionPoint place = place_of(landing);
  ++round.sums.element_hits[element];
  std::fill(round.reflected.begin(), round.reflected.end(), 0);
  std::fill(round.transmitted.begin(), round.transmitted.end(), 0);
  for (std::size_t b = 0; b < bands; ++b) {
    if (quanta[b] == 0) continue;
    round.sums.side_landed[landing.surface * bands + b] += quanta[b];
    round.sums.surface_landed[(surface_number * 2 + side) * bands + b] += quanta[b];
    if (!surface.soil) {
      const std::size_t layer = static_cast<std::size_t>(place.level);
      round.sums.layer_landed[((layer * model_.optics.size() + surface.optics) * 2 + side) * bands + b] += quanta[b];
    }
    const QuantaSplit split = split_quanta(quanta[b], face[b].reflectance, face[b].transmittance, round.random.unit());
    FluxLedger& ledger = round.sums.ledger[b];
    (surface.soil ? ledger.absorbed_soil : ledger.absorbed_vegetation) += split.absorbed;
    round.reflected[b] = split.reflected;
    round.transmitted[b] = split.transmitted;
  }
  pass_planes(round, from.level, place.level, quanta);
  round.next.add(place, round.reflected);
  EmissionPoint other = place;
  other.surface ^= 1U;
  round.next.add(other, round.transmitted);
}

void IndirectPass::land_on_soil(Round& round, const shared::Landing& landing, const EmissionPoint& from,
                                std::span<const std::int64_t> quanta) const {
  const std::size_t bands = quanta.size();
  const std::size_t cell = shared::soil_cell(scene_.ground, {landing.place_a, landing.place_b});
  std::fill(round.reflected.begin(), round.reflected.end(), 0);
  for (std::size_t b = 0; b < bands; ++b) {
    if (quanta[b] == 0) continue;
    round.sums.cell_landed[cell * bands + b] += quanta[b];
    const QuantaSplit split = split_quanta(quanta[b], model_.soil->reflectance[b], 0.0, round.random.unit());
    round.sums.ledger[b].absorbed_soil += split.absorbed;
    round.reflected[b] = split.reflected;
  }
  pass_planes(round, from.level, -1, quanta);
  round.next.add(place_of(landing), round.reflected);
}

}  // namespace sunfleck
