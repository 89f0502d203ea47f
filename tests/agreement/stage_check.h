#pragma once
// A tracer that makes the rounds of indirect passes twice, on the host and on a device, and compares what each stage of each
// round leaves.

#include "devices/tracers/round_steps.h"
#include "physics/transport/indirect/arrivals.h"
#include "physics/transport/indirect/device_rounds.h"
#include "physics/transport/indirect/packet_draw.h"
#include "physics/transport/indirect/packet_starts.h"
#include "physics/transport/indirect/place_aim.h"
#include "support/landings.h"
#include "support/wrapped_tracer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace sunfleck::test {

class StageCheck final : public WrappedTracer {
 public:
  // All arguments except the choices must outlive the object. Packets are started `at_a_time`.
  StageCheck(const GpuContext& context, Tracer& cpu, const shared::RoundChoices& choices, std::uint32_t at_a_time)
      : WrappedTracer(cpu), context_(context), cpu_(cpu), steps_(context, choices, at_a_time), at_a_time_(at_a_time) {}

  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override;

  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) override;

  // Returns how many rounds were compared.
  [[nodiscard]] std::uint64_t rounds() const { return rounds_; }
  // Returns from how many landings that the device kept packets started.
  [[nodiscard]] std::uint64_t sampled() const { return sampled_; }

 private:
  // What the host has of a pass.
  struct Host {
    explicit Host(const RoundsOrder& order);

    const RoundsOrder& order;
    ColumnRange columns;
    Scattering scattering;
    std::optional<PlaceAim> aim;
    DrawArrays arrays;
    PacketDraw draw;
    WaitingFlux waiting, next;
    std::vector<std::int64_t> side_landed, cell_landed, plane_cells;
    std::vector<std::uint32_t> element_hits;
  };

  [[nodiscard]] TraceOutcome make_rounds(const RoundsPass& pass);
  // Adds the points where kept landings of the beam let flux wait.
  void add_landings(Host& host);
  void compare_places(const Host& host, const WaitingFlux& expected, std::uint32_t count, RoundBuffer places,
                      RoundBuffer quanta);
  void compare_draw(Host& host, const shared::RoundState& state, std::uint32_t places);
  void compare_weights(Host& host, std::uint32_t places);
  void compare_starts(const PacketStarts& starts, shared::RoundPush part);
  // Books the packets of a part on the host.
  void book(Host& host, const shared::RoundState& state, shared::RoundPush part);

  template <class Step>
  void submit(const Step& step) {
    Submission submission(context_);
    step(submission);
    submission.finish();
  }
  template <class T>
  [[nodiscard]] std::vector<T> fetch(RoundBuffer buffer, std::size_t count) const {
    return fetch<T>(steps_.buffer(buffer), count);
  }
  template <class T>
  [[nodiscard]] std::vector<T> fetch(const GpuBuffer& buffer, std::size_t count) const {
    std::vector<T> values(count);
    download(context_, buffer, std::as_writable_bytes(std::span(values)));
    return values;
  }

  const GpuContext& context_;
  Tracer& cpu_;
  RoundSteps steps_;
  std::uint32_t at_a_time_;
  std::uint64_t rounds_ = 0, sampled_ = 0;
  // Of the places of a round: those that keep flux, by their numbers on the device.
  std::vector<std::uint32_t> kept_;
  std::vector<shared::Packet> packets_;
  Landings landings_;
};

}  // namespace sunfleck::test
