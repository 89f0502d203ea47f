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

TraceOutcome RememberedBeams::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                         const StopQuestion& stop) {
  const auto known = std::find_if(beams_.begin(), beams_.end(), [&](const Beam& one) { return same(one.block, beam); });
  if (known != beams_.end()) {
    for (const auto& [word, count] : known->landed) counters[word] += count;
    ++spared_;
    return TraceOutcome::finished;
  }
  if (!beams_.empty() && beams_.front().block.direction != beam.direction) forget();
  counted_.assign(counters.size(), 0);
  if (tracer_.count_beam(beam, counted_, stop) == TraceOutcome::stopped) return TraceOutcome::stopped;
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
  if (keep) {
    bytes_ += bytes;
    beams_.push_back(std::move(kept));
  }
  return TraceOutcome::finished;
}

TraceOutcome RememberedBeams::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                    std::span<shared::Landing> landings, const StopQuestion& stop) {
  return tracer_.trace(scene, packets, landings, stop);
}

}  // namespace sunfleck
