#pragma once
// The steps of the rounds of indirect passes, as shaders of shaders/rounds do them on a device.

#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "devices/gpu/context.h"
#include "devices/gpu/submission.h"
#include "devices/tracers/kept_landings.h"
#include "devices/tracers/round_buffers.h"
#include "physics/transport/indirect/device_rounds.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace sunfleck {

// Each step is recorded in a submission and sees what earlier ones left in the buffers. The order of a round is that of the
// functions. Several passes may be made side by side: a step is then one of all of them, with a dispatch for each lane.
class RoundSteps {
 public:
  static constexpr shared::RoundPush every_packet{0, shared::all_packets};

  // Returns whether a device has all that the steps need: 64-bit integers that can be added to atomically, and as many buffers
  // as a shader reads and writes.
  [[nodiscard]] static bool work_on(const DeviceLimits& limits);

  // The context must outlive the object.
  RoundSteps(const GpuContext& context, const shared::RoundChoices& choices, std::size_t packets_at_a_time);

  // Returns room for the landings of a beam, from which passes may start; see LandingBuffers::take.
  [[nodiscard]] std::shared_ptr<const LandingsOnDevice> keep_landings(std::size_t rays) { return landings_.take(rays); }

  // Makes room for passes of one scene. Returns how many of them it has room for side by side; 0 if each is too large for the
  // device or its free memory.
  [[nodiscard]] std::size_t make_room(std::span<const RoundsPass> passes);
  // Gives the device passes for which there is room, each in a lane, with an empty outbox, and lets flux wait at the landings
  // that the device has kept for them. Later steps are those of these lanes.
  void give(Submission& submission, std::span<const RoundsPass> passes);

  // Ends the round before, and begins one unless no column is left (RoundState::done), or the lane's outbox is not empty
  // (RoundState::has_to_wait); in both cases the other steps do nothing.
  void begin(Submission& submission);
  void begin(Submission& submission, std::size_t lane);
  // Moves the places to their parts, as WaitingFlux::take_sorted does.
  void sort(Submission& submission);
  // Draws packets from them, as PacketDraw does: RoundState::packets.
  void draw(Submission& submission);
  // Finds what the packets carry, takes it off the places, and empties the outbox.
  void weigh(Submission& submission);
  // Starts some of them, as PacketStarts does, and orders them by direction. There are at most `packets_at_a_time`.
  void start(Submission& submission, shared::RoundPush packets = every_packet);
  // Books where they landed, as PacketBooks does, unless the lane's outbox holds packets that are still on their way.
  void book(Submission& submission, shared::RoundPush packets = every_packet);
  // Does the same in one lane, with another outbox if one is given.
  void book(Submission& submission, std::size_t lane, shared::RoundPush packets, const GpuBuffer* outbox);

  // Fetches the states that the steps so far leave, [lane]; they are there once the submission is finished.
  void fetch(Submission& submission, std::span<shared::RoundState> states) const;
  // Fetches the sums of all lanes.
  void fetch(std::span<const RoundsPass> passes) const;

  [[nodiscard]] const GpuBuffer& buffer(RoundBuffer which, std::size_t lane = 0) const { return buffers_.at(lane, which); }
  [[nodiscard]] const RoundSizes& sizes() const { return sizes_; }

 private:
  // Each is the shader of its name.
  struct Shaders {
    explicit Shaders(const GpuContext& context);
    ComputePipeline first_sum, first_load, first_wait, collect, begin, count, sum_blocks, sum_spine, sum_up, sort, expect, plan,
        take, weigh, load, emit, order, book;
  };

  // Lanes from one number to another.
  struct Lanes {
    std::size_t first, end;
  };
  [[nodiscard]] Lanes all_lanes() const { return {0, lanes_}; }

  void give(Submission& submission, std::size_t lane, const RoundsOrder& order);
  void give_scene(Submission& submission, const IndirectScene& scene);
  // Does what IndirectPass::add_equal_points does on the host.
  void add_landings(Submission& submission, std::span<const RoundsPass> passes);
  void run_sampled(Submission& submission, std::span<const RoundsPass> passes, ComputePipeline& shader);
  void begin(Submission& submission, Lanes lanes);
  // Turns numbers of a kind into running sums; `groups` is the kind of their groups.
  void sum(Submission& submission, std::uint32_t kind, std::uint32_t groups);
  // Run a shader with a number of threads, or in all lanes with as many groups as the device has found for a kind.
  void run(Submission& submission, Lanes lanes, ComputePipeline& shader, std::uint64_t threads, shared::RoundPush push = {},
           const OtherBuffer& instead = {});
  void run_groups(Submission& submission, ComputePipeline& shader, std::uint32_t kind, shared::RoundPush push = {});
  // Runs a shader with a thread for each packet, in all lanes.
  void run_packets(Submission& submission, ComputePipeline& shader, shared::RoundPush packets);
  template <class T>
  void upload(Submission& submission, std::size_t lane, RoundBuffer to, std::span<const T> values) const {
    submission.upload(buffer(to, lane), std::as_bytes(values));
  }

  const GpuContext& context_;
  shared::RoundChoices choices_;
  std::size_t packets_at_a_time_;
  RoundSizes sizes_;                                                      // of the passes
  std::size_t refused_places_ = std::numeric_limits<std::size_t>::max();  // of a pass for which memory was short
  std::size_t most_lanes_ = std::numeric_limits<std::size_t>::max();      // fewer once it was short for more
  LandingBuffers landings_;
  RoundBuffers buffers_;
  std::size_t lanes_ = 0;           // in use
  std::uint64_t scene_number_ = 0;  // of the scene on the device
  Shaders shaders_;
};

}  // namespace sunfleck
