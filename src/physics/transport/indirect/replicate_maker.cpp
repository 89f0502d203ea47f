#include "physics/transport/indirect/replicate_maker.h"

#include "physics/light/beam_grid.h"
#include "physics/transport/indirect/beam_landings.h"
#include "physics/transport/model/beam_block.h"

#include <chrono>

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
    : model_(model), layout_(layout), surfaces_(model), tracer_(tracer) {
  if (!model.planes.empty()) receivers_.emplace(model, layout, surfaces_);
  if (model.has_sky()) sky_.emplace(model, layout);
  if (!scatters(model) && !sky_) return;
  indirect_.emplace(model, layout, surfaces_, tracer_, sky_ ? &*sky_ : nullptr, receivers());
}

Incidence ReplicateMaker::incidence(double beam_rays) const {
  Incidence incidence;
  incidence.sky_ground_m2 = sky_ ? sky_->ground_m2() : 0.0;
  if (!model_.has_beam()) return incidence;
  const BeamGrid grid = make_grid(model_, layout_, beam_rays);
  incidence.rays = grid.rays();
  incidence.ground_per_ray_m2 = grid.horizontal_area_per_ray_m2();
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

TraceOutcome ReplicateMaker::count_beam(const shared::BeamBlock& beam, Replicate& replicate, const StopQuestion& stop) {
  if (!receivers_) return tracer_.count_beam(beam, replicate.counters, stop);
  return count_beam_landings(model_, layout_, *receivers_, tracer_, beam, replicate.counters, replicate.passed, stop);
}

std::optional<Replicate> ReplicateMaker::make(const ReplicateOrder& order, const Conversion& conversion,
                                              const StopQuestion& stop) {
  if (stop()) return std::nullopt;
  const Clock::time_point start = Clock::now();
  std::optional<Replicate> replicate(std::in_place);
  replicate->counters.resize(layout_.words());
  if (receivers_) replicate->passed = PlaneSums(*receivers_, model_);
  std::optional<shared::BeamBlock> beam;
  if (model_.has_beam()) {
    beam = make_beam_block(model_, layout_, order.beam_rays, order.seed, order.number);
    if (count_beam(*beam, *replicate, stop) == TraceOutcome::stopped) return std::nullopt;
  }
  replicate->direct = conversion.sum(replicate->counters);
  replicate->direct_s = seconds_since(start);
  if (!indirect_ || order.packets == 0.0) return replicate;
  const FirstLandings first{beam ? &*beam : nullptr, replicate->direct.met, conversion.scattered(replicate->direct),
                            conversion.scattered_by_zone(replicate->direct, replicate->passed)};
  replicate->packets = run_indirect_pass(*indirect_, order, first, conversion.quanta, stop);
  replicate->indirect_s = seconds_since(start) - replicate->direct_s;
  if (!replicate->packets) return std::nullopt;
  return replicate;
}

}  // namespace sunfleck
