#include "physics/transport/indirect/replicate_maker.h"

#include "base/check.h"
#include "base/random.h"
#include "base/stopwatch.h"
#include "physics/light/beam_grid.h"
#include "physics/transport/indirect/beam_landings.h"
#include "physics/transport/indirect/counted_thread.h"
#include "physics/transport/indirect/indirect.h"
#include "physics/transport/model/beam_block.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace sunfleck {
namespace {

// Number of the first light's stream of random numbers, apart from those of replicates.
constexpr std::uint64_t light_stream = std::uint64_t{1} << 56U;

}  // namespace

std::unique_lock<std::mutex> ReplicateMaker::ForAllThreads::turn() {
  return takes_turns() ? std::unique_lock(mutex_) : std::unique_lock<std::mutex>();
}

TraceOutcome ReplicateMaker::ForAllThreads::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                       const StopQuestion& stop) {
  const std::unique_lock lock = turn();
  return tracer_.count_beam(beam, counters, stop);
}

std::optional<TraceOutcome> ReplicateMaker::ForAllThreads::record_beam(const shared::BeamBlock& beam,
                                                                       std::span<std::uint32_t> counters,
                                                                       std::span<shared::Landing> landings,
                                                                       const StopQuestion& stop) {
  const std::unique_lock lock = turn();
  return tracer_.record_beam(beam, counters, landings, stop);
}

std::optional<KeptBeam> ReplicateMaker::ForAllThreads::keep_beam(const shared::BeamBlock& beam,
                                                                 std::span<std::uint32_t> counters, const StopQuestion& stop) {
  const std::unique_lock lock = turn();
  return tracer_.keep_beam(beam, counters, stop);
}

TraceOutcome ReplicateMaker::ForAllThreads::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                                  std::span<shared::Landing> landings, const StopQuestion& stop) {
  const std::unique_lock lock = turn();
  return tracer_.trace(scene, packets, landings, stop);
}

std::optional<TraceOutcome> ReplicateMaker::ForAllThreads::make_rounds(std::span<const RoundsPass> passes,
                                                                       const StopQuestion& stop) {
  if (!takes_turns()) return tracer_.make_rounds(passes, stop);
  EXPECT(passes.size(), ==, 1U);
  WaitingPass own{passes.front(), &stop, false, {}, {}};
  {
    const std::lock_guard lock(waiting_mutex_);
    waiting_.push_back(&own);
  }
  std::unique_lock<std::mutex> lock;
  {
    const UncountedThread waits;
    lock = turn();
  }
  if (!own.is_made) make_waiting(own);
  if (own.error) std::rethrow_exception(own.error);
  return own.outcome;
}

std::vector<ReplicateMaker::ForAllThreads::WaitingPass*> ReplicateMaker::ForAllThreads::take_waiting(WaitingPass& own) {
  const std::lock_guard lock(waiting_mutex_);
  const auto first = waiting_.begin();
  std::iter_swap(first, std::find(first, waiting_.end(), &own));
  const auto end = first + static_cast<std::ptrdiff_t>(std::min(waiting_.size(), tracer_.most_passes()));
  std::vector<WaitingPass*> taken(first, end);
  waiting_.erase(first, end);
  return taken;
}

// Each thread has a question of its own, so that a pass that is no longer wanted stops no other.
void ReplicateMaker::ForAllThreads::make_waiting(WaitingPass& own) {
  std::vector<WaitingPass*> waiting = take_waiting(own);
  for (WaitingPass* each : waiting) each->is_made = true;
  const auto wanted = std::partition(waiting.begin(), waiting.end(), [](const WaitingPass* each) { return !(*each->stop)(); });
  std::for_each(wanted, waiting.end(), [](WaitingPass* each) { each->outcome = TraceOutcome::stopped; });
  waiting.erase(wanted, waiting.end());
  try {
    if (!waiting.empty()) make_together(waiting);
  } catch (...) {
    for (WaitingPass* each : waiting) each->error = std::current_exception();
  }
}

