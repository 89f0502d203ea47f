#pragma once
// The steps of the rounds of an indirect pass, as shaders of shaders/rounds do them on a device.

#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "devices/gpu/context.h"
#include "devices/gpu/submission.h"
#include "devices/tracers/round_buffers.h"
#include "physics/transport/indirect/device_rounds.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sunfleck {

// Each step is recorded in a submission and sees what earlier ones left in the buffers. The order of a round is that of the functions.
class RoundSteps {
 public:
  static constexpr shared::RoundPush every_packet{0, shared::all_packets};

  // Returns whether a device has all that the steps need: 64-bit integers that can be added to atomically, and as many buffers as a
  // shader reads and writes.
  [[nodiscard]] static bool work_on(const DeviceLimits& limits);

  // The context must outlive the object.
  RoundSteps(const GpuContext& context, const shared::RoundChoices& choices, std::size_t packets_at_a_time);

  // Makes room for a pass. Returns false if it is too large for the device or its free memory.
  [[nodiscard]] bool make_room(const RoundsOrder& order);
  // Gives the device a pass for which there is room.
  void give(Submission& submission, const RoundsOrder& order);

  // The outbox of the following steps, until another is set: packets that are still on their way. Without one there are none.
  void set_outbox(const GpuBuffer* outbox) { outbox_ = outbox; }

  // Ends the round before, and begins one unless no column is left (RoundState::done), or the outbox is not empty
  // (RoundState::has_to_wait); in both cases the other steps do nothing.
  void begin(Submission& submission);
  // Moves the places to their parts, as WaitingFlux::take_sorted does.
  void sort(Submission& submission);
  // Draws packets from them, as PacketDraw does: RoundState::packets.
  void draw(Submission& submission);
  // Finds what the packets carry, takes it off the places, and empties the outbox.
  void weigh(Submission& submission);
  // Starts some of them, as PacketStarts does, and orders them by direction. There are at most `packets_at_a_time`.
  void start(Submission& submission, shared::RoundPush packets = every_packet);
  // Books where they landed, as PacketBooks does, unless the outbox holds packets that are still on their way.
  void book(Submission& submission, shared::RoundPush packets = every_packet);

  // Fetches the state that the steps so far leave; it is there once the submission is finished.
  void fetch(Submission& submission, shared::RoundState& state) const;
  // Fetches the sums of the pass.
  void fetch(RoundsSums& sums) const;

  [[nodiscard]] const GpuBuffer& buffer(RoundBuffer which) const { return buffers_[which]; }
  [[nodiscard]] const RoundSizes& sizes() const { return sizes_; }

 private:
  // Each is the shader of its name.
  struct Shaders {
    explicit Shaders(const GpuContext& context);
    ComputePipeline collect, begin, count, sum_blocks, sum_spine, sum_up, sort, expect, plan, take, weigh, load, emit, order,
        book;
  };

  void give_scene(Submission& submission, const IndirectScene& scene);
  // Turns numbers of a kind into running sums; `groups` is the kind of their groups.
  void sum(Submission& submission, std::uint32_t kind, std::uint32_t groups);
  // Run a shader with a number of threads, or with as many groups as the device has found for a kind.
  void run(Submission& submission, ComputePipeline& shader, std::uint64_t threads, shared::RoundPush push = {});
  void run_groups(Submission& submission, ComputePipeline& shader, std::uint32_t kind, shared::RoundPush push = {});
  [[nodiscard]] std::vector<const GpuBuffer*> bound() const;
  template <class T>
  void upload(Submission& submission, RoundBuffer to, std::span<const T> values) const {
    submission.upload(buffers_[to], std::as_bytes(values));
  }

  const GpuContext& context_;
  shared::RoundChoices choices_;
  std::size_t packets_at_a_time_;
  RoundSizes sizes_;                                                      // of the pass
  std::size_t refused_places_ = std::numeric_limits<std::size_t>::max();  // of a pass for which memory was short
  RoundBuffers buffers_;
  GpuBuffer nothing_;  // an empty outbox
  const GpuBuffer* outbox_ = nullptr;
  std::uint64_t scene_number_ = 0;  // of the scene on the device
  Shaders shaders_;
};

}  // namespace sunfleck
