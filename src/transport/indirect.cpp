#include "base/check.h"
#include "transport/indirect_round.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

// Rounds are scaled up to at least this many packets.
constexpr double least_packets = 256;
// The stop rule leaves this part of the bound unshot, relative to flux taken as at least 1 % of the incident flux.
constexpr double unshot_part_of_bound = 0.1;
constexpr double least_judged_share = 0.01;
// Ends passes that would never end by themselves, as in a closed box of perfect mirrors.
constexpr std::uint64_t most_rounds = 20000;
// First stream of random numbers, apart from those of the beam.
constexpr std::uint64_t indirect_stream = std::uint64_t{1} << 48U;

// Adds `moved` ([place, bottom first * bands + band]) to the net flux through the planes above each place.
void add_up(const std::vector<std::int64_t>& moved, std::size_t bands, std::vector<std::int64_t>& through) {
  std::vector<std::int64_t> below(bands);
  for (std::size_t k = 0; k < moved.size() && k < through.size(); ++k) {
    below[k % bands] += moved[k];
    through[k] += below[k % bands];
  }
}

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

IndirectPass::Round::Round(const RadiationModel& model, const Surfaces& surfaces, const CounterLayout& layout,
                           const PlaneReceivers* receivers, const IndirectSettings& how,
                           const std::vector<BandQuanta>& band_quanta, const FirstLandings& first_landings)
    : settings(how),
      quanta(band_quanta),
      first(first_landings),
      random(how.seed, indirect_stream + how.replicate),
      sums(model, layout, surfaces),
      waiting(model.bands.size()),
      next(model.bands.size()),
      start(model.bands.size()),
      sky(model.bands.size()),
      moved_down(sums.down.size()),
      reflected(model.bands.size()),
      transmitted(model.bands.size()) {
  if (receivers == nullptr) return;
  sums.receivers = PlaneSums(*receivers, model);
  moved_through_receivers.resize(sums.receivers.through_down.size());
}

IndirectPass::IndirectPass(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, Tracer& tracer,
                           const SkyRays* sky, const PlaneReceivers* receivers)
    : model_(model),
      layout_(layout),
      surfaces_(surfaces),
      tracer_(tracer),
      sky_(sky),
      receivers_(receivers),
      scene_(make_packet_block(model, layout)) {
  frame_.offset_m = std::ldexp(layout.box.extent_m(), -17);
  frame_.ground_y_m = scene_.ground.y;
}

std::optional<IndirectSums> IndirectPass::run(const FirstLandings& first, const std::vector<BandQuanta>& quanta,
                                              const IndirectSettings& settings, const StopQuestion& stop) const {
  Round round(model_, surfaces_, layout_, receivers_, settings, quanta, first);
  if (!let_sky_in(round, stop)) return std::nullopt;
  for (std::size_t b = 0; b < round.start.size(); ++b) {
    round.start[b] = static_cast<double>(quanta[b].lamps + round.waiting.total(b));
    for (std::size_t k = b; k < first.scattered.size(); k += round.start.size()) {
      round.start[b] += static_cast<double>(first.scattered[k]);
    }
    round.sums.ledger[b].incident += quanta[b].lamps;
  }
  const std::optional<std::vector<Source>> sources = sample_first_landings(round, stop);
  if (!sources) return std::nullopt;
  add_first_candidates(round, *sources);
  add_lamps(round);
  round.sums.first_candidates = round.waiting.size();
  retire_faint_bands(round);
  while (round.waiting.size() > 0 && round.sums.rounds < most_rounds) {
    if (!shoot(round, stop)) return std::nullopt;
    retire_faint_bands(round);
  }
  for (std::size_t b = 0; b < round.start.size(); ++b) round.sums.ledger[b].unshot += round.waiting.total(b);
  close_planes(round);
  return std::move(round.sums);
}

// Sampling moves flux between levels: flux that waits at one level is shot from another, with a mean of zero. To keep the
// books of the planes in between exact to the quantum, half of the net flux moved through a plane is added to its downward
// flux and half is subtracted from its upward flux. At the ground all of it is subtracted from the upward flux, because the
// downward flux there is what lands on the soil.
void IndirectPass::book(Round& round, const Moves& moves) const {
  add_up(moves.by_level, round.start.size(), round.moved_down);
  add_up(moves.by_zone, round.start.size(), round.moved_through_receivers);
}

