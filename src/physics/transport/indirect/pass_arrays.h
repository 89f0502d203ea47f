#pragma once
// The large arrays of an indirect pass. The next pass uses them again, so that their memory is not fetched anew from the system
// for each replicate: that took an eighth of the processor time of runs with millions of packets.

#include "physics/transport/indirect/arrivals.h"
#include "physics/transport/indirect/device_rounds.h"
#include "physics/transport/indirect/packet_draw.h"
#include "physics/transport/indirect/place_sums.h"
#include "physics/transport/indirect/waiting_flux.h"
#include "shared/layout.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace sunfleck {

// Largest number of rays or packets that are started, traced and booked together: enough to keep a GPU busy, and few enough
// that their arrays stay small beside those of the places.
inline constexpr std::size_t most_at_a_time = std::size_t{1} << 18U;

// Points at which beam rays landed; see landing_points.h.
struct LandingPoints {
  // [point], on the side on which the sampled ray landed; `u` is the ray's number in the sample.
  std::vector<EmissionPoint> places;
  // [point * lights + light], the flux of that light that lands there, relative to all points; below 0 where it lands on the
  // other side of the element. Empty if the same flux lands at every point.
  std::vector<double> weights;
};

// A pass overwrites what an earlier one left.
struct PassArrays {
  LandingPoints points;
  WaitingFlux waiting, next;
  DrawArrays draw;
  std::vector<shared::Landing> recorded;  // of all beam rays, if they are recorded
  std::vector<shared::Packet> packets;    // a part of a round
  std::vector<shared::Landing> landings;  // of these packets
  std::vector<Arrival> arrivals;          // some of their ends, and what they carry there, [arrival * columns + column]
  std::vector<std::int64_t> carried;
  RoundsSums found;                              // by a device that makes the rounds
  PlaceSums::Extent sides_landed, cells_landed;  // of the last pass
  PlaceMemory memory;                            // for sums
};

// Lends arrays to passes that run at the same time.
class SparePassArrays {
 public:
  [[nodiscard]] std::unique_ptr<PassArrays> take();
  void give_back(std::unique_ptr<PassArrays> arrays);
  // Keeps the memory of sums for other passes.
  void give_back(PlaceSums& sums) { sums.give_back(sums_); }
  // Frees the arrays and blocks that nothing uses; blocks that are in use go to the system afterwards.
  void free();

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<PassArrays>> spare_;
  std::shared_ptr<SpareBlocks> blocks_ = std::make_shared<SpareBlocks>();
  SpareVectors<std::int64_t> sums_;
};

}  // namespace sunfleck
