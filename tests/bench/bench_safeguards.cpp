// What precautions cost: padded boxes, the element that a packet leaves left out.

#include "bench/benches.h"
#include "bench/measure.h"
#include "bench/ours.h"
#include "bench/rays.h"
#include "transport/indirect.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sunfleck::bench {
namespace {

enum class Precaution { taken, left_out };

void with_padding(benchmark::State& state, const GpuContext* context, Precaution precaution) {
  const Stand& stand = stand_of(paper_plants);
  const float padding_m = precaution == Precaution::taken ? box_padding_m(stand.model) : 0.0F;
  Bvh bvh = build_bvh(stand.model.canopy, padding_m);
  number_counters(stand.prepared.layout, stand.model.canopy, bvh);
  const shared::BeamBlock beam = beam_of(stand, 1U << 20U);
  std::vector<std::uint32_t> counters(stand.prepared.layout.words());
  Ours ours(stand, bvh, context);
  for (auto _ : state) (void)ours.tracer().count_beam(beam, counters, {});
}

void with_own_element(benchmark::State& state, const GpuContext* context, Precaution precaution) {
  const Stand& stand = stand_of(paper_plants);
  std::vector<shared::Packet> packets = packets_of(stand, 1U << 18U, Order::leaf);
  if (precaution == Precaution::left_out) {
    for (shared::Packet& packet : packets) packet.element = shared::no_element;
  }
  const shared::PacketBlock scene = make_packet_block(stand.model, stand.prepared.layout);
  std::vector<shared::Landing> landings(packets.size());
  Ours ours(stand, context);
  for (auto _ : state) (void)ours.tracer().trace(scene, packets, landings, {});
}

template <class Measure>
void add(const std::string& name, const GpuContext* context, const Measure& measure) {
  for (const auto& [with, precaution] : {std::pair("with", Precaution::taken), std::pair("without", Precaution::left_out)}) {
    add_benchmark(fmt::format("safeguard/{}/{}/{}", name, context == nullptr ? "cpu" : "device", with), measure, context,
                  precaution);
  }
}

}  // namespace

void register_safeguards(const GpuContext* context) {
  add("padding", nullptr, with_padding);
  add("own_element", nullptr, with_own_element);
  if (context == nullptr) return;
  add("padding", context, with_padding);
  add("own_element", context, with_own_element);
}

}  // namespace sunfleck::bench
