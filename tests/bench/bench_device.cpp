// Measures what matters on a GPU: whether it finds the CPU path's hits, and how fast it is with each choice.
//   device/agree/RAYS            ten million rays on both; the counter "differ" is the number that land elsewhere
//   device/fetch/RAYS/HOW        the tree in texel buffers or in storage buffers
//   device/group/RAYS/SIZE       threads per workgroup

#include "bench/benches.h"
#include "bench/measure.h"
#include "bench/ours.h"
#include "physics/transport/model/beam_block.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstring>
#include <vector>

namespace sunfleck::bench {
namespace {

constexpr int portions = 10;
constexpr double portion = 1e6;

std::size_t differing(std::span<const shared::Landing> a, std::span<const shared::Landing> b) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += std::memcmp(&a[k], &b[k], sizeof(shared::Landing)) == 0 ? 0 : 1;
  return count;
}

void agree(benchmark::State& state, const GpuContext* context, Rays rays) {
  const Stand& stand = stand_of(paper_plants);
  const shared::PacketBlock scene = make_packet_block(stand.model, stand.prepared.layout);
  Ours cpu(stand, nullptr);
  Ours device(stand, context);
  std::size_t differ = 0;
  std::size_t traced = 0;
  for (auto _ : state) {
    for (std::uint64_t part = 0; part < portions; ++part) {
      const std::vector<shared::Packet> packets =
          rays == Rays::beam ? as_packets(beam_of(stand, portion, part)) : packets_of(stand, portion, Order::leaf, part + 1);
      std::vector<shared::Landing> here(packets.size());
      std::vector<shared::Landing> there(packets.size());
      (void)cpu.tracer().trace(scene, packets, here, {});
      (void)device.tracer().trace(scene, packets, there, {});
      differ += differing(here, there);
      traced += packets.size();
    }
  }
  state.counters["differ"] = static_cast<double>(differ);
  state.counters["traced"] = static_cast<double>(traced);
}

void with_choice(benchmark::State& state, const GpuContext* context, Rays rays, const OurChoices& choices) {
  const Stand& stand = stand_of(paper_plants);
  Ours ours(stand, context, choices);
  measure_ours(state, rays, stand, ours.tracer());
}

}  // namespace

void register_device(const GpuContext* context) {
  if (context == nullptr) return;
  for (const Rays rays : {Rays::beam, Rays::leaf}) {
    add_benchmark(fmt::format("device/agree/{}", name_of(rays)), agree, context, rays)->Iterations(1)->Repetitions(1);
    add_benchmark(fmt::format("device/fetch/{}/texel", name_of(rays)), with_choice, context, rays,
                  OurChoices{BufferUse::uniform_texel, {}});
    add_benchmark(fmt::format("device/fetch/{}/storage", name_of(rays)), with_choice, context, rays,
                  OurChoices{BufferUse::storage, {}});
    for (const std::uint32_t size : {32U, 64U, 128U}) {
      add_benchmark(fmt::format("device/group/{}/{}", name_of(rays), size), with_choice, context, rays,
                    OurChoices{{}, {0, size}});
    }
  }
}

}  // namespace sunfleck::bench
