#include "physics/transport/indirect/replicate_maker.h"

#include "physics/light/beam_grid.h"
#include "physics/transport/indirect/beam_landings.h"
#include "physics/transport/model/beam_block.h"

#include <chrono>
#include <utility>

namespace sunfleck {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

TraceOutcome ReplicateMaker::OneAtATime::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                    const StopQuestion& stop) {
  const std::lock_guard lock(mutex_);
  return tracer_.count_beam(beam, counters, stop);
}

TraceOutcome ReplicateMaker::OneAtATime::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                               std::span<shared::Landing> landings, const StopQuestion& stop) {
  const std::lock_guard lock(mutex_);
  return tracer_.trace(scene, packets, landings, stop);
}

ReplicateMaker::ReplicateMaker(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer)
    : model_(model),
      layout_(layout),
      surfaces_(model),
      aim_(make_stand_aim(model, layout)),
      tracer_(tracer),
      spare_(model.bands.size()) {
  if (!model.planes.empty()) receivers_.emplace(model, layout, surfaces_);
  if (model.has_sky()) sky_.emplace(model, layout, nullptr);
  if (model.has_sky() && aim_) aimed_sky_.emplace(model, layout, &*aim_);
  if (!scatters(model) && !sky_) return;
  indirect_.emplace(model, layout, surfaces_, tracer_, receivers());
}

Incidence ReplicateMaker::incidence(double beam_rays, bool aimed) const {
  Incidence incidence;
  incidence.sky_ground_m2 = sky_ ? sky(aimed).ground_m2() : 0.0;
  incidence.sky_weight = sky_ ? sky(aimed).largest_weight() : 1.0;
  if (!model_.has_beam()) return incidence;
  const std::vector<WeightedBeamGrid> grids = make_grids(model_, layout_, aim(aimed), beam_rays);
  incidence.ground_per_ray_m2 = grids.front().grid.horizontal_area_per_ray_m2();
  for (const WeightedBeamGrid& part : grids) {
    incidence.rays += part.weight * part.grid.rays();
    incidence.traced_rays += part.grid.rays();
  }
  return incidence;
}

Conversion ReplicateMaker::conversion(const Incidence& incidence) const {
  return {model_, layout_, surfaces_, receivers(), incidence};
}

Replicate ReplicateMaker::blank(const ReplicateOrder& order) const {
  Replicate blank;
  blank.counters.resize(layout_.words());
  if (receivers_) blank.passed = PlaneSums(*receivers_, model_);
  if (!indirect_ || order.packets == 0.0) return blank;
  blank.packets.emplace(model_, layout_, surfaces_);
  if (receivers_) blank.packets->receivers = blank.passed;
  if (!sky_) return blank;
  blank.packets->side_sky = blank.packets->side_landed;
  blank.packets->cell_sky.resize(blank.packets->cell_landed.size());
  return blank;
}

double ReplicateMaker::sum_bytes() const {
  double bytes = static_cast<double>(layout_.words()) * sizeof(std::uint32_t);
  if (!indirect_) return bytes;
  const double cells = static_cast<double>(layout_.cells()) * static_cast<double>(model_.bands.size());
  bytes += cells * sizeof(std::int64_t) * (sky_ ? 2.0 : 1.0) + most_side_bytes();
  return bytes + static_cast<double>(model_.canopy.size()) * sizeof(std::uint32_t);
}

double ReplicateMaker::most_side_bytes() const {
  if (!indirect_) return 0.0;
  const double sides = 2.0 * static_cast<double>(model_.canopy.size()) * static_cast<double>(model_.bands.size());
  return sides * sizeof(std::int64_t) * (sky_ ? 2.0 : 1.0);
}

// Light is not aimed in a scene with receivers.
TraceOutcome ReplicateMaker::count_beam(std::span<const BeamPart> beam, Replicate& replicate, const StopQuestion& stop) {
  const shared::BeamBlock& first = beam.front().block;
  if (receivers_) {
    return count_beam_landings(model_, layout_, *receivers_, tracer_, first, replicate.counters, replicate.passed, stop);
  }
  TraceOutcome outcome = tracer_.count_beam(first, replicate.counters, stop);
  for (const BeamPart& part : beam.subspan(1)) {
    if (outcome == TraceOutcome::stopped) break;
    outcome = count_beam_landings(model_, layout_, tracer_, part, replicate.counters, stop);
  }
  return outcome;
}

std::optional<Replicate> ReplicateMaker::make(const ReplicateOrder& order, const Conversion& conversion,
                                              const StopQuestion& stop) {
  if (stop()) return std::nullopt;
  const Clock::time_point start = Clock::now();
  std::optional<Replicate> replicate(std::in_place);
  replicate->counters.resize(layout_.words());
  if (receivers_) replicate->passed = PlaneSums(*receivers_, model_);
  std::vector<BeamPart> beam;
  if (model_.has_beam()) {
    beam = make_beam_parts(model_, layout_, aim(order.aimed), order.beam_rays, order.seed, order.number);
    if (count_beam(beam, *replicate, stop) == TraceOutcome::stopped) return std::nullopt;
  }
  replicate->direct = conversion.sum(replicate->counters);
  replicate->direct_s = seconds_since(start);
  if (!indirect_ || order.packets == 0.0) return replicate;
  const FirstLandings first{beam,
                            aim(order.aimed),
                            sky_ ? &sky(order.aimed) : nullptr,
                            replicate->direct.met,
                            conversion.scattered(replicate->direct),
                            conversion.scattered_by_zone(replicate->direct, replicate->passed),
                            conversion.least_of_vegetation(replicate->direct)};
  std::unique_ptr<PassArrays> arrays = spare_.take();
  replicate->packets = run_indirect_pass(*indirect_, order, first, conversion.quanta, *arrays, stop);
  spare_.give_back(std::move(arrays));
  replicate->indirect_s = seconds_since(start) - replicate->direct_s;
  if (!replicate->packets) return std::nullopt;
  return replicate;
}

}  // namespace sunfleck