void ReplicateMaker::ForAllThreads::make_together(std::span<WaitingPass* const> waiting) {
  std::vector<RoundsPass> passes;
  for (const WaitingPass* each : waiting) passes.push_back(each->pass);
  const auto none_wanted = [&] {
    return std::all_of(waiting.begin(), waiting.end(), [](const WaitingPass* each) { return (*each->stop)(); });
  };
  const std::optional<TraceOutcome> outcome = tracer_.make_rounds(passes, none_wanted);
  if (outcome || waiting.size() == 1) {
    for (WaitingPass* each : waiting) each->outcome = outcome;
    return;
  }
  for (std::size_t k = 0; k < waiting.size(); ++k) make_together(waiting.subspan(k, 1));
}

ReplicateMaker::ReplicateMaker(Lights lights, const CounterLayout& layout, Tracer& tracer)
    : lights_(lights),
      model_(lights.front()),
      layout_(layout),
      surfaces_(model_),
      areas_(lights.size()),
      aim_(make_stand_aim(model_, layout)),
      tracer_(tracer) {
  tbb::parallel_for(std::size_t{0}, lights.size(),
                    [&](std::size_t k) { areas_[k] = std::make_unique<CanopyAreas>(lights[k], layout, surfaces_); });
  if (!model_.planes.empty()) receivers_.emplace(model_, layout, surfaces_);
  if (any_sky(lights)) sky_.emplace(lights, layout, nullptr);
  if (any_sky(lights) && aim_) aimed_sky_.emplace(lights, layout, &*aim_);
  if (!scatters(model_) && !sky_) return;
  indirect_.emplace(lights, layout, surfaces_, tracer_, receivers());
}

Incidence ReplicateMaker::incidence(double beam_rays, bool aimed, std::size_t light) const {
  Incidence incidence;
  incidence.sky_ground_m2 = sky_ ? sky(aimed).ground_m2(light) : 0.0;
  incidence.sky_weight = sky_ ? sky(aimed).largest_weight(light) : 1.0;
  if (!lights_[light].has_beam()) return incidence;
  const std::vector<WeightedBeamGrid> grids = make_grids(lights_[light], layout_, aim(aimed), beam_rays);
  incidence.ground_per_ray_m2 = grids.front().grid.horizontal_area_per_ray_m2();
  for (const WeightedBeamGrid& part : grids) {
    incidence.rays += part.weight * part.grid.rays();
    incidence.traced_rays += part.grid.rays();
    incidence.largest_weight = std::max(incidence.largest_weight, part.weight);
  }
  return incidence;
}

Conversion ReplicateMaker::conversion(const Incidence& incidence, std::size_t light) const {
  return {lights_[light], layout_, surfaces_, *areas_[light], receivers(), incidence};
}

ReplicateSet ReplicateMaker::blank(const ReplicateOrder& order) const {
  Replicate blank;
  blank.counters.resize(layout_.words());
  if (receivers_) blank.passed = PlaneSums(*receivers_, model_);
  if (!indirect_ || order.packets == 0.0) return ReplicateSet(lights_.size(), blank);
  blank.packets.emplace(model_, layout_, surfaces_);
  if (order.counts_hits) blank.packets->element_hits.resize(model_.canopy.size());
  if (receivers_) blank.packets->receivers = blank.passed;
  if (sky_) {
    blank.packets->side_sky = blank.packets->side_landed;
    blank.packets->cell_sky = blank.packets->cell_landed;
  }
  return ReplicateSet(lights_.size(), blank);
}

std::size_t ReplicateMaker::most_at_once() const {
  constexpr std::size_t while_one_is_traced = 2;
  return tracer_.takes_turns() && tracer_.device().software ? while_one_is_traced : std::numeric_limits<std::size_t>::max();
}

double ReplicateMaker::sum_bytes() const {
  const auto lights = static_cast<double>(lights_.size());
  double bytes = lights * static_cast<double>(layout_.words()) * sizeof(std::uint32_t) + plane_bytes();
  if (!indirect_) return bytes;
  return bytes + most_place_bytes().all() + static_cast<double>(model_.canopy.size()) * sizeof(std::uint32_t);
}

