#include "devices/tracers/remembered_beams.h"

#include <algorithm>
#include <cstring>

namespace sunfleck {
namespace {

// Blocks have no padding, since they are uploaded byte for byte.
bool same(const shared::BeamBlock& one, const shared::BeamBlock& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

}  // namespace

void RememberedBeams::forget() {
  beams_.clear();
  bytes_ = 0;
}

const RememberedBeams::Beam* RememberedBeams::find(const shared::BeamBlock& beam) const {
  const auto known = std::find_if(beams_.begin(), beams_.end(), [&](const Beam& one) { return same(one.block, beam); });
  return known == beams_.end() ? nullptr : &*known;
}

TraceOutcome RememberedBeams::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                         const StopQuestion& stop) {
  if (const Beam* const known = find(beam)) {
    for (const auto& [word, count] : known->landed) counters[word] += count;
    ++spared_;
    return TraceOutcome::finished;
  }
  counted_.assign(counters.size(), 0);
  const TraceOutcome outcome = tracer_.count_beam(beam, counted_, stop);
  if (outcome == TraceOutcome::finished) take_counted(beam, counters);
  return outcome;
}

std::optional<TraceOutcome> RememberedBeams::record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                         std::span<shared::Landing> landings, const StopQuestion& stop) {
  if (find(beam) != nullptr) return std::nullopt;
  counted_.assign(counters.size(), 0);
  const std::optional<TraceOutcome> outcome = tracer_.record_beam(beam, counted_, landings, stop);
  if (outcome == TraceOutcome::finished) take_counted(beam, counters);
  return outcome;
}

std::optional<KeptBeam> RememberedBeams::keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                   const StopQuestion& stop) {
  if (find(beam) != nullptr) return std::nullopt;
  counted_.assign(counters.size(), 0);
  std::optional<KeptBeam> kept = tracer_.keep_beam(beam, counted_, stop);
  if (kept && kept->outcome == TraceOutcome::finished) take_counted(beam, counters);
  return kept;
}

// Adds the counts of a beam to the counters, and remembers them if they fit.
void RememberedBeams::take_counted(const shared::BeamBlock& beam, std::span<std::uint32_t> counters) {
  if (!beams_.empty() && beams_.front().block.direction != beam.direction) forget();
  const auto words =
      static_cast<std::size_t>(counted_.size() - static_cast<std::size_t>(std::count(counted_.begin(), counted_.end(), 0U)));
  Beam kept{beam, {}};
  const std::size_t bytes = words * sizeof(kept.landed[0]);
  const bool keep = bytes_ + bytes <= most_bytes_;
  if (keep) kept.landed.reserve(words);
  for (std::uint32_t word = 0; word < counted_.size(); ++word) {
    if (counted_[word] == 0) continue;
    counters[word] += counted_[word];
    if (keep) kept.landed.emplace_back(word, counted_[word]);
  }
  if (!keep) return;
  bytes_ += bytes;
  beams_.push_back(std::move(kept));
}

TraceOutcome RememberedBeams::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                    std::span<shared::Landing> landings, const StopQuestion& stop) {
  return tracer_.trace(scene, packets, landings, stop);
}

std::optional<TraceOutcome> RememberedBeams::make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) {
  return tracer_.make_rounds(passes, stop);
}

}  // namespace sunfleck
