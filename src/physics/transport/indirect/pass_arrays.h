#pragma once
// The large arrays of an indirect pass. The next pass uses them again, so that their memory is not fetched anew from the system for
// each replicate: that took an eighth of the processor time of runs with millions of packets.

#include "physics/canopy/optics.h"
#include "physics/transport/indirect/candidates.h"
#include "shared/layout.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace sunfleck {

// Largest number of rays or packets that are started, traced and booked together: enough to keep a GPU busy, and few enough that their
// arrays stay small beside the candidates.
inline constexpr std::size_t most_at_a_time = std::size_t{1} << 18U;

// A side that the light of a sampled beam ray leaves, and the optics of the face on which it landed.
struct BeamSource {
  EmissionPoint place;
  bool transmitted = false;
  double rays = 1.0;                              // that the sampled one stands for, by weight, up to a common factor
  const std::vector<FaceOptics>* face = nullptr;  // null for the soil plane
};

// A pass overwrites what an earlier one left.
struct PassArrays {
  explicit PassArrays(std::size_t bands) : waiting(bands), next(bands) {}

  std::vector<BeamSource> sources;
  Candidates waiting, next;
  SortSpace sorting;
  std::vector<double> expected;  // [candidate], number of times that it is drawn on average
  Draw draw;
  std::vector<shared::Packet> packets;    // a part of a round
  std::vector<shared::Landing> landings;  // of these packets
};

// Lends arrays to passes that run at the same time.
class SparePassArrays {
 public:
  explicit SparePassArrays(std::size_t bands) : bands_(bands) {}

  [[nodiscard]] std::unique_ptr<PassArrays> take();
  void give_back(std::unique_ptr<PassArrays> arrays);
  // Frees the arrays that no pass uses.
  void free();

 private:
  std::size_t bands_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<PassArrays>> spare_;
};

}  // namespace sunfleck