// Returns the memory for what passes the receivers: PlaneSums of each light for the beam and for packets, which are dealt to several
// lights from joint ones.
double ReplicateMaker::plane_bytes() const {
  if (!receivers_) return 0.0;
  const double of_packets = !indirect_ ? 0.0 : lights_.size() == 1 ? 1.0 : 2.0;
  const double cell_bytes = 2.0 * sizeof(std::uint32_t) + static_cast<double>(model_.bands.size()) * sizeof(std::int64_t);
  return static_cast<double>(receivers_->cells() * lights_.size()) * (1.0 + of_packets) * cell_bytes;
}

PlaceBytes ReplicateMaker::most_place_bytes() const {
  if (!indirect_) return {};
  // The sums of several lights are dealt to them from joint ones. Those of cells are counted once: light hardly ever reaches all
  // of a wide map, and what is counted here is set aside before packets get their memory.
  const auto lights = static_cast<double>(lights_.size());
  const double copies = lights_.size() == 1 ? 1.0 : 2.0 * lights;
  const double place_bytes = static_cast<double>(model_.bands.size()) * sizeof(std::int64_t) * (sky_ ? 2.0 : 1.0);
  return {copies * 2.0 * static_cast<double>(model_.canopy.size()) * place_bytes,
          lights * static_cast<double>(layout_.cells()) * place_bytes};
}

double ReplicateMaker::device_sum_bytes() const {
  if (!indirect_ || !tracer_.takes_turns() || tracer_.device().software) return 0.0;
  const double columns = static_cast<double>(model_.bands.size()) * static_cast<double>(lights_.size());
  double places = 2.0 * static_cast<double>(model_.canopy.size()) + static_cast<double>(layout_.cells());
  if (receivers_) places += static_cast<double>(receivers_->cells());
  return places * columns * sizeof(std::int64_t) + static_cast<double>(model_.canopy.size()) * sizeof(std::uint32_t);
}

// A ray that is recorded takes a small part of the time of one that is traced again. Where there are receivers, all would have to be
// traced one by one.
double ReplicateMaker::most_recorded(double landings) const {
  constexpr double rays_per_landing = 2.0;
  constexpr double through_receivers_per_landing = 16.0;
  constexpr double least_through_receivers = 1U << 20U;
  if (receivers_) return std::max(least_through_receivers, through_receivers_per_landing * landings);
  return indirect_ && lights_.size() == 1 ? rays_per_landing * landings : 0.0;  // several lights take a few landings of each
}

double ReplicateMaker::record_bytes(double beam_rays, double landings) const {
  const double most = most_recorded(landings);
  const double recorded = receivers_ ? std::min(beam_rays, most) : beam_rays <= most ? beam_rays : 0.0;
  return recorded * sizeof(shared::Landing);
}

bool ReplicateMaker::keeps_landings(const ReplicateOrder& order) const {
  return indirect_ && order.packets > 0.0 && lights_.size() == 1 && aim(order.aimed) == nullptr && !receivers_;
}

// Light is not aimed in a scene with receivers.
TraceOutcome ReplicateMaker::count_beam(const ReplicateOrder& order, Replicate& replicate, FirstLandings& first,
                                        std::vector<shared::Landing>& recorded, const StopQuestion& stop) {
  const shared::BeamBlock& block = first.beam.front().block;
  const std::uint64_t rays = first.beam.front().rays();
  const bool records = static_cast<double>(rays) <= most_recorded(std::min(order.packets, order.sampled_rays));
  const bool alone = first.beam.size() == 1;  // rays of other parts have other weights
  if (keeps_landings(order)) {
    if (const std::optional<KeptBeam> kept = tracer_.keep_beam(block, replicate.counters, stop)) {
      first.kept = kept->landings;
      return kept->outcome;
    }
  }
  if (alone && records) {
    recorded.resize(rays);
    const std::optional<TraceOutcome> outcome = tracer_.record_beam(block, replicate.counters, recorded, stop);
    if (outcome == TraceOutcome::finished && receivers_) add_crossings(model_, *receivers_, block, recorded, replicate.passed);
    if (outcome && lights_.size() == 1) first.recorded = recorded;
    if (outcome) return *outcome;
  }
  if (receivers_) {
    return count_beam_landings(model_, layout_, *receivers_, tracer_, block, replicate.counters, replicate.passed, stop);
  }
  TraceOutcome outcome = tracer_.count_beam(block, replicate.counters, stop);
  for (const BeamPart& part : std::span(first.beam).subspan(1)) {
    if (outcome == TraceOutcome::stopped) break;
    outcome = count_beam_landings(model_, layout_, tracer_, part, replicate.counters, stop);
  }
  return outcome;
}