void IndirectPass::close_planes(Round& round) const {
  const std::size_t bands = round.start.size();
  IndirectSums& sums = round.sums;
  // Turns the differences between neighbouring planes into the flux of each plane.
  for (auto* planes : {&sums.down, &sums.up}) {
    for (std::size_t k = bands; k < planes->size(); ++k) (*planes)[k] += (*planes)[k - bands];
  }
  for (std::size_t k = 0; k < round.moved_down.size(); ++k) {
    const std::int64_t half = k < bands ? 0 : round.moved_down[k] / 2;
    sums.down[k] += half;
    sums.up[k] -= round.moved_down[k] - half;
  }
  const std::size_t planes = receivers_ != nullptr ? receivers_->size() : 0;
  for (std::size_t p = 0; p < planes; ++p) {
    for (std::size_t b = 0; b < bands; ++b) {
      const std::int64_t moved = round.moved_through_receivers[p * bands + b];
      const std::int64_t half = receivers_->at_ground(p) ? 0 : moved / 2;
      sums.receivers.through_down[p * bands + b] += half;
      sums.receivers.through_up[p * bands + b] -= moved - half;
    }
  }
}

void IndirectPass::retire_faint_bands(Round& round) const {
  bool any = false;
  for (std::size_t b = 0; b < round.start.size(); ++b) {
    const std::int64_t unshot = round.waiting.total(b);
    if (unshot == 0) continue;
    const double incident = static_cast<double>(round.quanta[b].per_ray) * static_cast<double>(round.first.met) +
                            static_cast<double>(round.quanta[b].lamps + round.sky[b]);
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

// Flux that no packet carried stays in place for the next round.
void IndirectPass::keep_undrawn(Round& round, const Draw& draw) const {
  for (std::size_t b = 0; b < draw.kept.size(); ++b) {
    if (!draw.kept[b]) round.waiting.retire(b);
  }
  for (std::size_t k = 0; k < round.waiting.size(); ++k) round.next.add(round.waiting.place(k), round.waiting.quanta(k));
}

// Returns the flux that packets carry away minus the flux that waited, for the bands that are drawn.
IndirectPass::Moves IndirectPass::moved_by(const Round& round, const Draw& draw) const {
  const std::size_t bands = round.start.size();
  Moves moves;
  moves.by_level.resize(round.moved_down.size());
  if (receivers_ != nullptr) moves.by_zone.resize((receivers_->size() + 1) * bands);
  const auto add = [&](const EmissionPoint& place, std::span<const std::int64_t> quanta, std::int64_t sign) {
    const std::size_t zone = receivers_ != nullptr ? static_cast<std::size_t>(zone_of(place)) : 0;
    for (std::size_t b = 0; b < bands; ++b) {
      if (draw.kept[b]) continue;
      moves.by_level[level_index(place.level) * bands + b] += sign * quanta[b];
      if (receivers_ != nullptr) moves.by_zone[zone * bands + b] += sign * quanta[b];
    }
  };
  for (std::size_t k = 0; k < round.waiting.size(); ++k) add(round.waiting.place(k), round.waiting.quanta(k), -1);
  for (std::size_t p = 0; p < draw.candidate.size(); ++p) {
    add(round.waiting.place(draw.candidate[p]), std::span(draw.quanta).subspan(p * bands, bands), 1);
  }
  return moves;
}

bool IndirectPass::shoot(Round& round, const StopQuestion& stop) const {
  const std::size_t bands = round.start.size();
  round.waiting.sort();
  const Draw draw = draw_packets(round.waiting, expected_draws(round), round.random);
  book(round, moved_by(round, draw));
  const std::vector<shared::Packet> packets = start_packets(model_.canopy, round.waiting, draw, frame_, round.random);
  std::vector<shared::Landing> landings(packets.size());
  if (tracer_.trace(scene_, packets, landings, stop) == TraceOutcome::stopped) return false;
  round.next.clear();
  for (std::size_t p = 0; p < packets.size(); ++p) {
    const Way way = way_from(round.waiting.place(draw.candidate[p]), packets[p]);
    land(round, landings[p], way, std::span(draw.quanta).subspan(p * bands, bands));
  }
  if (std::find(draw.kept.begin(), draw.kept.end(), true) != draw.kept.end()) keep_undrawn(round, draw);
  std::swap(round.waiting, round.next);
  round.sums.most_candidates = std::max<std::uint64_t>(round.sums.most_candidates, round.waiting.size());
  round.sums.packets += packets.size();
  ++round.sums.rounds;
  return true;
}

}  // namespace sunfleck
