#pragma once
// The steps of the rounds of an indirect pass, as shaders of shaders/rounds do them on a device.

#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "devices/gpu/context.h"
#include "devices/gpu/submission.h"
#include "devices/tracers/round_buffers.h"
#include "physics/transport/indirect/device_rounds.h"

#include <cstdint>
#include <span>

namespace sunfleck {

// Each step is recorded in a submission and sees what earlier ones left in the buffers. The order of a round is that of the functions.
class RoundSteps {
 public:
  // Returns whether a device has all that the steps need: 64-bit integers that can be added to atomically, and as many buffers as a
  // shader reads and writes.
  [[nodiscard]] static bool work_on(const DeviceLimits& limits);

  // The context must outlive the object. Without copies, `choices` stand for a default for software or hardware.
  RoundSteps(const GpuContext& context, const shared::RoundChoices& choices, std::size_t packets_at_a_time);

  // Gives the device a pass. Returns false, and does nothing, if it is too large.
  [[nodiscard]] bool take(const RoundsOrder& order);

  // Ends the round before, and begins one unless no column is left: RoundState::done.
  void begin(Submission& submission);
  // Moves so many places to their parts, as WaitingFlux::take_sorted does.
  void sort(Submission& submission, std::uint32_t places);
  // Draws packets from them, as PacketDraw does: RoundState::packets.
  void draw(Submission& submission, std::uint32_t places);
  // Finds what so many packets carry, and takes it off the places.
  void weigh(Submission& submission, std::uint32_t places, std::uint32_t packets);
  // Starts some of them, as PacketStarts does, and orders them by direction. There are at most `packets_at_a_time`.
  void start(Submission& submission, shared::RoundPush packets);
  // Books where they landed, as PacketBooks does, unless the outbox holds packets that are still on their way.
  void book(Submission& submission, shared::RoundPush packets, const GpuBuffer& outbox);
  void book(Submission& submission, shared::RoundPush packets) { book(submission, packets, nothing_); }

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

  void give_scene(const IndirectScene& scene);
  void give_pass(const RoundsOrder& order);
  // Turns numbers into running sums.
  void sum(Submission& submission, std::uint32_t numbers);
  void run(Submission& submission, ComputePipeline& shader, std::uint64_t threads, shared::RoundPush push);
  void run(Submission& submission, ComputePipeline& shader, std::uint64_t threads, shared::RoundPush push,
           const GpuBuffer& outbox);
  template <class T>
  void upload(Submission& submission, RoundBuffer to, std::span<const T> values) const {
    submission.upload(buffers_[to], std::as_bytes(values));
  }

  const GpuContext& context_;
  shared::RoundChoices choices_;
  std::size_t packets_at_a_time_;
  RoundSizes sizes_;  // of the pass
  RoundBuffers buffers_;
  GpuBuffer nothing_;               // an empty outbox
  std::uint64_t scene_number_ = 0;  // of the scene on the device
  Shaders shaders_;
};

}  // namespace sunfleck