bool ReplicateMaker::make_direct(const ReplicateOrder& order, std::size_t light, const Conversion& conversion,
                                 Replicate& replicate, FirstLandings& first, std::vector<shared::Landing>& recorded,
                                 const StopQuestion& stop) {
  replicate.counters = spare_counters_.zeros(layout_.words());
  if (receivers_) replicate.passed = PlaneSums(*receivers_, model_);
  if (lights_[light].has_beam()) {
    // The rays of different lights are independent of each other.
    const std::uint64_t seed = light == 0 ? order.seed : RandomStream(order.seed, light_stream + light).word();
    first.beam = make_beam_parts(lights_[light], layout_, aim(order.aimed), order.rays_of(light), seed, order.number);
    if (count_beam(order, replicate, first, recorded, stop) == TraceOutcome::stopped) return false;
  }
  replicate.direct = conversion.sum(replicate.counters);
  if (!indirect_ || order.packets == 0.0) return true;
  first.ground_per_ray_m2 = conversion.ground_per_ray_m2;
  first.met = replicate.direct.met;
  first.scattered = conversion.scattered(replicate.direct);
  first.scattered_by_zone = conversion.scattered_by_zone(replicate.direct, replicate.passed);
  first.least_of_vegetation = conversion.least_of_vegetation(replicate.direct);
  return true;
}

void ReplicateMaker::take_back(ReplicateSet replicates) {
  for (Replicate& replicate : replicates) {
    spare_counters_.give_back(std::move(replicate.counters));
    if (!replicate.packets) continue;
    for (const auto sums : IndirectSums::by_place) spare_.give_back((*replicate.packets).*sums);
  }
}

void ReplicateMaker::free_spare_memory() {
  spare_.free();
  spare_counters_.free();
}

std::optional<ReplicateSet> ReplicateMaker::make(const ReplicateOrder& order, std::span<const Conversion> conversions,
                                                 const StopQuestion& stop) {
  if (stop()) return std::nullopt;
  const CountedThread thread;
  std::unique_ptr<PassArrays> arrays = spare_.take();
  std::optional<ReplicateSet> made = make(order, conversions, *arrays, stop);
  spare_.give_back(std::move(arrays));
  return made;
}

std::optional<ReplicateSet> ReplicateMaker::make(const ReplicateOrder& order, std::span<const Conversion> conversions,
                                                 PassArrays& arrays, const StopQuestion& stop) {
  Stopwatch watch;
  ReplicateSet replicates(lights_.size());
  LightFromAbove light{aim(order.aimed), sky_ ? &sky(order.aimed) : nullptr, std::vector<FirstLandings>(lights_.size()), {}};
  for (std::size_t k = 0; k < lights_.size(); ++k) {
    if (!make_direct(order, k, conversions[k], replicates[k], light.first[k], arrays.recorded, stop)) return std::nullopt;
    light.quanta.push_back(&conversions[k].quanta);
  }
  const double direct_s = watch.lap();
  double indirect_s = 0.0;
  if (indirect_ && order.packets > 0.0) {
    std::optional<IndirectSums> packets = run_indirect_pass(*indirect_, order, light, arrays, stop);
    if (!packets) return std::nullopt;
    std::vector<IndirectSums> by_light = sums_by_light(*std::move(packets), lights_.size(), arrays.memory);
    for (std::size_t k = 0; k < lights_.size(); ++k) replicates[k].packets = std::move(by_light[k]);
    indirect_s = watch.lap();
  }
  const auto lights = static_cast<double>(lights_.size());
  for (Replicate& replicate : replicates) {
    replicate.direct_s = direct_s / lights;
    replicate.indirect_s = indirect_s / lights;
  }
  return replicates;
}

}  // namespace sunfleck
